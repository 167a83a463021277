#!/usr/bin/env bash
# Masses that are prescribed: files in and out, how runs end, what is refused, what Ctrl-C leaves.
# Usage: transport.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# worst FILE.json LIMIT: the worst cell of the run is off by no more of its mass.
worst() {
  awk -v limit="$2" '/"worst":/ { sub(/,/, "", $2); found = $2 + 0 <= limit } END { exit !found }' "$1" ||
    fail "the worst cell of $1 is off by more than $2: $(grep worst "$1")"
}
# same_areas FILE.csv PART: areas of cells, which add up to 1, are equal to this part of them.
same_areas() {
  awk -F, -v part="$2" 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "area") area = k }
    NR > 1 { a[NR] = $area } END { for (k in a) { off = a[k] * (NR - 1) - 1; if (off > part || off < -part) exit 1 } }' "$1" ||
    fail "areas in $1 are not equal"
}

# -- Equal masses ---------------------------------------------------------------------------------------
for backend in $backends; do
  succeeds "equal areas on $backend" transport --backend $backend --sites random:300 -o out/$backend.csv --stats out/$backend.json
  expect "300 weighted cells (0 empty, 0 duplicate), worst cell off by "
  expect " diagrams (converged), $backend on "
  worst out/$backend.json 1e-8
done
succeeds "files of a run" transport --backend cpu --sites random:300 -o out/a.csv -o out/a.npy --cells out/a.npz \
  --cells out/a-cells.csv --picture out/a.png --picture out/a.svg --size 100 --trace out/trace.csv --stats out/a.json \
  --save-weights out/w.npy
same_areas out/a-cells.csv 1e-8
[ "$(head -n 1 out/trace.csv)" = diagram,newton,length,taken,norm,worst,least,linear_iterations,seconds ] ||
  fail "the header of the trace"
awk -F, 'NR > 1 && $4 && $5 >= before && before { exit 1 } NR > 1 && $4 { before = $5 }' out/trace.csv ||
  fail "what is left grows"
[ "$(head -n 1 out/a.csv)" = x,y,weight ] || fail "the header of the sites"
mkdir twice && cp -r out/. twice
succeeds "again" rerun --quiet out/a.json
cmp out/a.npz twice/a.npz || fail "a run that is done again differs"
for kind in csv; do
  succeeds "a.$kind is read back" cells --backend cpu --sites out/a.$kind --domain 0,0,1,1 -o out/back.npz
  cmp out/a.npz out/back.npz || fail "other cells than those of the run"
done
for kind in npy csv txt; do
  succeeds "weights as .$kind" transport --backend cpu --sites random:300 --save-weights out/weights.$kind
  succeeds "weights from .$kind" transport --backend cpu --sites random:300 --weights out/weights.$kind --trace out/none.csv
  expect "after 0 Newton steps, 1 diagrams (converged)"
  [ "$(wc -l <out/none.csv)" -eq 2 ] || fail "something was left to do"
done
succeeds "threads" transport --backend cpu --threads 1 --sites clusters:2000 --save-weights out/one.npy
succeeds "more threads" transport --backend cpu --threads 3 --sites clusters:2000 --save-weights out/three.npy
cmp out/one.npy out/three.npy || fail "threads change weights"
succeeds "sites that repeat themselves" transport --backend cpu --sites random:100 --periodic xy --cells out/periodic.csv
same_areas out/periodic.csv 1e-8

# -- Masses ---------------------------------------------------------------------------------------------
printf 'share\n1\n2 # the second\n3\n4\n' >in/shares.csv
printf 'x,y,people\n0,0,10\n1,0,20\n0,1,30\n1,1,40\n' >in/towns.csv
box="--domain -1,-1,2,2"
succeeds "masses of a file" transport --backend cpu --sites in/towns.csv $box --masses in/shares.csv --normalize --cells out/file.csv
succeeds "masses of an attribute" transport --backend cpu --sites in/towns.csv $box --masses @people --normalize --cells out/attribute.csv
cut -d, -f6 out/attribute.csv | sed 1d | paste -sd' ' | awk '{ exit !($2 / $1 > 1.99999 && $2 / $1 < 2.00001 && $4 / $1 > 3.99999 && $4 / $1 < 4.00001) }' ||
  fail "areas are not as the masses"
printf 'x,y,people\n0,0,10\n1,0,20\n.5,.5,0\n0,1,30\n1,1,40\n' >in/empty.csv
name="sites without mass are left out"
cases=$((cases + 1))
run 0 transport --backend cpu --sites in/empty.csv $box --masses @people --normalize --skip-zero \
  --cells out/skipped.csv
grep -qF 'note: --skip-zero: 1 of 5 sites, whose mass is 0, are left out' log/err || fail "it does not say so"
cmp out/skipped.csv out/attribute.csv || fail "other cells than those of the others"
printf '1\n2\n0\n3\n4\n' >in/zero.txt
succeeds "of a file as well" transport --backend cpu --quiet --sites in/empty.csv $box --masses in/zero.txt --normalize --skip-zero --cells out/zero.csv
cmp out/zero.csv out/attribute.csv || fail "other cells than those of the others"
printf '0.1\n0.2\n0.3\n0.4\n' >in/whole.txt
succeeds "masses that add up" transport --backend cpu --sites random:4 --masses in/whole.txt -o out/whole.csv
succeeds "a free surface" transport --backend cpu --sites random:200 --fill 0.5 --cells out/free.csv --stats out/free.json --picture out/free.svg \
  --picture out/free.png --size 80
awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "area") area = k } NR > 1 && ($area < 0.00249999 || $area > 0.00250001) { exit 1 }' \
  out/free.csv || fail "areas are not those of the drops"
grep -q 'A' out/free.svg || fail "there are no arcs"
worst out/free.json 1e-8
grep -q '"surface": "free"' out/free.json || fail "the stats do not say so"

# -- Runs that end early --------------------------------------------------------------------------------
name="too few diagrams"
cases=$((cases + 1))
run 1 transport --backend cpu --sites random:300 --diagrams 2 -o out/few.csv --stats out/few.json
one_line
grep -q 'not converged: the files have what was reached after 2 diagrams' log/err || fail "it does not say what was reached"
[ "$(wc -l <out/few.csv)" -eq 301 ] || fail "the file is not whole"
grep -q '"end": "diagrams"' out/few.json || fail "the stats have no end"
name="what rounding allows"
cases=$((cases + 1))
run 1 transport --backend cpu --sites random:300 --tolerance 1e-18 -o out/round.csv --stats out/round.json
worst out/round.json 1e-12
name="Ctrl-C leaves what was reached"
cases=$((cases + 1))
"$vorpipe" transport --backend cpu --sites random:50000 --domain -100,-100,1,1 --quiet -o out/cut.csv >log/out 2>log/err &
pid=$!
while ! find out -name '.vorpipe-*' | grep -q . && kill -0 $pid 2>/dev/null; do :; done
kill -INT $pid
wait $pid
[ $? -eq 130 ] || fail "not the exit code of an interrupted run"
one_line
grep -q 'interrupted' log/err || fail "it does not say so"
[ -z "$(find out -name '.vorpipe-*')" ] || fail "a temporary file is left"

# -- Refusals -------------------------------------------------------------------------------------------
wrong() {
  local what=$1 text=$2
  shift 2
  fails 2 "$what" "$text" transport --backend cpu "$@"
}
masses() { printf '%s\n' "$@" >in/masses.txt; }
wrong "nothing to write" "-o: name what to write" --sites random:9
wrong "a sum" "--masses: they add up to 10, the mass of the domain to 9; --normalize scales them" \
  --sites in/towns.csv $box --masses in/shares.csv -o out/old.csv
wrong "too much" "more than the 9 of the domain; --fill V scales them" \
  --sites in/towns.csv $box --masses in/shares.csv --surface free -o out/old.csv
masses 1 2 -3
wrong "a negative mass" '--masses: in/masses.txt:3:1: "-3" is negative' --sites random:3 --masses in/masses.txt -o out/old.csv
masses 1 0 3
wrong "no mass" '--masses: in/masses.txt:2:1: "0" is no mass: it must be more than 0; --skip-zero leaves such sites out' \
  --sites random:3 --masses in/masses.txt -o out/old.csv
wrong "an attribute as a file" "--masses: people: unknown kind of file for masses; known are .txt, .csv and .npy; @people is the attribute of the sites" \
  --sites in/towns.csv $box --masses people --normalize -o out/old.csv
wrong "nothing to leave out" "--skip-zero: is for what --masses names" --sites random:3 --skip-zero -o out/old.csv
masses 1 nan 3
wrong "no number" 'in/masses.txt:2:1: "nan" is not a finite number' --sites random:3 --masses in/masses.txt -o out/old.csv
masses 1 0 3
wrong "no mass" 'in/masses.txt:2:1: "0" is no mass' --sites random:3 --masses in/masses.txt -o out/old.csv
masses 1 2
wrong "too few masses" "ends after 2 masses, there are 3 sites" --sites random:3 --masses in/masses.txt -o out/old.csv
wrong "no attribute" '--masses: there is no attribute "size"; known are people' --sites in/towns.csv --masses @size -o out/old.csv
printf 'x,y,people\n0,0,10\n1,0,\n0,1,30\n' >in/gap.csv
wrong "a gap" '--sites: in/gap.csv:3:5: empty field; --missing skip leaves such rows out (column people)' --sites in/gap.csv --masses @people -o out/old.csv
printf 'x,y,people\n0,0,10\n1,0,NA\n0,1,-3\n' >in/negative.csv
wrong "a mass that is negative" '--sites: in/negative.csv:4:5: "-3" is negative, and a mass (column people)' \
  --sites in/negative.csv --missing skip --masses @people -o out/old.csv
printf 'x,y,people\n0,0,10\n1,0,0\n' >in/none.csv
wrong "no mass of an attribute" 'in/none.csv:3:5: "0" is no mass: it must be more than 0; --skip-zero leaves such sites out (column people)' \
  --sites in/none.csv --masses @people -o out/old.csv
printf '{"type":"FeatureCollection","features":[%s,%s,%s]}' \
  '{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[0,0]}}' \
  '{"type":"Feature","properties":{"people":2},"geometry":{"type":"Point","coordinates":[0,1]}}' \
  '{"type":"Feature","properties":{"people":null},"geometry":{"type":"Point","coordinates":[1,1]}}' >in/gap.geojson
wrong "a gap at first" 'has "people", and those before it have none' --sites in/gap.geojson --masses @people -o out/old.csv
name="gaps are left out"
printf 'x;y;people\n0;0;1,5\n1;0;None\n0;1;2,25\n2;2;NA\n' >in/gaps.csv
run 0 transport --backend cpu --sites in/gaps.csv --missing skip --masses @people --normalize -o out/gaps.csv
grep -qF 'in/gaps.csv: 2 rows without a place or a weight or "people" are left out' log/err || fail "it does not say so"
[ "$(wc -l <out/gaps.csv)" -eq 3 ] || fail "not two sites"
run 0 transport --backend cpu --sites in/gap.geojson --domain 0,0,1,1 --missing skip --masses @people --normalize -o out/gap.csv
[ "$(wc -l <out/gap.csv)" -eq 2 ] || fail "not one site"
rm out/gaps.csv out/gap.csv
printf 'x,y\n0,0\n1,0\n0,0\n' >in/twice.csv
wrong "two sites at one place" "sites 0 and 2 (counted from 0)" --sites in/twice.csv -o out/old.csv
wrong "nothing to scale" "--normalize: scales what --masses names" --sites random:9 --normalize -o out/old.csv
wrong "a surface without masses" "--surface: equal masses do not say" --sites random:9 --surface free -o out/old.csv
wrong "sites over air" "--picture: with a free surface" --sites random:9 --fill 0.5 --picture out/old.png --show-sites
wrong "too full" "--fill: 2 is not a part" --sites random:9 --fill 2 -o out/old.csv
wrong "no tolerance" "--tolerance: 0" --sites random:9 --tolerance 0 -o out/old.csv
wrong "a kind of weights" "--save-weights: out/old.doc: unknown kind" --sites random:9 --save-weights out/old.doc
wrong "too little memory" "--memory-limit" --sites random:100000 --memory-limit 20MB -o out/old.csv

finish
