#!/usr/bin/env bash
# The program on devices that lose themselves, refuse memory or have few sub-pixel bits: a layer between it and
# the driver makes them so.
# Usage: faulty.sh VORPIPE LAYER_FOLDER
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"
export VK_LAYER_PATH=$2:/usr/share/vulkan/explicit_layer.d VK_INSTANCE_LAYERS=VK_LAYER_VORPIPE_faulty

# faulty NAME=VALUE... -- COMMAND...: with the layer set so.
faulty() {
  local settings=()
  while [ "$1" != -- ]; do
    settings+=("VORPIPE_LAYER_$1")
    shift
  done
  shift
  local setting
  for setting in "${settings[@]}"; do export "${setting?}"; done
  "$@"
  for setting in "${settings[@]}"; do unset "${setting%%=*}"; done
}

# notes TEXT: standard error has notes, the last one with TEXT, and nothing else.
notes() {
  grep -qv '^vorpipe: note: ' log/err && fail "something other than notes on standard error"
  tail -1 log/err | grep -qF -- "$1" || fail "the last note does not say '$1'"
}

# done_by BACKEND: what --stats says did it.
done_by() { grep -q "\"backend\": \"$1\"" out/stats.json || fail "it is not $1 that did it"; }

cells() { run 0 cells --sites random:3000 --check -o "out/$1.csv" --stats out/stats.json "${@:2}"; }
picture() { run 0 render --sites random:3000 --size 300x300 --check -o "out/$1.png" --stats out/stats.json "${@:2}"; }

name="the layer is there"
cells right --backend cpu
cells there --backend vulkan-compute
cmp -s out/right.csv out/there.csv || fail "other bytes"
[ -s log/err ] && fail "something on standard error"

# -- Lost devices ---------------------------------------------------------------------------------------
for backend in vulkan-compute vulkan-geometry; do
  for k in 1 2 3 4; do
    faulty LOST_AT=$k -- fails 3 "$backend lost at $k" "VK_ERROR_DEVICE_LOST" \
      render --backend "$backend" --sites random:3000 -o out/old.png
  done
  faulty LOST_AT=1 -- fails 3 "$backend lost" "VK_ERROR_DEVICE_LOST" \
    cells --backend "$backend" --sites random:3000 -o out/old.csv
done
# Who masks a device means one: else auto would take cpu here.
masked="--limit maxTexelBufferElements=65536"
for k in 1 2 3 4 5; do
  name="auto, lost at $k" cases=$((cases + 1))
  faulty LOST_AT=$k -- picture lost $masked
  [ -s log/err ] && notes "vulkan-geometry took over from vulkan-compute" && done_by vulkan-geometry
  faulty LOST_AT=$k ALL_LOST=1 -- picture lost $masked
  [ -s log/err ] && notes "opengl took over from vulkan-geometry" && done_by opengl
done
name="auto, cells, all lost" cases=$((cases + 1))
faulty LOST_AT=1 ALL_LOST=1 -- cells lost $masked
notes "opengl took over from vulkan-geometry"
grep -q '"notes": \[$' out/stats.json || fail "--stats has no notes"
cmp -s out/right.csv out/lost.csv || fail "other bytes"
name="auto, quiet" cases=$((cases + 1))
faulty LOST_AT=1 ALL_LOST=1 -- cells lost --quiet $masked
[ -s log/err ] && fail "something on standard error"
faulty LOST_AT=1 ALL_LOST=1 -- fails 3 "vulkan, all lost" "VK_ERROR_DEVICE_LOST" \
  cells --backend vulkan --sites random:3000 -o out/old.csv

# -- Memory ---------------------------------------------------------------------------------------------
run 0 cells --backend cpu --sites random:25000 -o out/right.csv
for backend in vulkan-compute vulkan-geometry; do
  name="$backend without memory" cases=$((cases + 1))
  faulty LARGEST_ALLOCATION=524288 -- \
    run 0 cells --backend "$backend" --sites random:25000 --check -o out/less.csv --stats out/stats.json
  notes "at a time"
  done_by "$backend"
  cmp -s out/right.csv out/less.csv || fail "other bytes"
  faulty LARGEST_ALLOCATION=524288 -- \
    run 0 render --backend "$backend" --sites random:25000 --size 900x900 --check -o out/less.png
  notes "at a time"
done

# -- A driver that compiles for long --------------------------------------------------------------------
compileFor() {
  "$vorpipe" cells --backend vulkan-compute --sites random:10 -o out/slow.csv >log/out 2>log/err </dev/null &
  local pid=$! tries
  for ((tries = 0; tries < 300; tries++)); do
    if grep -q compiling log/err; then break; fi
    sleep 0.1
  done
  kill -INT "$pid"
  wait "$pid"
  code=$?
}
name="a wait that is said, and ended by Ctrl-C" cases=$((cases + 1))
started=$SECONDS
faulty COMPILES_FOR=120 -- compileFor
[ "$code" -eq 130 ] || fail "exit code $code, not 130"
[ $((SECONDS - started)) -lt 100 ] || fail "it waited for the driver"
head -1 log/err | grep -q '^vorpipe: note: the driver of .* has been compiling the shader polygon_vert for 3 s' ||
  fail "the wait is not said"
[ "$(tail -n +2 log/err)" = "vorpipe: interrupted" ] || fail "more is said"
[ -e out/slow.csv ] && fail "a file was written"

# -- Few sub-pixel bits ---------------------------------------------------------------------------------
name="few sub-pixel bits" cases=$((cases + 1))
faulty SUBPIXEL_BITS=4 -- run 0 devices
grep -q 'subPixelPrecisionBits *4$' log/out || fail "devices does not show them"

# -- Threads of the driver ------------------------------------------------------------------------------
name="threads" cases=$((cases + 1))
unset LP_NUM_THREADS
faulty THREADS_FILE="$work/threads" -- cells threads --backend vulkan-compute --threads 1
[ "$(cat threads)" = 1 ] || fail "the driver has $(cat threads) threads"
export LP_NUM_THREADS=3
faulty THREADS_FILE="$work/threads" -- cells threads --backend vulkan-compute --threads 1
[ "$(cat threads)" = 3 ] || fail "the driver has $(cat threads) threads, not the user's"

# -- Lanes of the driver --------------------------------------------------------------------------------
# Machine code for eight lanes, taken from the cache of Mesa's drivers, would write past the end of vertices for four.
name="lanes of four" cases=$((cases + 1))
cached() { find "$work/cache" -type f 2>/dev/null | wc -l; }
export MESA_SHADER_CACHE_DIR=$work/cache LP_NATIVE_VECTOR_WIDTH=128
cells lanes --backend vulkan-geometry
[ "$(cached)" = 0 ] || fail "they use the cache of other lanes"
unset LP_NATIVE_VECTOR_WIDTH
cells cached --backend vulkan-geometry
cmp -s out/cached.csv out/lanes.csv || fail "other bytes"
[ "$(cached)" != 0 ] || skipped "lanes of four" "the driver has no cache"

finish
