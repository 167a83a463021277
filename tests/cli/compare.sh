#!/usr/bin/env bash
# Comparing pictures, ids and backends.
# Usage: compare.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# -- Comparing ------------------------------------------------------------------------------------------
succeeds "a picture" render --backend cpu --sites random:300 --size 90x60 --fit stretch -o out/a.png --ids out/a.npy
cp out/a.png out/b.png
cp out/a.npy out/b.npy
succeeds "a picture of other sites" render --backend cpu --sites random:300 --seed 2 --size 90x60 --fit stretch -o out/c.png --ids out/c.npy
succeeds "a small picture" render --backend cpu --sites random:9 --size 9x9 -o out/d.png
printf 'x,y,weight\n1,0,5\n2,3,6\n1,0,7\n' >in/cells.csv
succeeds "diff of equal ids" diff out/a.npy out/b.npy --sites random:300
expect "5400 pixels equal, 0 ties, 0 wrong"
succeeds "diff of equal pictures" diff out/a.png out/b.png
cp out/a.npy in/mutant.npy
printf '\377\377\377\377' | dd of=in/mutant.npy bs=1 seek=$((128 + 4 * (7 * 90 + 11))) conv=notrunc status=none
fails 1 "a changed id" "1 pixels wrong (0 ties, 5399 equal), first at row 7, column 11" diff out/a.npy in/mutant.npy --sites random:300
fails 1 "a changed id, sites unknown" "first at row 7, column 11" diff out/a.npy in/mutant.npy
fails 1 "ids of other sites" "pixels wrong" diff out/a.npy out/c.npy --sites random:300
fails 1 "pictures that differ" "pixels differ" diff out/a.png out/c.png --quiet
grep -q 'to tell ties from faults, render both with --ids, as a.npy and b.npy, then vorpipe diff a.npy b.npy --sites' log/err ||
  fail "it does not say how to tell ties from faults"
fails 1 "sizes that differ" "the sizes differ" diff out/a.png out/d.png
cp out/a.npy out/b.Npy
succeeds "an extension in any case" diff out/a.npy out/b.Npy
name="picture of differences"
cases=$((cases + 1))
run 1 diff out/a.npy in/mutant.npy -o out/where.png
[ -s out/where.png ] || fail "no picture"

# -- What a test of images asks --------------------------------------------------------------------------
fails 1 "more pixels than are allowed" "1 pixels wrong (0 ties, 5399 equal), first at row 7, column 11: sites" diff out/a.npy in/mutant.npy --sites random:300
succeeds "as many pixels as are allowed" diff out/a.npy in/mutant.npy --sites random:300 --max-pixels 1 --json out/d.json
expect "5399 pixels equal, 0 ties, 1 wrong; --max-pixels allows 1"
if "$python" -c 'import PIL' 2>/dev/null; then
  "$python" - <<'END' || fail "no pictures with changes"
from PIL import Image
image = Image.open('out/a.png').convert('RGB')
for column, row, by in [(0, 3, 2), (1, 3, 2), (40, 50, 60)]:
    r, g, b = image.getpixel((column, row))
    image.putpixel((column, row), (r, g + by if g < 128 else g - by, b))
image.save('in/near.png')
END
  fails 1 "all changed pixels" "3 pixels differ, by at most 60 of 255, first at row 3, column 0" diff out/a.png in/near.png
  name="a report beside a difference" cases=$((cases + 1))
  run 1 diff out/a.png in/near.png --max-difference 2 --json out/near.json -o out/near.png
  mentions "1 pixels differ, by at most 60 of 255, first at row 50, column 40"
  "$python" - <<'END' || fail "out/near.json or its picture"
import json
from PIL import Image
report = json.load(open('out/near.json'))
a, b = Image.open('out/a.png').convert('RGBA'), Image.open('in/near.png').convert('RGBA')
assert (report['command'], report['kind'], report['agree']) == ('diff', 'pictures', False), report
assert report['b'] == {'file': 'in/near.png', 'size': [90, 60]} and report['difference'], report
assert (report['equal'], report['close'], report['wrong'], report['largest_difference']) == (5397, 2, 1, 60), report
assert (report['max_pixels'], report['max_difference']) == (0, 2), report
assert report['rows'] == [50, 50] and report['columns'] == [40, 40], report
assert report['first'] == [{'row': 50, 'column': 40, 'a': list(a.getpixel((40, 50))),
                            'b': list(b.getpixel((40, 50)))}], report
marked = Image.open('out/near.png').convert('RGB')
assert marked.getpixel((40, 50)) == (255, 0, 0) and marked.getpixel((1, 3)) == (255, 255, 0)
ids = json.load(open('out/d.json'))
assert ids['agree'] is True and ids['difference'] is None and ids['wrong'] == ids['max_pixels'] == 1, ids
assert ids['first'][0]['row'] == 7 and ids['first'][0]['column'] == 11 and ids['sites'] == 'random:300', ids
END
  succeeds "pixels that are close enough" diff out/a.png in/near.png --max-difference 60
  expect "5397 pixels equal, 3 within 60 of 255"
  succeeds "close enough, or few" diff out/a.png in/near.png --max-difference 2 --max-pixels 1 --json -
  grep -q 'pixels equal' log/out && fail "not the report alone is on standard output"
  "$python" -c 'import json, sys; assert json.load(sys.stdin)["agree"] is True' <log/out || fail "no report"
  fails 1 "one level below what they differ by" "1 pixels differ" diff out/a.png in/near.png --max-difference 59
else
  skipped "pictures with changes" "there is no PIL"
fi
name="a report of sizes that differ" cases=$((cases + 1))
run 1 diff out/a.png out/d.png --json out/sizes.json
grep -q '"difference": "the sizes differ"' out/sizes.json || fail "out/sizes.json does not say so"
fails 2 "channels of ids" "--max-difference: ids have no channels" diff out/a.npy out/b.npy --max-difference 1 --json out/old.json
fails 2 "more than a channel has" "--max-difference" diff out/a.png out/b.png --max-difference 256
fails 2 "no number of pixels" "--max-pixels" diff out/a.png out/b.png --max-pixels -1
fails 2 "a report in place of an input" "is an input of this run" diff out/a.png out/b.png --json out/a.png
succeeds "compare" compare --backends "${backends// /,}" --sites random:300 --size 90x60 --report out/r.json -o out/m.png
expect "cpu / vulkan-geometry"
expect "vulkan-geometry / opengl"
expect "worst area"
expect "(on edges: a pixel whose center lies on an edge may go to either cell; so many did, and at most so many could)"
grep -q '"wrong": 0' out/r.json || fail "out/r.json has no wrong"
for key in different_statuses different_neighbors different_areas worst_area of_allowed cells_ms area_slack; do
  grep -q "\"$key\":" out/r.json || fail "out/r.json has no $key"
done
[ "$(grep -c '"equal": 300,' out/r.json)" -eq 6 ] || fail "not six pairs of 300 equal cells"
succeeds "compare duplicates and sites outside" compare --quiet --backends cpu,vulkan-geometry --sites in/cells.csv --domain 0,0,1.5,2 --size 30x30
[ -s log/out ] && fail "not quiet"
succeeds "compare and check" compare --backends cpu,vulkan-compute --sites clusters:300 --size 50x50 --check --stats out/s.json
for key in command backend sites seed status hidden resolved area_sum time_ms peak_memory_bytes; do
  grep -q "\"$key\":" out/s.json || fail "out/s.json has no $key"
done
grep -q '"backend": "cpu, vulkan-compute"' out/s.json || fail "out/s.json does not name the backends"
succeeds "compare on a device" compare --backends cpu,vulkan-compute --sites random:9 --size 9x9 --device 0 --quiet
fails 3 "compare on a device that is not there" "no Vulkan d" compare --backends cpu,vulkan-compute --sites random:9 --device 77 --report out/old.json
name="a report on standard output"
cases=$((cases + 1))
"$vorpipe" compare --backends cpu,opengl --sites random:9 --size 9x9 --report /dev/stdout >out/r.json 2>log/err || fail "exit code $?"
[ "$(head -c 1 out/r.json)$(tail -n 1 out/r.json)" = "{}" ] || fail "not the report alone is on standard output"
# -- What an earlier run wrote ----------------------------------------------------------------------------
succeeds "ids that are kept" compare --backends vulkan-geometry,cpu --sites random:300 --reference out/a.npy \
  --report out/r.json -o out/m.png --stats out/s.json
expect "vulkan-geometry / out/a.npy"
grep -q "^out/a.npy  *-  *-  the reference$" log/out || fail "the reference is not in the table"
grep -q '"kind": "ids"' out/r.json && grep -q '"size": \[' out/r.json || fail "out/r.json does not name the reference"
[ "$(grep -c '"cells": null' out/r.json)" -eq 2 ] || fail "not two pairs without cells"
grep -q 'out/a.npy' out/s.json || fail "out/s.json has no hash of the reference"
succeeds "the same once more" rerun out/s.json
succeeds "a picture that is kept" compare --backends cpu,opengl --sites random:300 --reference out/a.png
expect "opengl / out/a.png"
name="ids that are others" cases=$((cases + 1))
run 1 compare --backends cpu --sites random:300 --reference in/mutant.npy --report out/r.json -o out/m.png
mentions "cpu and in/mutant.npy differ: 1 pixels wrong (0 ties, 5399 equal), first at row 7, column 11"
grep -q '"wrong": 1,' out/r.json || fail "out/r.json does not count the pixel"
if "$python" -c 'import PIL' 2>/dev/null; then
  name="a picture that is another" cases=$((cases + 1))
  run 1 compare --backends cpu --sites random:300 --reference in/near.png
  mentions "cpu and in/near.png differ: 3 pixels wrong (0 ties, 5397 equal), first at row 3, column 0: sites "
  "$python" - <<'END' || fail "out/m.png is not what it should be"
from PIL import Image
image = Image.open('out/m.png').convert('RGB')
heading = 28
assert image.size == (2 * 90, 2 * (heading + 60)), image.size
assert image.getpixel((11, 2 * heading + 60 + 7)) == (255, 0, 0)
for top in (0, heading + 60):
    dark = [sum(image.crop((left, top, left + 90, top + heading)).convert('L').histogram()[:128]) for left in (0, 90)]
    assert dark[0] > 40 and (dark[1] > 40) == (top == 0), dark
kept, drawn = image.crop((90, heading, 180, heading + 60)), Image.open('out/a.png').convert('RGB')
assert image.crop((0, heading, 90, heading + 60)).tobytes() == drawn.tobytes() and kept.getpixel((0, 0)) != (255,) * 3
END
fi
# Ids of a lattice whose centers of pixels all lie on edges: every pixel of an edge may be the other cell's.
succeeds "ties of a lattice" render --backend cpu --sites square:16 --size 60x60 --ids out/lattice.npy -o out/lattice.png
for kept in npy png; do
  succeeds "ties in a .$kept" compare --backends opengl,vulkan-geometry --sites square:16 --reference out/lattice.$kept
done
if "$python" -c 'import PIL' 2>/dev/null; then
  # The center of pixel (30, 0) lies on the edge between the cell that column 1 shows and that of the last column.
  { echo x,y; for x in 1 3 5 7; do for y in 1 3 5 7; do echo "0$((x * 125))e-3,0$((y * 125))e-3"; done; done; } >in/lattice.csv
  torus="--backend cpu --sites in/lattice.csv --periodic x --domain 0.2416666666666667,0,1.2416666666666667,1"
  succeeds "a lattice that repeats itself" render $torus --size 60x60 -o out/torus.png
  "$python" - <<'END' || fail "no picture with the other side of a tie"
from PIL import Image
image = Image.open('out/torus.png').convert('RGB')
here, right, left = (image.getpixel((column, 30)) for column in (0, 1, 59))
assert here in (left, right) and left != right
image.putpixel((0, 30), left if here == right else right)
image.save('in/torus.png')
END
  succeeds "a tie across the period" compare ${torus/--backend/--backends} --reference in/torus.png
  grep -q '^cpu / in/torus.png  *3599  *1 ' log/out || fail "not one tie"
fi
fails 2 "a size beside that of the reference" "out/a.npy is 90x60, with this --size pictures are 30x30" compare \
  --backends cpu --sites random:300 --size 30x30 --reference out/a.npy --report out/old.json
fails 2 "a reference of other sites" "there is no site" compare --backends cpu --sites random:9 --reference out/a.npy
fails 2 "a reference that is not there" "in/none.npy" compare --backends cpu --sites random:9 --reference in/none.npy
fails 2 "one backend alone" "or a --reference" compare --backends cpu --sites random:9
succeeds "a device behind its backend" compare --backends opengl:0,cpu:0 --sites random:30 --size 30 --stats out/s.json
expect "opengl:0 / cpu:0"
grep -q '"backend": "opengl:0, cpu:0"' out/s.json || fail "out/s.json does not name the devices"
fails 3 "a device that is not there, behind its backend" "77" compare --backends cpu,vulkan-compute:77 --sites random:9 --report out/old.json
fails 3 "a number that is a part of a name" "'256'" compare --backends vulkan-compute:0,vulkan-compute:256 --sites random:9 --report out/old.json
fails 2 "no device behind a colon" '"cpu:" names no device' compare --backends cpu:,opengl --sites random:9
fails 2 "a device twice" '"opengl:0" is named twice' compare --backends opengl:0,opengl:0 --sites random:9
fails 2 "compare with an unknown backend" '--backends: "nope" is not one of' compare --backends cpu,nope --sites random:9 --report out/old.json
fails 2 "compare a backend with itself" "--backends" compare --backends cpu,cpu --sites random:9 --report out/old.json
fails 2 "compare with one backend" "--backends" compare --backends cpu --sites random:9
fails 2 "diff of a picture and ids" "out/a.npy" diff out/a.png out/a.npy
fails 2 "diff with sites of pictures" "--sites" diff out/a.png out/b.png --sites random:300
fails 2 "diff of a missing file" "out/nothing.npy" diff out/a.npy out/nothing.npy
fails 2 "ids of more sites than there are" "--sites has 9, from 0 on" diff out/a.npy out/b.npy --sites random:9
fails 2 "diff of one file" "B" diff out/a.npy

if [ -n "${VORPIPE_EXPECTED_BACKENDS:-}" ]; then
  succeeds "a named device beside cpu" compare --backends vulkan-compute,cpu --device llvmpipe --sites random:50 \
    --size 50
  fails 3 "a device that is none" "nope" compare --backends cpu,vulkan-compute --device nope --sites random:50 \
    --report out/old.json
else
  skipped "a named device beside cpu" "the software drivers are not installed"
fi

finish
