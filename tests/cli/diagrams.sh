#!/usr/bin/env bash
# Weights, periodic domains, outlines and densities on the command line: results that are known, the same cells
# and pictures on every backend, and every error. Usage: diagrams.sh VORPIPE ISLANDS
islands=$(realpath "$2") || exit 1
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

printf 'no picture' >in/text.png
printf 'x,y\n0,0\n' | tee in/good.csv >in/kind.doc
succeeds "without weights" render --backend cpu --sites random:500 --size 90x60 --fit stretch --ids out/a.npy -o out/a.png

# -- Weights ------------------------------------------------------------------------------------------
# The same weights by every way in: weight = 0.25, 0, 0.01; the second site is hidden by the first.
printf 'x,y,weight\n0.3,0.5,0.25\n0.35,0.5,0\n0.8,0.5,0.01\n' >in/weight.csv
printf 'radius,x,y\n0.5,0.3,0.5\n0,0.35,0.5\n0.1,0.8,0.5\n' >in/radius.csv
printf '0.3 0.5 0.25\n0.35 0.5 0\n0.8 0.5 0.01\n' >in/weight.xyz
printf 'x,y\n0.3,0.5\n0.35,0.5\n0.8,0.5\n' >in/plain.csv
printf '0.25\n0\n0.01\n' >in/weights.txt
printf 'radius\n0.5\n0\n0.1\n' >in/radii.csv
box="--domain 0,0,1,1"
succeeds "weights in a column" cells --backend cpu --sites in/weight.csv $box --check -o out/w.csv --stats out/w.json
expect "2 weighted cells (1 empty, 0 duplicate)"
grep -q '^1,0.35,0.5,0,empty,0,' out/w.csv || fail "the second site is not hidden"
grep -A3 '"weights": \[' out/w.json | tr -d ' \n' | grep -q '\[0.0,0.25\]' || fail "the weights are not in out/w.json"
for sites in "in/radius.csv" "in/weight.xyz" "in/plain.csv --weights in/weights.txt" "in/plain.csv --weights in/radii.csv"; do
  succeeds "weights of $sites" cells --quiet --backend cpu --sites $sites $box -o out/w2.csv
  # 0.1 * 0.1 is not 0.01.
  cmp -s <(cut -d, -f1-3,5,10,11 out/w.csv) <(cut -d, -f1-3,5,10,11 out/w2.csv) || fail "other cells than of the column weight"
done
for backend in $backends; do
  succeeds "weights on $backend" cells --backend $backend --sites random:2000 --random-weights 0,0.001 --check --stats out/w.json
  succeeds "weights in a picture on $backend" render --backend $backend --sites random:500 --random-weights 0,0.004 --size 90x60 --fit stretch --check --color weight --ids out/w-$backend.npy -o out/w.png
  succeeds "weights in diff on $backend" diff out/w-cpu.npy out/w-$backend.npy --sites random:500 --random-weights 0,0.004
done
fails 1 "other weights in diff" "pixels wrong" diff out/w-cpu.npy out/a.npy --sites random:500 --random-weights 0,0.004
for command in "cells" "render --size 50x50"; do
  succeeds "hidden sites, $command" $command --backend cpu --sites random:500 --random-weights 0,0.004 --stats out/w.json
  hidden=$(sed -n 's/.*"hidden": \([0-9]*\).*/\1/p' out/w.json)
  [ "${hidden:-0}" -gt 100 ] && grep -q "\"empty\": $hidden," out/w.json || fail "not as many are hidden as empty"
  succeeds "none hidden without weights, $command" $command --backend cpu --sites random:500 --stats out/w.json
  grep -q '"hidden": null' out/w.json || fail "hidden is not null"
done
succeeds "equal weights" cells --backend cpu --sites random:500 --random-weights 7,7 -o out/w.csv
succeeds "no weights" cells --backend cpu --sites random:500 -o out/w2.csv
cmp -s <(cut -d, -f1-3,5- out/w.csv) <(cut -d, -f1-3,5- out/w2.csv) || fail "equal weights change the cells"
succeeds "compare with weights" compare --backends "${backends// /,}" --sites random:400 --random-weights 0,0.01 --size 90x60 --report out/r.json
grep -q '"wrong": [^0]' out/r.json && fail "pixels are wrong"

fails 2 "flann with weights" "--search: of sites with weights" cells --backend cpu --sites random:50 --random-weights 0,0.1 --search flann -o out/old.csv
refuses "weights twice" "--weights: in/weight.csv has weights of its own" --sites in/weight.csv --weights in/weights.txt
refuses "weights both ways" "--weights" --sites random:9 --weights in/weights.txt --random-weights 0,1
refuses "random weights for a file" "--random-weights: is for generators" --sites in/plain.csv --random-weights 0,1
refuses "fewer weights than sites" "--weights: in/weights.txt:4:1: the file ends after 3 weights, there are 9 sites" --sites random:9 --weights in/weights.txt
refuses "more weights than sites" "--weights: in/weights.txt:3:1: a weight too many, there are 2 sites" --sites random:2 --weights in/weights.txt
refuses "a missing file of weights" "--weights: in/missing.txt" --sites random:9 --weights in/missing.txt
refuses "an unknown kind of weights" "--weights: in/kind.doc" --sites random:9 --weights in/kind.doc
printf '1\nx\n3\n' >in/word.txt
refuses "a word for a weight" '--weights: in/word.txt:2:1: "x" is not a number' --sites random:3 --weights in/word.txt
for range in 1,0 0 0,1,2 a,1 0,nan 0,inf -1e308,1e308 ""; do
  refuses "weights from '$range'" "--random-weights" --sites random:9 --random-weights "$range"
done
fails 2 "weights without sites" "--sites" diff out/a.npy out/a.npy --weights in/weights.txt
printf 'x,y,weight,radius\n0,0,1,1\n' >in/both.csv
refuses_file both.csv "in/both.csv:1:12: the header names both"
printf 'x,y,radius\n0,0,-1\n' >in/negative.csv
refuses_file negative.csv "in/negative.csv:2:5:"

# -- Periodic domains ---------------------------------------------------------------------------------
for axes in x y xy; do
  for backend in $backends; do
    succeeds "periodic in $axes on $backend" cells --backend $backend --sites random:700 --periodic $axes --check -o out/p-$backend.csv --stats out/p.json
    grep -q "\"periodic\": \"$axes\"" out/p.json || fail "out/p.json does not say periodic"
    head -n 1 out/p-$backend.csv | grep -q ',neighbors,neighbor_shifts$' || fail "no column neighbor_shifts"
    cmp -s <(cut -d, -f1-5,10 out/p-cpu.csv) <(cut -d, -f1-5,10 out/p-$backend.csv) || fail "the cells depend on the backend"
    succeeds "periodic picture in $axes on $backend" render --backend $backend --sites random:300 --periodic $axes --size 90x60 --fit stretch --check --ids out/p-$backend.npy
    succeeds "periodic in diff, $axes on $backend" diff out/p-cpu.npy out/p-$backend.npy --sites random:300 --periodic $axes
  done
done
printf 'x,y\n0,0.5\n0.99999999999999,0.5\n' >in/seam.csv
succeeds "sites beside each other across the border" cells --backend cpu --sites in/seam.csv --domain 0,0,1,1 --periodic x --check --stats out/p.json
printf 'x,y\n.13,.93\n.85,.22\n.76,.41\n.51,.88\n.06,.67\n' >in/five.csv
for periodic in "" "--periodic x" "--periodic y" "--periodic xy"; do
  succeeds "a domain as narrow as ties '$periodic'" cells --quiet --backend cpu --sites in/five.csv --domain 0,0,1,1e-9 $periodic --check --stats out/p.json
done
for sites in random:1 random:2 random:5 square:4; do
  succeeds "periodic, $sites" cells --backend cpu --sites $sites --periodic xy --check --stats out/p.json
done
succeeds "one site fills a periodic domain" cells --backend cpu --sites random:1 --periodic xy -o out/p.csv
tail -n 1 out/p.csv | grep -q '^0,.*,ok,1,4,.*,4,0 0 0 0,' || fail "its cell is no square of four edges with itself"
succeeds "periodic with weights" cells --backend cpu --sites random:700 --periodic xy --random-weights 0,0.003 --check --stats out/p.json
succeeds "compare periodic with weights" compare --backends "${backends// /,}" --sites random:300 --periodic xy --random-weights 0,0.003 --size 90x60 --report out/r.json
grep -q '"wrong": [^0]' out/r.json && fail "pixels are wrong"
for axes in z xx yx ""; do refuses "periodic '$axes'" "--periodic" --sites random:9 --periodic "$axes"; done
fails 2 "periodic without sites" "--sites" diff out/a.npy out/a.npy --periodic x

# -- Outlines -----------------------------------------------------------------------------------------
# An L, a square with a square hole, two squares; their areas are 0.75, 0.84 and 0.18.
printf '{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,0.5],[0.5,0.5],[0.5,1],[0,1],[0,0]]]}' >in/l.geojson
printf 'POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0), (0.3 0.3, 0.7 0.3, 0.7 0.7, 0.3 0.7, 0.3 0.3))' >in/hole.wkt
printf 'MULTIPOLYGON (((0 0, 0.3 0, 0.3 0.3, 0 0.3, 0 0)), ((0.7 0.7, 1 0.7, 1 1, 0.7 1, 0.7 0.7)))' >in/two.wkt
outline() {
  local file=$1 area=$2 backend
  for backend in $backends; do
    succeeds "cells in $file on $backend" cells --backend $backend --sites random:800 --domain "in/$file" --check --stats out/o.json -o out/o-$backend.csv
    grep -Eq "\"area_sum\": $area" out/o.json || fail "area_sum is not $area: $(grep area_sum out/o.json)"
    cmp -s <(cut -d, -f1-5,10 out/o-cpu.csv) <(cut -d, -f1-5,10 out/o-$backend.csv) || fail "the cells depend on the backend"
    succeeds "a picture in $file on $backend" render --backend $backend --sites random:800 --domain "in/$file" --check --size 50x50 --ids out/o-$backend.npy -o out/o.png
    succeeds "diff in $file on $backend" diff out/o-cpu.npy out/o-$backend.npy --sites random:800 --domain "in/$file"
  done
}
outline l.geojson '(0\.75|0\.7500000000000|0\.7499999999999)'
outline hole.wkt '(0\.84|0\.8400000000000|0\.8399999999999)'
outline two.wkt '(0\.18|0\.1800000000000|0\.1799999999999)'
head -n 1 out/o-cpu.csv | grep -q ',neighbors,rings$' || fail "no column rings"
grep -q -- '-5' out/o-cpu.csv || fail "no edge belongs to the outline"
succeeds "an outline, weights" cells --backend cpu --sites random:800 --random-weights 0,0.01 --domain in/hole.wkt --check --stats out/o.json
succeeds "compare in an outline" compare --backends "${backends// /,}" --sites random:300 --random-weights 0,0.003 --domain in/l.geojson --size 90x60 --report out/r.json
grep -q '"wrong": [^0]' out/r.json && fail "pixels are wrong"
succeeds "generators fill the box of an outline" cells --backend cpu --sites square:100 --domain "$islands" --check -o out/o.csv -o out/o.npz -o out/o.geojson -o out/o.svg -o out/o.obj -o out/o.ply -o out/o.vtk -o out/o.wkt --stats out/o.json
grep -q '"polygons": 4' out/o.json || fail "out/o.json does not say how many polygons"

printf '{"type":"Polygon","coordinates":[[[0,0],[1,1],[1,0],[0,1],[0,0]]]}' >in/crossing.geojson
refuses_file_of_domain() {
  refuses "an outline, $1" "--domain: in/$1" --sites random:9 --domain "in/$1"
  grep -qF -- "$2" log/err || fail "the line does not say '$2'"
}
refuses "an outline that crosses itself" "--domain: in/crossing.geojson: Self-intersection at (0.5, 0.5)" --sites random:9 --domain in/crossing.geojson
printf '{"type":"Polygon","coordinates":[[[0,0],[1,' >in/cut.geojson
printf '{"type":"Point","coordinates":[0,0]}' >in/point.json
printf 'POLYGON ((0 0, 1 0' >in/cut.wkt
printf 'POINT (1 2)' >in/point.wkt
: >in/empty.geojson
: >in/empty.wkt
for file in cut.geojson point.json cut.wkt point.wkt empty.geojson empty.wkt missing.wkt; do refuses_file_of_domain $file ""; done
refuses "an outline that repeats itself" "--periodic: a domain with an outline" --sites random:9 --domain in/l.geojson --periodic x
refuses "an outline of an unknown kind" "--domain" --sites random:9 --domain in/good.csv

# -- Density ------------------------------------------------------------------------------------------
if has_numpy; then
  "$python" -c 'import numpy as np
np.save("in/density.npy", np.arange(12.0).reshape(3, 4))
np.save("in/one.npy", np.ones((1, 1)))
np.save("in/tall.npy", np.ones((300000, 1), dtype=np.uint8))
np.save("in/line.npy", np.ones(5))
np.save("in/negative.npy", -np.ones((2, 2)))
np.save("in/nan.npy", np.full((2, 2), np.nan))'
  succeeds "a density" cells --quiet --backend cpu --sites random:300 --density in/density.npy --check -o out/m.csv -o out/m.npz --stats out/m.json
  head -n 1 out/m.csv | grep -q ',neighbors,mass,mass_centroid_x,mass_centroid_y$' || fail "no columns of the mass"
  grep -Eq '"mass_sum": (5\.5|5\.50000000000|5\.49999999999)' out/m.json || fail "mass_sum is not 5.5: $(grep mass_sum out/m.json)"
  succeeds "a density of 1" cells --backend cpu --sites random:300 --density in/one.npy --check -o out/m.csv
  awk -F, 'NR > 1 && ($6 - $12 > 1e-12 || $12 - $6 > 1e-12) { bad = 1 } END { exit bad }' out/m.csv || fail "the mass is not the area"
  succeeds "a density with weights in an outline" cells --backend cpu --sites random:300 --random-weights 0,0.01 --domain in/hole.wkt --density in/one.npy --check --stats out/m.json
  grep -Eq '"mass_sum": (0\.84|0\.840000000000|0\.839999999999)' out/m.json || fail "mass_sum is not 0.84: $(grep mass_sum out/m.json)"
  succeeds "a density of many rows" cells --quiet --backend cpu --sites square:1 --density in/tall.npy --check --stats out/m.json
  grep -Eq '"mass_sum": (1\.0|0\.9999999999)' out/m.json || fail "mass_sum is not 1: $(grep mass_sum out/m.json)"
  for file in line.npy negative.npy nan.npy; do
    fails 2 "a density, $file" "--density: in/$file" cells --backend cpu --sites random:9 --density in/$file -o out/old.csv
  done
else
  skipped "densities of .npy" "there is no python3 with NumPy"
fi
succeeds "a picture as density" cells --quiet --backend cpu --sites random:300 --density out/a.png --check --stats out/m.json
fails 2 "a missing density" "--density: in/missing.png" cells --backend cpu --sites random:9 --density in/missing.png -o out/old.csv
fails 2 "a density of an unknown kind" "--density: in/good.csv" cells --backend cpu --sites random:9 --density in/good.csv -o out/old.csv
fails 2 "a damaged density" "--density: in/text.png" cells --backend cpu --sites random:9 --density in/text.png -o out/old.csv

finish
