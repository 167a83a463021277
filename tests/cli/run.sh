#!/usr/bin/env bash
# The command line, by its contract: exit codes, one line per error, files whole or untouched.
# Usage: run.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# -- Help and version, everywhere -------------------------------------------------------------------
for sub in "" render cells diff compare devices; do
  succeeds "help of '$sub'" $sub --help
  expect "Usage: vorpipe"
  succeeds "version of '$sub'" $sub --version
  expect "vorpipe "
done

# -- What works ---------------------------------------------------------------------------------------
succeeds "render" render --backend cpu --sites random:300 --size 90x60 -o out/a.png --ids out/a.npy --stats out/a.json
expect "out/a.png, out/a.npy, out/a.json: 300 cells (0 empty, 0 duplicate), 90x60, cpu on "
[ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
[ "$(head -c 8 out/a.png | tail -c 7 | head -c 3)" = PNG ] || fail "out/a.png is no PNG"
head -c 128 out/a.npy | grep -q "(60, 90)" || fail "out/a.npy is not of shape (60, 90)"
[ "$(wc -c <out/a.npy)" -eq $((128 + 4 * 60 * 90)) ] || fail "out/a.npy has the wrong length"
for key in version command backend device driver sites seed domain status ok empty duplicate resolved retried \
  double exact area_sum time_ms read order upload search cells draw download write total peak_memory_bytes; do
  grep -q "\"$key\":" out/a.json || fail "out/a.json has no $key"
done
grep -q '"area_sum": null' out/a.json || fail "area_sum is not null"

succeeds "quiet" render --quiet --backend cpu --sites random:300 --size 90x60 --threads 1 -o out/b.png --ids out/b.npy
[ -s log/out ] && fail "not quiet"
cmp -s out/a.png out/b.png && cmp -s out/a.npy out/b.npy || fail "two runs differ"

succeeds "only ids" render --backend cpu --sites random:300 --seed 2 --size 90x60 --ids out/c.npy
succeeds "negative domain as an argument of its own" render --backend cpu --sites random:9 --size 9x9 --domain -1,-1,1,1 -o out/d.png
succeeds "negative domain" render --backend cpu --sites random:9 --size 9x9 --domain=-1,-1,1,1 -o out/e.png
cmp -s out/d.png out/e.png || fail "the domains differ"
succeeds "default size" render --backend cpu --sites random:9 --domain 0,0,2,1 --ids out/f.npy
expect "1000x500"
for color in site area neighbors; do
  succeeds "color $color" render --backend cpu --sites hex:50 --size 40x40 --color $color --edges --show-sites -o out/g.png
done
succeeds "check" render --backend cpu --sites clusters:500 --size 50x50 --check --stats out/g.json
expect "checked"
succeeds "nothing but the check" render --backend cpu --sites clusters:500 --size 50x50 --check
expect "500 cells (0 empty, 0 duplicate), 50x50, cpu on "
for search in grid flann flann:12; do
  succeeds "search $search" render --backend cpu --sites random:300 --size 90x60 --search $search --ids out/s.npy
  cmp -s out/a.npy out/s.npy || fail "the ids depend on the search"
done

printf 'y,x,weight\n1,0,5\n2,3,6\n1,0,7\n' >in/good.csv
succeeds "file with weights" render --backend cpu --sites in/good.csv --color weight --size 30x30 -o out/h.png
expect "2 cells (0 empty, 1 duplicate)"
printf 'x,y\n1e12,1e12\n1e12,1e12\n' >in/equal.csv
succeeds "all sites equal, far away" render --backend cpu --sites in/equal.csv --size 20x20 -o out/i.png
expect "1 cells (0 empty, 1 duplicate), 20x20"
printf 'x,y\n0,3\n1,3\n7,3\n' >in/collinear.csv
succeeds "collinear sites" render --backend cpu --sites in/collinear.csv --size 20x20 -o out/i.png
expect "3 cells (0 empty, 0 duplicate), 20x20"

name="sites on standard input"
cases=$((cases + 1))
printf 'x,y\n0,0\n1,1\n' | "$vorpipe" render --backend cpu --sites - --size 9x9 -o out/j.png >log/out 2>log/err || fail "exit code $?"

succeeds "devices" devices
expect "vulkan-geometry"
expect "opengl"
expect "cpu"
succeeds "devices as JSON" devices --json
expect '"backend": "cpu"'
succeeds "a lower limit shows" devices --limit maxTexelBufferElements=65536
expect "65536"

for backend in vulkan-geometry vulkan-compute opengl; do
  succeeds "$backend" render --backend $backend --sites random:300 --size 90x60 --ids out/k.npy --check
  expect "$backend on "
done

# -- Cells --------------------------------------------------------------------------------------------
for backend in $backends; do
  succeeds "cells on $backend" cells --backend $backend --sites random:2000 --check -o out/cells.csv -o out/cells.npz --stats out/cells.json
  expect "out/cells.csv, out/cells.npz, out/cells.json: 2000 cells (0 empty, 0 duplicate), $backend on "
  expect ", checked"
  [ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
  grep -q '"command": "cells"' out/cells.json || fail "out/cells.json is of another command"
  grep -Eq '"area_sum": (1\.0|1\.0000000|0\.9999999)' out/cells.json || fail "area_sum is not 1"
  grep -Eq '"cells": [0-9]' out/cells.json || fail "out/cells.json has no time for the cells"
  [ "$(head -n 1 out/cells.csv)" = site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors ] ||
    fail "the header of out/cells.csv"
  [ "$(wc -l <out/cells.csv)" -eq 2001 ] || fail "out/cells.csv has not one row for each site"
done

succeeds "cells in every format" cells --backend cpu --sites clusters:500 --check --quiet -o out/cells.csv -o out/cells.npz \
  -o out/cells.geojson -o out/cells.svg -o out/cells.obj -o out/cells.ply -o out/cells.vtk -o out/cells.WKT
[ -s log/out ] && fail "not quiet"
for file in out/cells.{csv,npz,geojson,svg,obj,ply,vtk,WKT}; do [ -s "$file" ] || fail "$file is not there"; done
succeeds "cells on one thread" cells --backend cpu --sites clusters:500 --threads 1 -o out/cells1.npz -o out/cells1.csv
cmp -s out/cells.npz out/cells1.npz && cmp -s out/cells.csv out/cells1.csv || fail "two runs differ"
succeeds "cells, another choice of files" cells --backend cpu --sites clusters:500 -o out/cells2.csv --stats out/cells.json
cmp -s out/cells.csv out/cells2.csv || fail "what is in a file depends on the other files"
area_sum=$(grep '"area_sum"' out/cells.json)
succeeds "cells, only stats, no polygons" cells --backend cpu --sites clusters:500 --stats out/cells.json
grep -qF "$area_sum" out/cells.json || fail "area_sum depends on the files"
succeeds "cells, nothing but the check" cells --backend cpu --sites clusters:500 --check
expect "500 cells (0 empty, 0 duplicate), cpu on "
[ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
for search in grid flann flann:12; do
  succeeds "cells, search $search" cells --backend cpu --sites clusters:500 --search $search -o out/cells2.csv
  # Not byte for byte: where a cell begins may depend on the order in which neighbors were found.
  cmp -s <(cut -d, -f1-5,10 out/cells.csv) <(cut -d, -f1-5,10 out/cells2.csv) || fail "the cells depend on the search"
done
succeeds "cells, only stats" cells --backend cpu --sites hex:500 --search flann:8 --domain 0.2,0.2,0.4,0.5 --check --stats out/cells.json
succeeds "verbose" cells --sites random:9 --verbose --stats out/cells.json
expect "9 cells"
for sites in square:400 hex:400 circle:700 circle:300 random:1 random:2; do
  succeeds "cells of $sites" cells --backend cpu --sites $sites --check --stats out/cells.json
done

if $numpy_python -c 'import numpy' 2>/dev/null; then
  name="NumPy reads the cells"
  cases=$((cases + 1))
  $numpy_python - out/cells1.npz >log/out 2>log/err <<'PYTHON' || fail "NumPy does not"
import sys
import numpy
cells = numpy.load(sys.argv[1])
for name in ("sites status areas centroids cell_offsets cell_vertices neighbor_offsets neighbors "
             "edge_lengths triangles").split():
    assert name in cells.files, name
assert cells["sites"].shape == (500, 2) and cells["areas"].shape == (500,)
assert abs(cells["areas"].sum() - 1) < 1e-6
vertices, offsets = cells["cell_vertices"], cells["cell_offsets"]
assert vertices.shape == (offsets[-1], 2) and cells["neighbors"].shape == (cells["neighbor_offsets"][-1],)
for begin, end, area in zip(offsets[:-1], offsets[1:], cells["areas"]):
    x, y = vertices[begin:end].T
    assert abs((x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum() / 2 - area) < 1e-12
PYTHON
else
  echo "SKIPPED: NumPy reads the cells: $numpy_python has no numpy" >&2
fi

printf 'x,y,weight\n1,0,5\n2,3,6\n1,0,7\n' >in/cells.csv
succeeds "cells of a file with weights" cells --backend cpu --sites in/cells.csv --check -o out/cells.csv
expect "2 cells (0 empty, 1 duplicate)"
grep -q '^2,1,0,7,ok,' out/cells.csv || fail "the heavier of two equal sites does not own the cell"
grep -q '^0,1,0,5,duplicate,' out/cells.csv || fail "the lighter of two equal sites is no duplicate"

fails 2 "cells without an output" "-o" cells --backend cpu --sites random:9
fails 2 "cells without sites" "--sites" cells --backend cpu -o out/old.csv
fails 2 "cells of an unknown kind" "-o: out/old.png" cells --backend cpu --sites random:9 -o out/old.csv -o out/old.png
fails 2 "cells without an extension" "-o: out/old" cells --backend cpu --sites random:9 -o out/old
fails 2 "cells, an option where a file belongs" "-o" cells --backend cpu --sites random:9 -o --quiet
fails 2 "cells twice in one file" "out/old.csv" cells --backend cpu --sites random:9 -o out/old.csv -o out/../out/old.csv
fails 2 "cells, the second output cannot be written" "out/none/a.npz" cells --backend cpu --sites random:9 -o out/old.csv -o out/none/a.npz
fails 2 "cells of a missing file" "in/missing.csv" cells --backend cpu --sites in/missing.csv -o out/old.csv --stats out/old.json
fails 2 "cells with a bad search" "--search" cells --backend cpu --sites random:9 --search flann:2 -o out/old.csv
fails 2 "cells with a bad domain" "--domain" cells --backend cpu --sites random:9 --domain 1,0,0,1 -o out/old.csv
fails 2 "cells on an unknown backend" "--backend" cells --backend nope --sites random:9 -o out/old.csv
fails 3 "cells, geometry shader masked" "geometryShader" cells --backend vulkan-geometry --disable geometryShader --sites random:9 -o out/old.csv
if [ -w /dev/full ]; then
  fails 3 "cells, a full disk" "/dev/full" cells --backend cpu --sites random:9 -o out/old.csv --stats /dev/full
fi

# -- Comparing ----------------------------------------------------------------------------------------
succeeds "diff of equal ids" diff out/a.npy out/b.npy --sites random:300
expect "5400 pixels equal, 0 ties, 0 wrong"
succeeds "diff of equal pictures" diff out/a.png out/b.png
cp out/a.npy in/mutant.npy
printf '\377\377\377\377' | dd of=in/mutant.npy bs=1 seek=$((128 + 4 * (7 * 90 + 11))) conv=notrunc status=none
fails 1 "a changed id" "1 pixels wrong (0 ties, 5399 equal), first at row 7, column 11" diff out/a.npy in/mutant.npy --sites random:300
fails 1 "a changed id, sites unknown" "first at row 7, column 11" diff out/a.npy in/mutant.npy
fails 1 "ids of other sites" "pixels wrong" diff out/a.npy out/c.npy --sites random:300
fails 1 "pictures that differ" "pixels differ" diff out/d.png out/j.png --quiet
fails 1 "sizes that differ" "the sizes differ" diff out/a.png out/h.png
name="picture of differences"
cases=$((cases + 1))
run 1 diff out/a.npy in/mutant.npy -o out/where.png
[ -s out/where.png ] || fail "no picture"
succeeds "compare" compare --backends "${backends// /,}" --sites random:300 --size 90x60 --report out/r.json -o out/m.png
expect "cpu / vulkan-geometry"
expect "vulkan-geometry / opengl"
expect "worst area"
grep -q '"wrong": 0' out/r.json || fail "out/r.json has no wrong"
for key in different_statuses different_neighbors different_areas worst_area of_allowed cells_ms area_slack; do
  grep -q "\"$key\":" out/r.json || fail "out/r.json has no $key"
done
[ "$(grep -c '"equal": 300,' out/r.json)" -eq 6 ] || fail "not six pairs of 300 equal cells"
succeeds "compare duplicates and sites outside" compare --quiet --backends cpu,vulkan-geometry --sites in/cells.csv --domain 0,0,1.5,2 --size 30x30
[ -s log/out ] && fail "not quiet"
fails 2 "compare with an unknown backend" '--backends: "nope" is not one of' compare --backends cpu,nope --sites random:9 --report out/old.json
fails 2 "compare a backend with itself" "--backends" compare --backends cpu,cpu --sites random:9 --report out/old.json
fails 2 "compare with one backend" "--backends" compare --backends cpu --sites random:9
fails 2 "diff of a picture and ids" "out/a.npy" diff out/a.png out/a.npy
fails 2 "diff with sites of pictures" "--sites" diff out/a.png out/b.png --sites random:300
fails 2 "diff of a missing file" "out/nothing.npy" diff out/a.npy out/nothing.npy
fails 2 "diff of one file" "B" diff out/a.npy

# -- Bad command lines ----------------------------------------------------------------------------------
fails 2 "no subcommand" "subcommand"
fails 2 "unknown subcommand" "paint" paint
fails 2 "unknown option" "--nope" render --sites random:9 -o out/old.png --nope
fails 2 "no sites" "--sites" render -o out/old.png
fails 2 "nothing to write" "-o" render --sites random:9 --backend cpu
refuses "no value" "--size" --sites random:9 --size
for size in 0x10 10x0 -1x5 1000000x1000000 32769x1 10 10x x10 10x10x10 1.5x2 ax2 "" 99999999999999999999x1; do
  refuses "size '$size'" "--size" --sites random:9 --size "$size"
done
for domain in land.shp 1,0,0,1 0,1,1,0 0,0,0,1 0,0,1 0,0,1,1,1 0,0,1,nan 0,0,inf,1 0,0,1e999,1 a,0,1,1 -1e308,0,1e308,1; do
  refuses "domain $domain" "--domain" --sites random:9 --domain "$domain"
done
fails 2 "backend" '--backend: "nope" is not one of auto, vulkan' render --sites random:9 --backend nope -o out/old.png
for threads in 0 -1 1025 x; do refuses "threads $threads" "--threads" --sites random:9 --threads "$threads"; done
for search in flann:2 flann:1025 flann: flann:x trees grid:3 Grid ""; do
  refuses "search $search" "--search" --sites random:9 --search "$search"
done
for seed in -1 x 18446744073709551616; do refuses "seed $seed" "--seed" --sites random:9 --seed "$seed"; done
for limit in maxTexelBufferElements maxTexelBufferElements=x =5; do
  refuses "limit $limit" "--limit" --sites random:9 --limit "$limit"
done
refuses "unknown limit" '--limit: "maxNope" is not one of maxTexelBufferElements' --sites random:9 --limit maxNope=5
refuses "unknown feature" '--disable: "nopeShader" is not one of geometryShader' --sites random:9 --disable nopeShader
fails 2 "unknown feature of devices" '--disable: "nopeShader"' devices --disable nopeShader
fails 2 "unknown limit of devices" '--limit: "maxNope"' devices --limit maxNope=5
refuses "color" "--color" --sites random:9 --color blue
refuses "colormap" "viridis" --sites random:9 --colormap nope
refuses "color by weight without weights" "--color: weight needs weights; random:9 has none" --sites random:9 --color weight
refuses "more sites than memory" "--sites: needs about" --sites random:4294967294
fails 2 "more cells than memory" "--sites: needs about" cells --backend cpu --sites random:4294967294 -o out/old.csv
fails 2 "an option where a file belongs" "-o" render --backend cpu --sites random:9 -o --quiet
fails 2 "the same for --stats" "--stats" render --backend cpu --sites random:9 --stats --quiet
refuses "an option given twice" "--size" --sites random:9 --size 9x9 --size 8x8
refuses "quiet and verbose" "--quiet" --sites random:9 --quiet --verbose
for sites in random:0 random:-5 random:x random: random random:99999999999; do
  refuses "sites $sites" "--sites" --sites "$sites"
done
fails 2 "one file for two outputs" "out/old.npy" render --backend cpu --sites random:9 --ids out/old.npy --stats out/../out/old.npy
fails 2 "a picture that is no .png" "-o" render --backend cpu --sites random:9 -o out/old.json

# -- Bad files ----------------------------------------------------------------------------------------
for number in nan inf 1e999 text ""; do
  printf 'x,y\n0,0\n1,%s\n' "$number" >"in/value.csv"
  refuses_file value.csv "in/value.csv:3:"
done
printf 'x,y\n0,0\n1\n' >in/columns.csv
refuses_file columns.csv "in/columns.csv:3:"
printf '0,0\n1,1\n' >in/header.csv
refuses_file header.csv "in/header.csv:1"
: >in/empty.csv
: >in/empty.npy
: >in/empty.xyz
printf 'x,y\n' >in/rows.csv
printf '0 0\n1 nan\n' >in/value.xyz
head -c 1000 out/a.npy >in/truncated.npy
printf 'not an array at all' >in/text.npy
printf 'x,y\n0,0\n' >in/kind.doc
mkdir in/folder in/folder.csv
for file in empty.csv empty.npy empty.xyz rows.csv truncated.npy text.npy kind.doc folder folder.csv missing.csv; do
  refuses_file "$file" "in/$file"
done
refuses_file value.xyz "in/value.xyz:2:"

# -- Outputs that cannot be written -----------------------------------------------------------------------
fails 2 "no such folder" "out/none/a.png" render --backend cpu --sites random:9 -o out/none/a.png
fails 2 "a folder as output" "in/folder" render --backend cpu --sites random:9 -o in/folder
fails 2 "the second output cannot be written" "out/none/a.npy" render --backend cpu --sites random:9 -o out/old.png --ids out/none/a.npy
if [ -w /dev/full ]; then
  fails 3 "a full disk" "/dev/full" render --backend cpu --sites random:9 -o out/old.png --stats /dev/full
  name="standard output is full"
  cases=$((cases + 1))
  "$vorpipe" devices --json >/dev/full 2>log/err && fail "exit code 0"
  one_line
fi

# -- Devices that are not there -------------------------------------------------------------------------
none() { VK_DRIVER_FILES=/nonexistent.json VK_ICD_FILENAMES=/nonexistent.json "$@"; }
none fails 3 "no Vulkan driver" "vulkan" render --backend vulkan-geometry --sites random:9 -o out/old.png
none fails 3 "compare without a Vulkan driver" "vulkan" compare --backends cpu,vulkan-geometry --sites random:9 --report out/old.json
none succeeds "cpu without a Vulkan driver" render --backend cpu --sites random:9 --size 9x9 -o out/l.png
none succeeds "devices without a Vulkan driver" devices
expect "cannot be used"
broken_egl() { __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json __EGL_VENDOR_LIBRARY_DIRS=/nonexistent "$@"; }
broken_egl fails 3 "no EGL" "opengl" render --backend opengl --sites random:9 -o out/old.png
broken_egl succeeds "cpu without EGL" render --backend cpu --sites random:9 --size 9x9 -o out/l.png
fails 3 "geometry shader masked" "geometryShader" render --backend vulkan-geometry --disable geometryShader --sites random:9 -o out/old.png
fails 3 "no such device" "no-such-device" render --backend vulkan-geometry --device no-such-device --sites random:9 -o out/old.png
fails 3 "no such device of cpu" "'3'" render --backend cpu --device 3 --sites random:9 -o out/old.png
succeeds "the device of cpu" render --backend cpu --device 0 --sites random:9 --size 9x9 -o out/l.png
fails 3 "no such index" "'77'" render --backend vulkan-geometry --device 77 --sites random:9 -o out/old.png
grep -qF "there are 0" log/err && fail "it says that there are no devices"

# -- Interrupted ------------------------------------------------------------------------------------------
name="interrupted"
cases=$((cases + 1))
before=$(outputs)
"$vorpipe" render --backend cpu --sites random:500000 -o out/old.png >log/out 2>log/err &
pid=$!
until ls out/.vorpipe-* >/dev/null 2>&1 || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done
kill -INT $pid
wait $pid
code=$?
[ $code -eq 130 ] || fail "exit code $code, not 130"
one_line
grep -q interrupted log/err || fail "the line does not say 'interrupted'"
[ "$before" = "$(outputs)" ] || fail "the output folder changed"

# Nobody reads the pipe, so that the run never comes to look whether it was asked to stop.
name="interrupted while it writes"
cases=$((cases + 1))
mkfifo in/pipe.csv
sleep 60 <in/pipe.csv &
reader=$!
"$vorpipe" cells --backend cpu --sites random:20000 -o out/old.npz -o in/pipe.csv >log/out 2>log/err &
pid=$!
until [ "$(find out -name '.vorpipe-*' -size +1000k)" ] || ! kill -0 $pid 2>/dev/null; do sleep 0.02; done
sleep 0.5
kill -INT $pid
wait $pid
code=$?
kill $reader
[ $code -eq 130 ] || fail "exit code $code, not 130"
one_line
grep -q interrupted log/err || fail "the line does not say 'interrupted'"
[ "$before" = "$(outputs)" ] || fail "the output folder changed"

finish
