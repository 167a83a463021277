#!/usr/bin/env bash
# The program on a Vulkan driver that shares nothing with Mesa's, and that nothing was written for: no geometry shader,
# no double, 65,536 texels, 4 sub-pixel bits, numbers below 2^-126 flushed to 0.
# Usage: on_swiftshader.sh bash swiftshader.sh VORPIPE LAYER_FOLDER
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

succeeds "selftest" selftest --quick --backend vulkan-compute
expect "SwiftShader"
expect "; validated"
grep -q '^all [0-9]* runs on 1 device passed' log/out || fail "no summary of what passed"

succeeds "pictures and cells of both" compare --backends vulkan-compute,cpu --device SwiftShader --sites clusters:2000 \
  --random-weights 0,0.0001 --size 200 --check
succeeds "the cells of cpu" cells --backend cpu --sites random:70000 -o out/right.npz
succeeds "more sites than texels" cells --backend vulkan-compute --sites random:70000 -o out/cells.npz
cmp -s out/right.npz out/cells.npz || fail "other bytes"
succeeds "vulkan" cells --backend vulkan --sites hex:100 -o out/hex.csv
expect "vulkan-compute on SwiftShader"
fails 3 "no geometry shader" "it lacks the feature geometryShader" cells --backend vulkan-geometry --sites hex:100 -o out/old.csv

# -- Faults, made by a layer between program and driver ---------------------------------------------------
export VK_LAYER_PATH=$2:/usr/share/vulkan/explicit_layer.d VK_INSTANCE_LAYERS=VK_LAYER_VORPIPE_faulty
run 0 cells --backend cpu --sites clusters:25000 -o out/right.csv
for k in 1 2; do
  VORPIPE_LAYER_LOST_AT=$k fails 3 "lost at $k" VK_ERROR_DEVICE_LOST render --backend vulkan-compute --sites hex:100 -o out/old.png
done
name="without memory" cases=$((cases + 1))
VORPIPE_LAYER_LARGEST_ALLOCATION=524288 run 0 cells --backend vulkan-compute --sites clusters:25000 -o out/less.csv
grep -q '^vorpipe: note: .* at a time$' log/err || fail "no note of less at a time"
cmp -s out/right.csv out/less.csv || fail "other bytes"

finish
