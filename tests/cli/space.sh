#!/usr/bin/env bash
# Cells in space: sites, options, files and comparisons.
# Usage: space.sh VORPIPE
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
source "$here/harness.sh"

# -- Cells ----------------------------------------------------------------------------------------------
succeeds "cells in space" cells --sites random:500 --dim 3 --check -o out/cells.npz -o out/cells.csv -o out/cells.vtu \
  -o out/cells.obj -o out/cells.ply --stats out/cells.json
expect "500 cells in space (0 empty, 0 duplicate), cpu on "
expect ", checked"
[ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
grep -q '"dimension": 3' out/cells.json || fail "the dimension is not in --stats"
grep -Eq '"volume_sum": (1\.0|1\.0000000|0\.9999999)' out/cells.json || fail "volume_sum is not 1"
grep -q '"area_sum": null' out/cells.json || fail "area_sum is of the plane"
tr -d ' \n' <out/cells.json | grep -q '"domain":\[0.0,0.0,0.0,1.0,1.0,1.0\]' || fail "the domain has not six numbers"
[ "$(head -n 1 out/cells.csv)" = site,x,y,z,weight,status,volume,area,centroid_x,centroid_y,centroid_z,faces,neighbors ] ||
  fail "the header of out/cells.csv"
[ "$(wc -l <out/cells.csv)" -eq 501 ] || fail "out/cells.csv has not one row for each site"
name="the run again" cases=$((cases + 1))
run 0 rerun out/cells.json
for kind in npz csv vtu obj ply; do
  succeeds "one thread, .$kind" cells --sites random:500 --dim 3 --threads 1 --quiet -o out/one.$kind
  cmp out/cells.$kind out/one.$kind || fail "two runs differ in .$kind"
  [ -s log/out ] && fail "not quiet"
done
succeeds "measures alone" cells --sites random:500 --dim 3 --quiet --detail measures -o out/measures.npz -o out/measures.csv
cmp out/cells.csv out/measures.csv || fail "measures depend on the detail"
[ "$(stat -c %s out/measures.npz)" -lt "$(($(stat -c %s out/cells.npz) / 2))" ] || fail "measures are not less"
succeeds "standard output" cells --sites random:500 --dim 3 -o -
cmp -s log/out out/cells.csv || fail "not CSV, or not that alone"
succeeds "standard output as npz" cells --sites random:500 --dim 3 -o - --format npz
cmp -s log/out out/cells.npz || fail "not the file"
succeeds "nothing but the check" cells --sites random:100 --dim 3 --detail measures --check -o out/one.npz

# -- Sites ----------------------------------------------------------------------------------------------
for sites in sphere:200 cubic:200 bcc:200 fcc:200 hcp:200 diamond:200 a15:200; do
  succeeds "$sites is in space" cells --sites $sites --check --stats out/cells.json
  expect "cells in space (0 empty, 0 duplicate)"
done
for sites in jitter:200 clusters:200 random:1 random:2; do
  succeeds "$sites, --dim 3" cells --dim 3 --sites $sites --check --stats out/cells.json
done
succeeds "six numbers are in space" cells --sites random:200 --domain -1,2,0,1,3,9 --check -o out/one.csv
expect "200 cells in space"
# Faces of cells that touch no wall.
inner() { awk -F, 'NR > 1 && $13 !~ /-/ {print $12}' "out/$1.csv" | sort -n | uniq | tr '\n' ' '; }
lattice() {
  succeeds "$1" cells --sites "$1:$2" --check -o out/lattice.csv
  [ "$(inner lattice)" = "$3" ] || fail "cells inside have the numbers of faces $(inner lattice)"
}
lattice cubic 512 "6 "
lattice fcc 864 "12 "
lattice hcp 500 "12 "
lattice a15 512 "12 14 "
succeeds "sites of a row" cells --sites fcc:108 --quiet -o out/fcc.csv
cut -d, -f2-4 out/fcc.csv >in/fcc.csv
for more in "" "--threads 1"; do
  succeeds "a file of sites" cells --dim 3 --sites in/fcc.csv --domain 0,0,0,1,1,1 $more -o out/one.csv
  cmp out/fcc.csv out/one.csv || fail "a file has other cells than its generator"
done
succeeds "z,y,x by --columns" cells --dim 3 --sites in/fcc.csv --columns z,y,x --domain 0,0,0,1,1,1 -o out/one.csv
[ "$(awk -F, 'NR==3 {print $2 "," $4}' out/one.csv)" = "$(awk -F, 'NR==3 {print $4 "," $2}' out/fcc.csv)" ] ||
  fail "the columns are not those"
tail -n +2 in/fcc.csv | tr , ' ' >in/fcc.txt
succeeds "a text of three columns" cells --dim 3 --sites in/fcc.txt --domain 0,0,0,1,1,1 -o out/one.csv
cmp out/fcc.csv out/one.csv || fail "a text has other cells"
{ wc -l <in/fcc.txt; echo "Argon at rest"; sed 's/^/Ar /' in/fcc.txt; } >in/fcc.xyz
succeeds "a molecule's .xyz" cells --dim 3 --sites in/fcc.xyz --domain 0,0,0,1,1,1 -o out/one.csv
cmp <(cut -d, -f1-13 out/fcc.csv) <(cut -d, -f1-13 out/one.csv) || fail "an .xyz has other cells"
[ "$(awk -F, 'NR==1 || NR==9 {print $14}' out/one.csv | tr '\n' ' ')" = "element Ar " ] || fail "elements do not come back"
name="standard input" cases=$((cases + 1))
"$vorpipe" cells --dim 3 --sites - --domain 0,0,0,1,1,1 -o out/one.csv <in/fcc.csv >log/out 2>log/err || fail "refused"
cmp out/fcc.csv out/one.csv || fail "standard input has other cells"
printf 'name,x,y,z,volume\na,0,0,0,7\nb,1,0,0,8\na2,0,0,0,9\nc,5,5,5,\n' >in/four.csv
name="attributes come back" cases=$((cases + 1))
run 0 cells --dim 3 --sites in/four.csv --domain -1,-1,-1,2,1,1 --check -o out/four.csv
mentions "renamed, since other fields have these names: \"volume\" to \"input_volume\""
mentions "1 of 4 sites have no cell: they lie outside the domain"
[ "$(head -n 1 out/four.csv | cut -d, -f13-)" = neighbors,owner,name,input_volume ] || fail "the header"
grep -q '^2,0,0,0,0,duplicate,0,0,0,0,0,0,,0,a2,9$' out/four.csv || fail "the duplicate's record"
grep -q '^3,5,5,5,0,empty,' out/four.csv || fail "the record of what has no cell"
grep -q '^0,0,0,0,0,ok,6,20,-0.25,0,0,6,-7 -6 -4 -3 -1 1,0,a,7$' out/four.csv || fail "the record of a box"
notes "z in the plane" "in/four.csv: column \"z\" is no place in the plane; --dim 3 makes cells in space" \
  cells --sites in/four.csv --domain -9,-9,9,9 -o out/one.csv

# -- Weights ----------------------------------------------------------------------------------------------
succeeds "weights" cells --sites random:500 --dim 3 --random-weights 0,0.02 --check -o out/weighed.npz -o out/weighed.csv \
  -o out/weighed.vtu -o out/weighed.obj -o out/weighed.ply --stats out/weighed.json
expect " weighted cells in space ("
hidden=$(awk -F, '$6 == "empty"' out/weighed.csv | wc -l)
[ "$hidden" -gt 50 ] || fail "$hidden sites are hidden"
mentions "$hidden of 500 sites have no cell: others of larger weight hide them"
printf 'x,y,z,weight\n0,0,0,1\n0.5,0,0,0\n9,0,0,0\n' >in/outside.csv
name="hidden, and outside" cases=$((cases + 1))
run 0 cells --dim 3 --sites in/outside.csv --domain -1,-1,-1,1,1,1 --check -o out/one.csv
mentions "1 of 3 sites have no cell: others of larger weight hide them"
mentions "1 of 3 sites have no cell: they lie outside the domain"
grep -q "\"hidden\": $hidden" out/weighed.json || fail "--stats does not say how many are hidden"
tr -d ' \n' <out/weighed.json | grep -Eq '"weights":\[[0-9.e-]+,0\.01[0-9]*\]' || fail "--stats has no weights"
grep -Eq '"volume_sum": (1\.0|1\.0000000|0\.9999999)' out/weighed.json || fail "volume_sum is not 1"
name="the run with weights again" cases=$((cases + 1))
run 0 rerun out/weighed.json
for kind in npz csv vtu; do
  succeeds "weights on one thread, .$kind" cells --sites random:500 --dim 3 --random-weights 0,0.02 --threads 1 --quiet -o out/one.$kind
  cmp out/weighed.$kind out/one.$kind || fail "two runs with weights differ in .$kind"
done
cut -d, -f2-5 out/weighed.csv >in/weighed.csv
weighs() {
  name=$1 cases=$((cases + 1))
  shift
  run 0 cells --dim 3 --domain 0,0,0,1,1,1 "$@" -o out/one.csv
  cmp <(cut -d, -f1-13 out/weighed.csv) <(cut -d, -f1-13 out/one.csv) || fail "other cells than by --random-weights"
}
weighs "a column of weights" --sites in/weighed.csv --check
sed '1s/weight/w/' in/weighed.csv >in/w.csv
weighs "a column w" --sites in/w.csv
mentions '"w" is taken as weight; --columns names others'
sed '1s/.*/a,b,c,d/' in/weighed.csv >in/named.csv
weighs "--columns of weights" --sites in/named.csv --columns a,b,c,d
tail -n +2 in/weighed.csv >in/bare.csv
weighs "weights without a header" --sites in/bare.csv
mentions "columns 1 to 4 are taken as x, y, z and weights; --columns 1,2,3 leaves 4 out"
tr , ' ' <in/bare.csv >in/bare.txt
weighs "a text of four columns" --sites in/bare.txt
mentions "the fourth column is taken as weights; --columns 1,2,3 leaves it out"
cut -d, -f1-3 in/bare.csv >in/places.csv
cut -d, -f4 in/bare.csv >in/weights.txt
weighs "--weights" --sites in/places.csv --weights in/weights.txt
name="weights left out" cases=$((cases + 1))
run 0 cells --dim 3 --domain 0,0,0,1,1,1 --sites in/bare.csv --columns 1,2,3 -o out/one.csv
cmp <(cut -d, -f7 out/cells.csv) <(cut -d, -f7 out/one.csv) || fail "cells differ from those without weights"
printf 'x,y,z,radius\n0,0,0,2\n4,0,0,0\n' >in/radii.csv
succeeds "radii" cells --dim 3 --sites in/radii.csv --domain -1,-1,-1,5,1,1 --check -o out/one.csv
[ "$(awk -F, 'NR > 1 {print $5 " " $7}' out/one.csv | tr '\n' ' ')" = "4 14 0 10 " ] || fail "radii are not squared"
if has_numpy; then
  "$python" -c 'import numpy as np
np.save("in/weighed.npy", np.loadtxt("in/bare.txt"))'
  weighs "an array of four columns" --sites in/weighed.npy
  name="other programs read cells with weights" cases=$((cases + 1))
  "$python" "$here/space_readers.py" out/weighed >log/out 2>log/err || fail "they do not"
fi

# -- Periods ----------------------------------------------------------------------------------------------
succeeds "periods along all axes" cells --dim 3 --sites random:300 --periodic xyz --check -o out/period.npz -o out/period.csv \
  -o out/period.vtu -o out/period.obj -o out/period.ply --stats out/period.json
expect "300 cells in space (0 empty, 0 duplicate)"
grep -q '"periodic": "xyz"' out/period.json || fail "the period is not in --stats"
[ "$(head -n 1 out/period.csv)" = \
  site,x,y,z,weight,status,volume,area,centroid_x,centroid_y,centroid_z,faces,neighbors,neighbor_shifts ] ||
  fail "the header of out/period.csv"
cut -d, -f13 out/period.csv | grep -q -- - && fail "there are walls"
cp out/period.npz out/before.npz
name="the run of a period again" cases=$((cases + 1))
run 0 rerun out/period.json
cmp out/before.npz out/period.npz || fail "another file"
succeeds "one thread with periods" cells --dim 3 --sites random:300 --periodic x,y,z --threads 1 -o out/one.npz
cmp out/period.npz out/one.npz || fail "threads change cells with periods"
succeeds "periods along two axes" cells --dim 3 --sites random:300 --periodic xz --check -o out/one.csv
[ "$(cut -d, -f13 out/one.csv | tr ' ' '\n' | grep -- - | sort -u | tr '\n' ' ')" = "-3 -4 " ] || fail "not the walls of y"
# Each cell of a crystal that repeats has all of its faces.
for crystal in "cubic:64 6" "fcc:108 12" "bcc:128 14"; do
  read -r sites faces <<<"$crystal"
  succeeds "$sites repeats" cells --sites "$sites" --periodic xyz --check -o out/one.csv
  [ "$(awk -F, 'NR > 1 {print $12}' out/one.csv | sort -u)" = "$faces" ] || fail "not $faces faces each"
done
printf 'x,y,z\n0.3,7,0.1\n' >in/one.csv
succeeds "one site of a lattice" cells --sites in/one.csv --lattice 0,0.5,0.5,0.5,0,0.5,0.5,0.5,0 --check -o out/one.csv \
  --stats out/one.json
[ "$(awk -F, 'NR > 1 {print $7, $12}' out/one.csv)" = "0.25 12" ] || fail "not the cell of a crystal"
tr -d ' \n' <out/one.json | grep -q '"domain":null' || fail "a lattice has a domain"
tr -d ' \n' <out/one.json | grep -q '"lattice":\[\[0.0,0.5,0.5\],' || fail "the lattice is not in --stats"
succeeds "sites drawn over a lattice" cells --dim 3 --sites random:200 --lattice 1,0,0,100,1,0,0,0,2 --check \
  --random-weights 0,0.02 -o out/one.npz --stats out/one.json
grep -Eq '"volume_sum": (2\.0|1\.9999999|2\.0000000)' out/one.json || fail "volumes do not add up"
printf 'x,y,z\n0,0.5,0.5\n1,0.5,0.5\n0.5,-3.5,0.5\n' >in/ends.csv
succeeds "sites at both ends" cells --dim 3 --sites in/ends.csv --domain 0,0,0,1,1,1 --periodic xyz --check -o out/one.csv
expect "2 cells in space (0 empty, 1 duplicate)"
if has_numpy; then
  name="other programs read cells with periods" cases=$((cases + 1))
  "$python" "$here/space_readers.py" out/period >log/out 2>log/err || fail "they do not"
fi
fails 2 "z in the plane" "--periodic: z is an axis of space" cells --sites random:9 --periodic xz -o out/old.csv

# -- Refusals ---------------------------------------------------------------------------------------------
refuses_space() {
  local text=$1
  shift
  fails 2 "$*" "$text" cells "$@" -o out/old.csv
}
refuses_space "--dim: \"4\" is neither 2 nor 3" --sites random:9 --dim 4
refuses_space "--sites: fcc:0: \"0\" is not a number of sites" --sites fcc:0
refuses_space "--sites: hex:9: is neither a file nor a generator in space (random, jitter, clusters, sphere" --sites hex:9 --dim 3
refuses_space "a generator needs a number of sites, as in random:1000" --sites random --dim 3
refuses_space "--domain: in space it has six numbers" --sites fcc:9 --domain 0,0,1,1
refuses_space "--domain: zmin 3 is not below zmax 1" --sites random:9 --domain 0,0,3,1,1,1
refuses_space "--domain: the domain in space is a box" --sites fcc:9 --domain hull
refuses_space "--domain: sites that repeat by --lattice have none" --sites fcc:9 --lattice 1,0,0,0,1,0,0,0,1 \
  --domain 0,0,0,1,1,1
refuses_space "--periodic: sites repeat by --lattice already" --sites fcc:9 --lattice 1,0,0,0,1,0,0,0,1 --periodic x
refuses_space "--margin: sites that repeat by --lattice have no domain" --sites fcc:9 --lattice 1,0,0,0,1,0,0,0,1 --margin 1
refuses_space "--lattice: the lattice 1,0,0,0,1,0,1,1,0 has vectors that lie in a plane" --sites fcc:9 \
  --lattice 1,0,0,0,1,0,1,1,0
refuses_space "is not nine numbers" --sites fcc:9 --lattice 1,0,0
refuses_space "--periodic" --sites fcc:9 --periodic zx
refuses_space "--periodic: name the period by --domain" --dim 3 --sites in/fcc.csv --periodic xyz
refuses_space "--globe: cells are either on the globe or in space" --sites fcc:9 --globe
refuses_space "--random-weights: is for generators; give in/fcc.csv its weights by --weights or a column" \
  --dim 3 --sites in/fcc.csv --random-weights 0,1
refuses_space "--backend: cells in space are found on the CPU" --sites fcc:9 --backend vulkan
refuses_space "--search: cells in space are found on the grid alone" --sites fcc:9 --search flann
refuses_space "--only-cells" --sites fcc:9 --only-cells
refuses_space "--margin: is for the box around a file's sites" --sites fcc:9 --margin 1
fails 2 "edges" "--edges: the edges of cells in space are in .vtu" cells --sites fcc:9 --edges out/old.csv
fails 2 "a file of the plane" "known are .npz, .csv, .vtu, .obj, .ply" cells --sites fcc:9 -o out/old.geojson
fails 2 "measures of a mesh" "--detail: measures alone go to .npz and .csv" cells --sites fcc:9 --detail measures -o out/old.vtu
fails 2 "a kind of the plane" "--format: \"svg\" is no kind of file for cells in space" cells --sites fcc:9 -o - --format svg
fails 2 "memory" "some " cells --sites random:100000000 --dim 3 --memory-limit 1GB -o out/old.npz
mentions "-o FILE.npz --detail measures"
printf 'x,y,z,radius\n0,0,0,1\n1,1,1,-1\n' >in/radius.csv
refuses_space "in/radius.csv:3:7: \"-1\" is negative, and a radius (column radius)" --dim 3 --sites in/radius.csv
printf 'x,y,z,weight\n0,0,0,1\n1,1,1,0\n' >in/weight.csv
refuses_space "--weights: in/weight.csv has weights of its own" --dim 3 --sites in/weight.csv --weights in/weight.csv
printf '1\n2\n' >in/two.txt
refuses_space "--weights: in/two.txt:3:1: the file ends after 2 weights, there are 108 sites" --sites fcc:108 --weights in/two.txt
refuses_space "--sites: in/weight.csv:1:1: 2 columns are chosen; x, y and z are 3" --dim 3 --sites in/weight.csv --columns x,y
printf 'x,y\n0,0\n' >in/plane.csv
refuses_space "names no column \"z\"" --dim 3 --sites in/plane.csv
printf 'x,y,z\n0,0,0\n1,1,nan\n' >in/nan.csv
refuses_space "in/nan.csv:3:5" --dim 3 --sites in/nan.csv
printf '3\nshort\nH 0 0 0\nH 1 1 1\n' >in/short.xyz
refuses_space "in/short.xyz: ends after 2 of 3 sites" --dim 3 --sites in/short.xyz
printf 'POINT (0 0)' >in/point.wkt
refuses_space "a .wkt has sites in the plane; sites in space are read from .csv, .tsv, .npy, .xyz, .txt" --dim 3 --sites in/point.wkt
printf 'x,y,z\n0,0,5\n1,0,5\n' >in/flat.csv
refuses_space "--margin: the sites lie in a plane" --dim 3 --sites in/flat.csv --margin 0
succeeds "sites in a plane" cells --dim 3 --sites in/flat.csv --check -o out/one.csv
for subcommand in "render -o out/old.png" "relax -o out/old.csv" "compare --backends cpu,opengl"; do
  fails 2 "$subcommand in space" "there are \`cells\` alone" $subcommand --sites fcc:9
  fails 2 "$subcommand in a box" "there are \`cells\` alone" $subcommand --sites random:9 --domain 0,0,0,1,1,1
done

# -- Comparisons ------------------------------------------------------------------------------------------
succeeds "equal cells" diff out/cells.npz out/measures.npz
expect "out/cells.npz and out/measures.npz: 500 cells equal"
succeeds "other cells" cells --sites random:500 --seed 2 --dim 3 --quiet -o out/other.npz
fails 1 "different cells" "500 lists of neighbors and 500 volumes differ, first at sites 0, 1, " diff out/cells.npz out/other.npz
succeeds "cells in the plane" cells --sites random:500 --backend cpu --quiet -o out/plane.npz
succeeds "equal cells in the plane" diff out/plane.npz out/plane.npz
fails 2 "plane and space" "out/plane.npz has cells in the plane, out/cells.npz in space" diff out/plane.npz out/cells.npz
fails 2 "a picture of cells" "-o: is for pictures and ids" diff out/plane.npz out/plane.npz -o out/old.png

# -- Read back by others ------------------------------------------------------------------------------------
if has_numpy; then
  name="other programs read the files" cases=$((cases + 1))
  "$python" "$here/space_readers.py" out/cells >log/out 2>log/err || fail "they do not"
  grep -q SKIPPED log/out && skipped "VTK reads the cells" "there is no VTK for $python"
else
  skipped "other programs read the files" "there is no python3 with NumPy"
fi

finish
