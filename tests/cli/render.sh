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
# -- Colors of edges, and of what is no cell ------------------------------------------------------------
cat >in/pixels.py <<'E'
"""pixels.py FILE.png COLUMN,ROW=R,G,B,A...: what PIL has there."""
import sys
from PIL import Image
image = Image.open(sys.argv[1]).convert("RGBA")
for place in sys.argv[2:]:
    at, wanted = place.split("=")
    got = image.getpixel(tuple(int(n) for n in at.split(",")))
    assert all(abs(a - int(b)) <= 1 for a, b in zip(got, wanted.split(","))), (place, got)
E
printf 'x,y\n0.25,0.5\n0.75,0.5\n' >in/two.csv
for backend in $("$vorpipe" devices --json | grep -o '"backend": "[a-z-]*"' | cut -d'"' -f4 | sort -u); do
  for smooth in 1 3; do
    succeeds "colors on $backend" render --backend "$backend" --sites in/two.csv --domain 0,0,1,1 --size 200x100 --fit letterbox \
      --edges --edge-color '#f80' --edge-width 4 --no-fill --background '#20408080' --antialias $smooth -o out/colors.png
    /usr/bin/python3 in/pixels.py out/colors.png 10,50=32,64,128,128 80,50=32,64,128,128 99,50=255,136,0,255 2>log/err ||
      fail "colors on $backend with --antialias $smooth"
  done
done
succeeds "an opaque background" render --backend cpu --sites in/two.csv --domain 0,0,1,1 --size 200x100 --fit letterbox \
  --background STEELBLUE -o out/colors.png --stats out/colors.json
/usr/bin/python3 in/pixels.py out/colors.png 10,50=70,130,180,255 80,50=68,1,84,255 2>log/err || fail "an opaque background"
succeeds "it again" rerun out/colors.json
refuses "a color that is none" '--background: "reddish" is no color' --sites random:9 --background reddish
refuses "the color of no edges" "--edge-color" --sites random:9 --edge-color red
refuses "edges that show through" '--edge-color: "#ff000080" is not opaque, as #rgb, #rrggbb and names of CSS are' --sites random:9 --edges --edge-color '#ff000080'
# -- Photographs ----------------------------------------------------------------------------------------
/usr/bin/python3 - <<'E' || fail "no photographs"
from PIL import Image
photograph = Image.new("RGB", (40, 20), (200, 40, 40))
photograph.paste((20, 60, 180), (20, 0, 40, 20))
photograph.save("in/halves.png")
photograph.save("in/halves.jpg", quality=100, subsampling=0)
turned = Image.Exif()
turned[0x112] = 3  # by half a turn
photograph.save("in/turned.jpeg", quality=100, subsampling=0, exif=turned.tobytes())
Image.new("L", (40, 20), 51).save("in/gray.jpg", quality=100)
Image.new("L", (40, 20), 51).save("in/gray.png")
data = open("in/halves.jpg", "rb").read()
open("in/half.jpg", "wb").write(data[: len(data) // 2])
open("in/none.jpg", "wb").write(b"GIF89a")
open("in/empty.jpg", "wb").write(b"")
E
glass="--sites in/two.csv --domain 0,0.25,1,0.75 --size 40x20 --fit stretch"
for kind in halves.png halves.jpg; do
  succeeds "colors of $kind" render --backend cpu $glass --color in/$kind -o out/glass.png --stats out/glass.json
  /usr/bin/python3 in/pixels.py out/glass.png 5,10=200,40,40,255 35,10=20,60,180,255 2>log/err || fail "the colors of $kind"
  succeeds "the colors again" rerun out/glass.json
done
succeeds "the other half" render --backend cpu $glass --color in/turned.jpeg -o out/glass.png
/usr/bin/python3 in/pixels.py out/glass.png 5,10=20,60,180,255 35,10=200,40,40,255 2>log/err || fail "the orientation is not honoured"
succeeds "beside it" render --backend cpu $glass --color in/halves.png --color-box 0,0.25,0.5,0.75 -o out/glass.png --quiet
/usr/bin/python3 in/pixels.py out/glass.png 35,10=255,255,255,255 2>log/err || fail "cells beyond a photograph are not white"
# Red and blue in equal parts: the mean of their light.
/usr/bin/python3 in/pixels.py out/glass.png 5,10=147,51,134,255 2>log/err || fail "the mean is not that of light"
for kind in gray.png gray.jpg; do
  succeeds "the density of $kind" cells --backend cpu --sites random:9 --domain 0,0,2,1 --density in/$kind -o out/$kind.csv
done
cmp -s out/gray.png.csv out/gray.jpg.csv || fail "a JPEG has another darkness than a PNG"
refuses "a photograph that ends early" "in/half.jpg: is a damaged JPEG: " --sites random:9 --color in/half.jpg
refuses "a photograph that is none" "--color: in/none.jpg: is not a JPEG file" --sites random:9 --color in/none.jpg
refuses "an empty photograph" "--color: in/empty.jpg: is not a JPEG file" --sites random:9 --color in/empty.jpg
refuses "no photograph" "--color: in/no.png: " --sites random:9 --color in/no.png
refuses "a photograph elsewhere" "nothing of the domain" --sites random:9 --color in/halves.png --color-box 5,5,6,6
refuses "a box of nothing" "--color-box" --sites random:9 --color-box 0,0,1,1
refuses "a legend of a photograph" "--legend: colors of a photograph stand for no values" --sites random:9 --color in/halves.png --legend
refuses "no room for colors" "--color: cells have no colors with --no-fill" --sites random:9 --color in/halves.png --no-fill

# -- Sizes on paper -------------------------------------------------------------------------------------
paper="render --backend cpu --sites random:30 --domain 0,0,420,594 --size 420x594mm --edges --labels"
succeeds "a poster" $paper --dpi 96 -o out/poster.png -o out/poster.svg -o out/poster.pdf --stats out/poster.json
expect "1587x2245"
cat >in/paper.py <<'E'
"""paper.py NAME DPI: what others say of the sizes of NAME.png, .svg and .pdf; prints the width of edges in mm."""
import re, subprocess, sys, xml.etree.ElementTree
from PIL import Image
name, dpi = sys.argv[1], float(sys.argv[2])
image = Image.open(name + ".png")
assert all(abs(got - dpi) < 0.1 for got in image.info["dpi"]), image.info
assert all(abs(n / dpi * 25.4 - mm) < 25.4 / dpi for n, mm in zip(image.size, (420, 594))), image.size
root = xml.etree.ElementTree.parse(name + ".svg").getroot()
assert (root.get("width"), root.get("height")) == ("420mm", "594mm"), root.attrib
assert root.get("viewBox") == "0 0 {} {}".format(*image.size), root.attrib
info = subprocess.run(["pdfinfo", name + ".pdf"], capture_output=True, text=True, check=True).stdout
size = [float(n) for n in re.search(r"Page size: +([0-9.]+) x ([0-9.]+) pts", info).groups()]
assert all(abs(points - mm * 72 / 25.4) < 0.01 for points, mm in zip(size, (420, 594))), size
edges = next(group for group in root if group.get("id") == "edges")
print(round(float(edges.get("stroke-width")) / image.size[0] * 420, 3))
E
width=$(/usr/bin/python3 in/paper.py out/poster 96 2>log/err) || fail "the poster has another size"
succeeds "it again, from its figures" rerun out/poster.json
succeeds "a finer poster" $paper --dpi 200 -o out/poster.png -o out/poster.svg -o out/poster.pdf --quiet
[ "$(/usr/bin/python3 in/paper.py out/poster 200 2>log/err)" = "$width" ] || fail "edges have another width with other dots"
succeeds "the longer side in inches" render --backend cpu --sites random:9 --size 2in --domain 0,0,2,1 -o out/inches.png
expect "600x300"
refuses "dots of a screen" "--dpi: is for a --size on paper" --sites random:9 --size 300 --dpi 300
refuses "a poster for a wall" "--size: 9000 mm with --dpi 300 are 106299 pixels; a side has at most 32768" --sites random:9 --size 9x9000mm
refuses "no length" "--size: \"x\" is not" --sites random:9 --size 10xxmm
refuses "wide edges" "--edge-width: 60 with --dpi 300 is 187.5 pixels; 100 are the most" --sites random:9 --size 10mm --edges --edge-width 60
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

succeeds "a view" render --backend cpu --sites random:300 --view 0.25,0.25,0.75,0.5 --ids out/view.npy -o out/view.png --size 80 --check --stats out/view.json
expect "80x40"
succeeds "a view again" rerun out/view.json
succeeds "ids of a view" diff out/view.npy out/view.npy --sites random:300 --view 0.25,0.25,0.75,0.5
succeeds "more than the domain" render --backend cpu --sites random:300 --view=-1,-1,2,2 --size 30x30 --ids out/more.npy --check
[ "$(tail -c 3600 out/more.npy | head -c 1200 | tr -d '\377' | wc -c)" -eq 0 ] || fail "pixels above it have a site"
[ "$(tail -c 2400 out/more.npy | head -c 1200 | tr -dc '\377' | wc -c)" -eq 800 ] || fail "not those beside it have none"
refuses "a view that is no box" '--view: "0,0,1" is not XMIN,YMIN,XMAX,YMAX' --sites random:9 --view 0,0,1
refuses "a view turned around" "--view: xmin 1 is not below xmax 0" --sites random:9 --view 1,0,0,1
refuses "a view beyond doubles" "--view: the view 0.5,0.5,0.5000000000001,0.5000000000001 is too small" --sites random:9 --view 0.5,0.5,0.5000000000001,0.5000000000001

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
