#!/usr/bin/env bash
# Sites that move: methods, files on the way and at the end, what is refused, what Ctrl-C leaves.
# Usage: relax.sh VORPIPE SPHERES.PY
spheres=$2
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# -- Methods --------------------------------------------------------------------------------------------
for backend in $backends; do
  succeeds "relax on $backend" relax --backend $backend --sites random:500 --iterations 5 -o out/$backend.csv
  expect "out/$backend.csv: 500 unweighted cells (0 empty, 0 duplicate), energy "
  expect " after 5 diagrams (iterations), $backend on "
done
succeeds "Lloyd's steps" relax --backend cpu --sites random:500 --method lloyd --iterations 5 --trace out/trace.csv
[ "$(head -n 1 out/trace.csv)" = diagram,energy,hexagonal,farthest,seconds,taken ] || fail "the header of the trace"
[ "$(wc -l <out/trace.csv)" -eq 7 ] || fail "not one row for each diagram"
awk -F, 'NR > 2 && $2 >= before { exit 1 } { before = $2 }' out/trace.csv || fail "the energy rises"
succeeds "a tolerance" relax --backend cpu --sites hex:500 --periodic x --tolerance 0.9 -o out/hex.csv
expect " after 0 diagrams (tolerance)"

# -- Files ----------------------------------------------------------------------------------------------
files="-o out/a.csv -o out/a.txt -o out/a.npy -o out/a.geojson -o out/a.geojsonl -o out/a.gpkg -o out/a.wkt"
printf 'name,x,y,weight\nEast,3,1,0\n"West, far",0,0,0.5\nNorth,1,4,0\n' >in/named.csv
succeeds "every kind of file" relax --backend cpu --sites in/named.csv --domain 0,0,4,5 $files --cells out/a.npz --cells out/a-cells.csv \
  --picture out/a.png --picture out/a.svg --stats out/a.json --trace out/a-trace.csv
[ "$(head -n 1 out/a.csv)" = x,y,weight,name ] || fail "the header of a.csv"
grep -q ',0.5,"West, far"$' out/a.csv || fail "a.csv has not the attributes"
grep -q '"end": "iterations"' out/a.json || grep -q '"end": "stagnated"' out/a.json || fail "the stats have no end"
mkdir twice && cp -r out/. twice
succeeds "again" rerun --quiet out/a.json
cmp out/a.npz twice/a.npz || fail "a run that is done again differs"
for kind in csv txt npy geojson geojsonl gpkg; do
  name="a.$kind is read back"
  cases=$((cases + 1))
  run 0 cells --backend cpu --sites out/a.$kind --domain 0,0,4,5 -o out/back-$kind.npz
  cmp -s out/a.npz out/back-$kind.npz || fail "other cells than those of the run"
done
succeeds "threads" relax --backend cpu --threads 1 --sites clusters:2000 --iterations 6 -o out/one.npy
succeeds "more threads" relax --backend cpu --threads 3 --sites clusters:2000 --iterations 6 -o out/three.npy
cmp out/one.npy out/three.npy || fail "threads change places"
succeeds "files on the way" relax --backend cpu --sites random:50 --iterations 4 --save-every 2 -o out/way.csv --picture out/way.png --size 50
for number in 0000 0002 0004; do
  [ -s out/way-$number.csv ] && [ -s out/way-$number.png ] || fail "there is no number $number"
done
[ -e out/way-0003.csv ] && fail "a number that was not asked for"
cmp -s out/way.csv out/way-0004.csv || fail "the last numbered file is another"
succeeds "frames" relax --backend cpu --sites random:50 --iterations 4 --frames out/film --size 50 --edges --stats out/film.json
[ "$(ls out/film | wc -l)" -eq 5 ] || fail "not a picture of each diagram"
succeeds "the first picture" render --backend cpu --sites random:50 --size 50 --edges -o out/first.png
cmp -s out/film/frame-00001.png out/first.png || fail "the first frame is another picture"
succeeds "the last picture" relax --backend cpu --sites random:50 --iterations 4 --picture out/last.png --size 50 --edges
cmp -s out/film/frame-00005.png out/last.png || fail "the last frame is another picture"
run 0 relax --backend cpu --sites random:5 --iterations 1 -o -
[ "$(wc -l <log/out)" -eq 6 ] || fail "standard output has not the sites"

# -- Densities ------------------------------------------------------------------------------------------
sed 's/^WIDTH, HEIGHT = .*/WIDTH, HEIGHT = 160, 120/' "$spheres" >in/spheres.py
"$python" in/spheres.py in/spheres.png || fail "there is no picture"
succeeds "a stipple" relax --backend cpu --sites density:800 --density in/spheres.png --equal-masses --iterations 30 --cells out/mass.csv
awk -F, 'NR > 1 { mass[NR] = $12; sum += $12 } END { for (k in mass) { part = mass[k] * (NR - 1) / sum; if (part > 0.85 && part < 1.15) near++ }
  exit near < 0.9 * (NR - 1) }' out/mass.csv || fail "masses are not equal"

# -- On the globe ---------------------------------------------------------------------------------------
sides() { # sides FILE.csv: how many cells have 5, 6 and other numbers of neighbors
  awk -F, 'NR > 1 { n = split($NF, of, " "); if (n == 5) five++; else if (n == 6) six++; else others++ }
    END { print five + 0, six + 0, others + 0 }' "$1"
}
succeeds "a geodesic grid" relax --backend cpu --globe --sites icosahedral:2562 --iterations 20 --cells out/grid.csv --stats out/grid.json \
  -o out/grid-sites.csv -o out/grid-sites.npy --trace out/grid-trace.csv
expect " of the hexagonal lattice's) after 20 diagrams (iterations)"
[ "$(sides out/grid.csv)" = "12 2550 0" ] || fail "not 12 pentagons and hexagons: $(sides out/grid.csv)"
[ "$(head -n 1 out/grid-sites.csv)" = lon,lat ] || fail "the sites are not in degrees"
cp out/grid-sites.csv in/grid-sites.csv && cp out/grid.csv in/grid.csv
succeeds "again on the globe" rerun --quiet out/grid.json
cmp out/grid-sites.csv in/grid-sites.csv || fail "a run that is done again differs"
succeeds "its cells" cells --backend cpu --globe --sites out/grid-sites.npy --check -o out/grid-cells.csv
[ "$(sides out/grid-cells.csv)" = "12 2550 0" ] || fail "the sites that were written have other cells"
succeeds "Lloyd's steps on the globe" relax --backend cpu --globe --sites random:2562 --method lloyd --iterations 100 --cells out/even.csv \
  --trace out/even-trace.csv
awk -F, 'NR > 2 && $2 >= before { exit 1 } { before = $2 }' out/even-trace.csv || fail "the energy rises on the globe"
sides out/even.csv | awk '{ exit $2 < 0.75 * 2562 }' || fail "not 75 % hexagons"
succeeds "sites from a density of the Earth" relax --backend cpu --globe --sites density:300 --density in/spheres.png \
  --density-box 0,-90,360,90 --iterations 3 --threads 1 -o out/earth-1.npy
succeeds "by two threads" relax --backend cpu --globe --sites density:300 --density in/spheres.png \
  --density-box 0,-90,360,90 --iterations 3 --threads 2 -o out/earth-2.npy
cmp out/earth-1.npy out/earth-2.npy || fail "threads change places on the globe"
succeeds "pictures of the globe" relax --backend cpu --globe --sites random:200 --iterations 3 --frames out/earth --map equal-earth --size 200 \
  --edges --graticule 30 --picture out/earth.png -o out/earth.csv
[ "$(ls out/earth | wc -l)" = 4 ] || fail "not a frame for each diagram: $(ls out/earth)"
succeeds "their last" render --backend cpu --globe --sites out/earth.csv --columns lon,lat --map equal-earth --size 200 --edges --graticule 30 -o out/last.png
cmp out/earth.png out/last.png || fail "a picture of relaxed sites is not that of their file"
cmp "$(ls out/earth/* | tail -n 1)" out/last.png || fail "the last frame is another picture"

# -- Refusals -------------------------------------------------------------------------------------------
wrong() {
  local what=$1 text=$2
  shift 2
  fails 2 "$what" "$text" relax --backend cpu "$@"
}
wrong "nothing to write" "-o: name what to write" --sites random:9
wrong "a picture as sites" "--picture out/old.png" --sites random:9 -o out/old.png
wrong "cells as sites" "--cells out/old.npz" --sites random:9 -o out/old.npz
mkdir -p in/full && touch in/full/a
wrong "frames among others" "--frames: in/full" --sites random:9 --frames in/full
for film in gif AVI webm; do wrong "a film that is none" "--frames: \"in/q.$film\" is the name of a file that is no film; name an .mp4 or a folder" --sites random:9 --frames in/q.$film; done
[ -e in/q.gif ] && fail "there is a folder"
wrong "numbers of nothing" "--save-every: there is no" --sites random:9 --save-every 2 --trace out/old.csv
wrong "a number that the trace has" "t-0001.csv: is the same output file as" --sites random:9 --iterations 3 \
  --save-every 1 -o in/t.csv --trace in/t-0001.csv
wrong "numbers of standard output" "--save-every: standard output" --sites random:9 --save-every 2 -o -
wrong "a method" '--method: "newton" is not lbfgs or lloyd' --sites random:9 --method newton -o out/old.csv
wrong "a tolerance" "--tolerance: -1" --sites random:9 --tolerance -1 -o out/old.csv
wrong "no density to draw from" "--density" --sites density:9 -o out/old.csv
printf '\x93NUMPY\1\0\x76\0%-117s\n\0\0\0\0' "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1), }" >in/nothing.npy
wrong "a density of nothing" "--density: has no mass to draw sites from" --sites density:9 --density in/nothing.npy -o out/old.csv
wrong "no number" "density:x" --sites density:x --density in/spheres.png -o out/old.csv
wrong "masses of nothing" "--equal-masses: is for a --density" --sites random:9 --equal-masses -o out/old.csv
wrong "a number of no grid" "no geodesic grid has 100 places: they have 10 k^2 + 2, and next to it are 92 and 162" --globe \
  --sites icosahedral:100 -o out/old.csv
wrong "a grid without the globe" "icosahedral:42 is of the whole Earth, and takes --globe" --sites icosahedral:42 -o out/old.csv
wrong "a map of a plane" "--map: is for --globe" --sites random:9 --map equal-earth --picture out/old.png
wrong "a domain on the globe" "--domain: with --globe" --globe --sites random:9 --domain 0,0,1,1 -o out/old.csv
wrong "equal masses on the globe" "--equal-masses: are of a plane" --globe --sites random:9 --equal-masses --density in/spheres.png \
  -o out/old.csv
wrong "a density beyond the globe" "is not on the globe" --globe --sites random:9 --density in/spheres.png --density-box 0,0,400,90 \
  -o out/old.csv
wrong "too little memory" "--memory-limit" --sites random:100000 --memory-limit 20MB -o out/old.csv

# -- Ctrl-C ---------------------------------------------------------------------------------------------
name="Ctrl-C leaves what was reached"
cases=$((cases + 1))
"$vorpipe" relax --backend cpu --sites random:3000 --method lloyd --iterations 100000 --save-every 1 -o out/cut.csv >log/out 2>log/err &
pid=$!
while [ ! -e out/cut-0002.csv ] && kill -0 $pid 2>/dev/null; do :; done
kill -INT $pid
wait $pid
[ $? -eq 130 ] || fail "not the exit code of an interrupted run"
one_line
grep -q 'interrupted: the files have the sites after' log/err || fail "it does not say what the files have"
[ "$(wc -l <out/cut.csv)" -eq 3001 ] || fail "the file is not whole"
[ -z "$(find out -name '.vorpipe-*')" ] || fail "a temporary file is left"

finish
