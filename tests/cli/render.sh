#!/usr/bin/env bash
# Help, pictures, devices, and runs that are interrupted.
# Usage: render.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# -- Help and version, everywhere -----------------------------------------------------------------------
for sub in "" render cells diff compare rerun devices; do
  succeeds "help of '$sub'" $sub --help
  expect "Usage: vorpipe"
  succeeds "version of '$sub'" $sub --version
  expect "vorpipe "
done

# -- What works -----------------------------------------------------------------------------------------
succeeds "render" render --backend cpu --sites random:300 --size 90x60 --fit stretch -o out/a.png --ids out/a.npy --stats out/a.json
expect "out/a.png, out/a.npy, out/a.json: 300 unweighted cells (0 empty, 0 duplicate), 90x60, cpu on "
[ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
[ "$(head -c 8 out/a.png | tail -c 7 | head -c 3)" = PNG ] || fail "out/a.png is no PNG"
head -c 128 out/a.npy | grep -q "(60, 90)" || fail "out/a.npy is not of shape (60, 90)"
[ "$(wc -c <out/a.npy)" -eq $((128 + 4 * 60 * 90)) ] || fail "out/a.npy has the wrong length"
for key in version command backend device driver sites seed domain status ok empty duplicate resolved retried \
  double exact pixels area_sum time_ms read order upload search cells draw download write total peak_memory_bytes; do
  grep -q "\"$key\":" out/a.json || fail "out/a.json has no $key"
done
grep -q '"area_sum": null' out/a.json || fail "area_sum is not null"

succeeds "quiet" render --quiet --backend cpu --sites random:300 --size 90x60 --fit stretch --threads 1 -o out/b.png --ids out/b.npy
[ -s log/out ] && fail "not quiet"
cmp -s out/a.png out/b.png && cmp -s out/a.npy out/b.npy || fail "two runs differ"

succeeds "only ids" render --backend cpu --sites random:300 --seed 2 --size 90x60 --fit stretch --ids out/c.npy
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
expect "500 unweighted cells (0 empty, 0 duplicate), 50x50, cpu on "
for search in grid flann flann:12; do
  succeeds "search $search" render --backend cpu --sites random:300 --size 90x60 --fit stretch --search $search --ids out/s.npy
  cmp -s out/a.npy out/s.npy || fail "the ids depend on the search"
done

# -- Scales, legends, widths and aspects ---------------------------------------------------------------
succeeds "scale, range and legend" render --backend cpu --sites clusters:300 --size 200 --color area --color-scale log \
  --color-range 1e-5,1e-1 --legend --ids out/legend.npy -o out/legend.png --stats out/legend.json
tr -d ' \n' <out/legend.json | grep -qF '"color":{"by":"area","scale":"log","range":[1e-05,0.1]}' || fail "the scale is not in the figures"
succeeds "marks" render --backend cpu --sites clusters:300 --size 200 --edges --edge-width 3 --show-sites --dot-size 5 \
  --ids out/marks.npy -o out/marks.png
cmp -s out/legend.npy out/marks.npy || fail "ids depend on what is drawn over the cells"
succeeds "marks for print" render --backend cpu --sites clusters:300 --size 200 --edges --dual --labels --label-size 6 --no-fill \
  --antialias 3 --edge-width 1.5 --ids out/print.npy -o out/print.png --check
cmp -s out/legend.npy out/print.npy || fail "ids depend on what is drawn over the cells"
refuses "places by the dozen" "--antialias: \"12\" is not a whole number from 1 to 8" --sites random:9 --antialias 12
refuses "a width of nothing" "--edge-width: needs --edges or --dual" --sites random:9 --edge-width 2
refuses "a legend of white" "--legend: cells have no colors with --no-fill" --sites random:9 --color area --legend --no-fill
refuses "a label too small" "--label-size: 2 is not a number of pixels from 5 to 200" --sites random:9 --labels --label-size 2
for option in "--color-scale log" "--color-range 0,1" --legend; do
  refuses "${option%% *} by site" "${option%% *}: colors by site stand for no values" --sites random:9 $option
done
refuses "a legend without room" "--legend: has no room in 99x64" --sites random:9 --color area --legend --size 99x64
refuses "a range of nothing" "--color-range: LO 2 is not below HI" --sites random:9 --color area --color-range 2,2
refuses "a scale that is none" "--color-scale: \"cubic\" is not linear, log or quantile" --sites random:9 --color-scale cubic
refuses "an edge without width" "--edge-width: 0 is not a number of pixels" --sites random:9 --edges --edge-width 0

name="a domain that is stretched is said to be"
cases=$((cases + 1))
run 0 render --backend cpu --sites random:9 --size 30x20 -o out/x.png
grep -qF -- "--size 30x20 stretches the domain of 1 x 1; --size 30 keeps its aspect" log/err || fail "it is not"
printf 'x,y\n0,0\n4,0\n0,2\n4,2\n' >in/map.csv
succeeds "a map keeps its aspect" render --backend cpu --sites in/map.csv --domain 0,0,4,2 --size 40x40 --ids out/map.npy --check
[ "$(tail -c 6400 out/map.npy | head -c 1600 | tr -d '\377' | wc -c)" -eq 0 ] || fail "pixels above it have a site"
[ "$(tail -c 4800 out/map.npy | head -c 3200 | tr -dc '\377' | wc -c)" -eq 0 ] || fail "pixels in it have none"
succeeds "its ids are compared where they lie" diff out/map.npy out/map.npy --sites in/map.csv --domain 0,0,4,2
succeeds "a map is stretched on request" render --backend cpu --sites in/map.csv --domain 0,0,4,2 --size 40x40 --fit stretch --check

printf 'y,x,weight\n1,0,5\n2,3,6\n1,0,7\n' >in/good.csv
succeeds "file with weights" render --backend cpu --sites in/good.csv --color weight --size 30x30 -o out/h.png
expect "2 weighted cells (0 empty, 1 duplicate)"
printf 'x,y\n1e12,1e12\n1e12,1e12\n' >in/equal.csv
succeeds "all sites equal, far away" render --backend cpu --sites in/equal.csv --size 20x20 -o out/i.png
expect "1 unweighted cells (0 empty, 1 duplicate), 20x20"
printf 'x,y\n0,3\n1,3\n7,3\n' >in/collinear.csv
succeeds "collinear sites" render --backend cpu --sites in/collinear.csv --size 20x20 -o out/i.png
expect "3 unweighted cells (0 empty, 0 duplicate), 20x20"

name="ids on standard output"
cases=$((cases + 1))
"$vorpipe" render --backend cpu --sites random:300 --size 90x60 --fit stretch --ids /dev/stdout >out/piped.npy 2>log/err || fail "exit code $?"
cmp -s out/a.npy out/piped.npy || fail "not the ids alone are on standard output"
name="a note is heard in a file"
cases=$((cases + 1))
run 0 render --sites random:9 --size 9x9 --verbose -o out/n.png
one_line
grep -q '^vorpipe: note: auto took' log/err || fail "it is not there"
[ "$(wc -l <log/out)" -eq 1 ] || fail "not one line on standard output"
printf 'x,y,weight\n0.3,0.5,0.25\n0.35,0.5,0\n0.36,0.5,0\n0.8,0.5,0.01\n' >in/hidden.csv
notes "sites that others hide" "2 of 4 sites have no cell: others of larger weight hide them" \
  render --backend cpu --sites in/hidden.csv --domain 0,0,1,1 --size 9x9 -o out/n.png
printf 'x,y\n0.3,0.5\n0.7,0.5\n3,0.5\n4,4\n1.1,0.5\n' >in/outside.csv
notes "sites outside" "2 of 5 sites have no cell: they lie outside the domain" \
  cells --backend cpu --sites in/outside.csv --domain 0,0,1,1 -o out/n.csv
expect "3 unweighted cells (2 empty, 0 duplicate)"
printf 'POLYGON ((0 0, 0.5 0, 0.5 1, 0 1, 0 0))' >in/half.wkt
sed 1s/$/,weight/\;2,\$s/$/,0/ in/outside.csv | sed '2s/0$/0.05/; $ a 0.31,0.5,0' >in/both.csv
name="sites that others hide, and sites outside"
cases=$((cases + 1))
run 0 cells --backend cpu --sites in/both.csv --domain in/half.wkt -o out/n.csv
printf 'vorpipe: note: %s\n' "1 of 6 sites have no cell: others of larger weight hide them" \
  "4 of 6 sites have no cell: they lie outside the domain" | cmp -s - log/err || fail "not these two notes"
succeeds "quiet about sites outside" cells --quiet --backend cpu --sites in/outside.csv --domain 0,0,1,1 -o out/n.csv
[ -s log/err ] && fail "not quiet"

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
  succeeds "$backend" render --backend $backend --sites random:300 --size 90x60 --fit stretch --ids out/k.npy --check
  expect "$backend on "
done

# -- Interrupted ----------------------------------------------------------------------------------------
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

# The pipe has no reader that empties it: the write blocks, and the run cannot notice the request to stop.
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
