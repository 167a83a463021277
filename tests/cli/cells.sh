#!/usr/bin/env bash
# Cells as data, on every backend and in every format.
# Usage: cells.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# -- Cells ----------------------------------------------------------------------------------------------
for backend in $backends; do
  succeeds "cells on $backend" cells --backend $backend --sites random:2000 --check -o out/cells.csv -o out/cells.npz --stats out/cells.json
  expect "out/cells.csv, out/cells.npz, out/cells.json: 2000 unweighted cells (0 empty, 0 duplicate), $backend on "
  expect ", checked"
  [ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
  grep -q '"command": "cells"' out/cells.json || fail "out/cells.json is of another command"
  grep -Eq '"area_sum": (1\.0|1\.0000000|0\.9999999)' out/cells.json || fail "area_sum is not 1"
  grep -Eq '"cells": [0-9]' out/cells.json || fail "out/cells.json has no time for the cells"
  [ "$(head -n 1 out/cells.csv)" = site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors ] ||
    fail "the header of out/cells.csv"
  [ "$(wc -l <out/cells.csv)" -eq 2001 ] || fail "out/cells.csv has not one row for each site"
done

formats="csv npz geojson gpkg svg obj ply vtk vtp vtu WKT"
edges_formats="csv geojson geojsonl gpkg wkt vtp"
# Options for a file of each kind, named out/$1.KIND; and out/$1-edges.KIND.
files() {
  local kind
  for kind in $formats; do echo "-o out/$1.$kind"; done
  for kind in $edges_formats; do echo "--edges out/$1-edges.$kind"; done
}
succeeds "cells in every format" cells --backend cpu --sites clusters:500 --check --quiet $(files cells)
[ -s log/out ] && fail "not quiet"
succeeds "cells on one thread" cells --backend cpu --sites clusters:500 --threads 1 $(files cells1)
for kind in $formats; do cmp "out/cells.$kind" "out/cells1.$kind" || fail "two runs differ in .$kind"; done
for kind in $edges_formats; do cmp "out/cells-edges.$kind" "out/cells1-edges.$kind" || fail "edges differ in .$kind"; done
succeeds "cells, another choice of files" cells --backend cpu --sites clusters:500 -o out/cells2.csv --stats out/cells.json
cmp -s out/cells.csv out/cells2.csv || fail "what is in a file depends on the other files"
area_sum=$(grep '"area_sum"' out/cells.json)
succeeds "cells, only stats, no polygons" cells --backend cpu --sites clusters:500 --stats out/cells.json
grep -qF "$area_sum" out/cells.json || fail "area_sum depends on the files"
succeeds "cells, nothing but the check" cells --backend cpu --sites clusters:500 --check
expect "500 unweighted cells (0 empty, 0 duplicate), cpu on "
[ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
for search in grid flann flann:12; do
  succeeds "cells, search $search" cells --backend cpu --sites clusters:500 --search $search -o out/cells2.csv
  # Not byte for byte: where a cell begins may depend on the order in which neighbors were found.
  cmp -s <(cut -d, -f1-5,10 out/cells.csv) <(cut -d, -f1-5,10 out/cells2.csv) || fail "the cells depend on the search"
done
succeeds "cells, only stats" cells --backend cpu --sites hex:500 --search flann:8 --domain 0.2,0.2,0.4,0.5 --check --stats out/cells.json
name="verbose"
cases=$((cases + 1))
run 0 cells --sites random:9 --verbose --stats out/cells.json
one_line
grep -q '^vorpipe: note: auto took' log/err || fail "it does not say why a backend was taken"
expect "9 unweighted cells"
if [ -n "${VORPIPE_EXPECTED_BACKENDS-}" ]; then
  grep -q '^vorpipe: note: auto took cpu: no hardware device (vulkan: llvmpipe .* is a software driver; opengl: EGL lists ' log/err ||
    fail "it did not take cpu"
  for device in "--limit maxTexelBufferElements=65536" "--disable geometryShader" "--device llvmpipe"; do
    notes "auto, $device" "auto took vulkan-compute: no hardware device, but a software driver for Vulkan" \
      cells --sites random:9 $device --verbose --stats out/cells.json
  done
fi
name="auto without drivers" cases=$((cases + 1))
VK_DRIVER_FILES=/dev/null __EGL_VENDOR_LIBRARY_FILENAMES=/dev/null run 0 cells --sites random:9 --verbose --stats out/cells.json
one_line
grep -q '^vorpipe: note: auto took cpu: no hardware device (.*no Vulkan driver.*; opengl: ' log/err ||
  fail "it does not say why Vulkan and OpenGL failed"
expect "9 unweighted cells"
for sites in square:400 hex:400 circle:700 circle:300 random:1 random:2; do
  succeeds "cells of $sites" cells --backend cpu --sites $sites --check --stats out/cells.json
done

if has_numpy; then
  name="NumPy reads the cells"
  cases=$((cases + 1))
  "$python" - out/cells1.npz >log/out 2>log/err <<'PYTHON' || fail "NumPy does not"
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
  skipped "NumPy reads the cells" "there is no python3 with NumPy"
fi

printf 'x,y,weight\n1,0,5\n2,3,6\n1,0,7\n' >in/cells.csv
succeeds "cells of a file with weights" cells --backend cpu --sites in/cells.csv --check -o out/cells.csv
expect "2 weighted cells (0 empty, 1 duplicate)"
grep -q '^2,1,0,7,ok,' out/cells.csv || fail "the heavier of two equal sites does not own the cell"
grep -q '^0,1,0,5,duplicate,' out/cells.csv || fail "the lighter of two equal sites is no duplicate"

# -- Standard output, and records with a cell -------------------------------------------------------------
succeeds "cells to standard output" cells --backend cpu --sites clusters:500 -o -
cmp -s log/out out/cells1.csv || fail "not CSV, or not that alone"
for kind in geojson gpkg npz; do
  succeeds "cells to standard output as $kind" cells --backend cpu --sites clusters:500 -o - --format $kind
  cmp -s log/out out/cells.$kind || fail "not the file"
done
succeeds "cells to /dev/stdout" cells --backend cpu --sites clusters:500 -o /dev/stdout --format WKT
cmp -s log/out out/cells.WKT || fail "not the file"
name="cells with a place alone"
cases=$((cases + 1))
cut -d, -f2,3 out/cells1.csv >in/clusters.csv
run 0 cells --backend cpu --sites in/clusters.csv --domain 0,0,.5,1 --only-cells -o out/cells4.geojson -o out/cells4.csv
left_out=$(grep -c ',empty,' out/cells4.csv)
grep -qF "note: $left_out of 500 sites have no cell: they lie outside the domain" log/err || fail "why they have no cell"
grep -qF "note: --only-cells: $left_out of 500 sites have no cell, and are left out" log/err || fail "what is left out"
[ "$(grep -c '"Feature"' out/cells4.geojson)" -eq $((500 - left_out)) ] || fail "not only cells"
grep -q '"geometry":null' out/cells4.geojson && fail "a record without a cell"
fails 2 "standard output twice" "-o: standard output" cells --backend cpu --sites random:9 -o - -o /dev/stdout
fails 2 "standard output of an unknown kind" "--format" cells --backend cpu --sites random:9 -o - --format png
fails 2 "a kind for nothing" "--format" cells --backend cpu --sites random:9 -o out/old.csv --format csv

# -- Patterns in a box, and what ends in air ------------------------------------------------------------------
succeeds "a pattern fills the box that is named" cells --backend cpu --sites random:150 --domain 0,0,1.5,1 -o out/box.csv
awk -F, 'NR > 1 && $2 > 1.2 { n++ } END { exit !(n > 15) }' out/box.csv || fail "nothing is at its end"
succeeds "a lattice in a box" cells --backend cpu --sites square:150 --domain 0,0,1.5,1 --check -o out/box.csv
awk -F, 'NR > 1 && ($6 < 0.00999999 || $6 > 0.01000001) { exit 1 }' out/box.csv || fail "its spacings differ"
succeeds "drops" transport --backend cpu --sites random:60 --fill 0.6 --quiet -o out/drops.csv --cells out/drops-then.csv
succeeds "drops out of a file" cells --backend cpu --sites out/drops.csv --domain 0,0,1,1 --surface free -o out/drops-now.csv
cmp out/drops-then.csv out/drops-now.csv || fail "other cells"
succeeds "a picture of them" render --backend cpu --sites out/drops.csv --domain 0,0,1,1 --surface free --size 50 -o out/drops.png -o out/drops.svg
grep -q 'A' out/drops.svg || fail "there are no arcs"
fails 2 "a check of drops" "--check: what verifies cells does not know free surfaces" \
  cells --backend cpu --sites out/drops.csv --surface free --check -o out/old.csv
fails 2 "drops without radii" "--surface: the sites have no weights" cells --backend cpu --sites random:9 --surface free -o out/old.csv
fails 2 "only cells of no features" "--only-cells" cells --backend cpu --sites random:9 --only-cells -o out/old.csv
fails 2 "edges of an unknown kind" "--edges: out/old.npz" cells --backend cpu --sites random:9 --edges out/old.npz

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
else
  skipped "a full disk" "there is no /dev/full"
fi

finish
