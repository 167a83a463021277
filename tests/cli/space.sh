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
refuses_space "--periodic: the domain in space does not repeat itself" --sites fcc:9 --periodic xy
refuses_space "--globe: cells are either on the globe or in space" --sites fcc:9 --globe
refuses_space "--random-weights: cells in space have no weights" --sites fcc:9 --random-weights 0,1
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
printf 'x,y,z,radius\n0,0,0,1\n' >in/radius.csv
refuses_space "in/radius.csv:1:7: column \"radius\" would weigh the sites" --dim 3 --sites in/radius.csv
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
