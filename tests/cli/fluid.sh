#!/usr/bin/env bash
# A fluid: its files, checkpoints that go on to equal bytes, what is refused.
# Usage: fluid.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

vortex="fluid --backend cpu --case taylor-green --particles 64"

# -- Files ----------------------------------------------------------------------------------------------
succeeds "files" $vortex --steps 4 --every 2 --frames out/frames --size 40 --series out/series --trace out/trace.csv \
  --stats out/stats.json -o out/sites.csv --cells out/cells.npz
expect "64 cells by projection, "
expect ", velocities within "
expect " after 4 steps (steps)"
[ "$(head -n 1 out/trace.csv | cut -d, -f1-4)" = step,time,length,kinetic ] || fail "the header of the trace"
[ "$(wc -l <out/trace.csv)" -eq 6 ] || fail "not one row for each step"
[ "$(ls out/frames | wc -l)" -eq 3 ] || fail "not a picture of every second step"
[ "$(grep -c 'file="step-00000[024].vtp"' out/series/series.pvd)" -eq 3 ] || fail "the series has not its files"
grep -q '"end": "steps"' out/stats.json || fail "the stats have no end"
grep -q '"velocity_error": 0\.[0-9]' out/stats.json || fail "the stats have no error of velocities"
[ "$(head -n 1 out/trace.csv | cut -d, -f15)" = velocity_error ] || fail "the trace has no error of velocities"
awk -F, 'NR > 1 && !($15 >= 0 && $15 < 0.3) { exit 1 }' out/trace.csv || fail "errors of velocities are not those of a vortex"
awk -F, 'NR > 1 && $10 > 1e-6 { exit 1 }' out/trace.csv || fail "areas are not within 1e-6"
succeeds "colors by speed" $vortex --steps 2 --every 2 --frames out/speeds --flow-color speed --size 40
cmp -s out/frames/frame-00002.png out/speeds/frame-00002.png && fail "speeds have no colors of their own"
succeeds "a free surface" fluid --backend cpu --case dam-break --particles 32 --steps 2 --frames out/dam --size 40 --series out/dam-series

# -- Going on -------------------------------------------------------------------------------------------
for scheme in springs projection; do
  succeeds "a whole run by $scheme" $vortex --scheme $scheme --steps 6 --checkpoint out/whole.npz -o out/whole.csv
  succeeds "a part of it" $vortex --scheme $scheme --steps 3 --checkpoint out/part.npz
  succeeds "the rest" fluid --backend cpu --threads 1 --resume out/part.npz --steps 3 --checkpoint out/rest.npz -o out/rest.csv
  cmp out/whole.npz out/rest.npz || fail "other checkpoints"
  cmp out/whole.csv out/rest.csv || fail "other sites"
done

# With viscosity, an outline and a known solution, which a checkpoint has.
cat >in/ring.geojson <<'END'
{"type": "Polygon", "coordinates": [[[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4], [-0.4, -0.4]],
                                    [[-0.1, -0.1], [-0.1, 0.1], [0.1, 0.1], [0.1, -0.1], [-0.1, -0.1]]]}
END
for scheme in springs projection; do
  for flow in "--case gresho --particles 60 --domain in/ring.geojson --walls no-slip" "--case shear-wave --particles 64"; do
    viscous="fluid --backend cpu $flow --scheme $scheme --viscosity 0.01"
    succeeds "a whole viscous run by $scheme" $viscous --steps 6 --checkpoint out/whole.npz --trace out/viscous.csv
    succeeds "a part of it" $viscous --steps 3 --checkpoint out/part.npz --trace out/viscous-on.csv
    succeeds "the rest" fluid --backend cpu --threads 1 --resume out/part.npz --steps 3 --checkpoint out/rest.npz \
      --trace out/viscous-on.csv
    cmp out/whole.npz out/rest.npz || fail "other checkpoints"
    cmp <(cut -d, -f1-15 out/viscous.csv) <(cut -d, -f1-15 out/viscous-on.csv) || fail "another trace"
    awk -F, 'NR > 1 { if ($4 >= last && NR > 2) exit 1; last = $4 }' out/viscous.csv || fail "friction takes no energy"
  done
done

# With centering, of which the first half of a step asks for the cells that the last step ended with.
centered="fluid --backend cpu --case rayleigh-taylor --particles 128"
succeeds "a whole centered run" $centered --centering 3 --steps 6 --checkpoint out/whole.npz --stats out/centered.json
succeeds "a part of it" $centered --centering 3 --steps 3 --checkpoint out/part.npz
succeeds "the rest" fluid --backend cpu --threads 1 --resume out/part.npz --steps 3 --checkpoint out/rest.npz
cmp out/whole.npz out/rest.npz || fail "other checkpoints"
grep -q '"centering": 3' out/centered.json || fail "statistics have no centering"
succeeds "the same without" $centered --centering 0 --steps 6 --checkpoint out/rest.npz
cmp -s out/whole.npz out/rest.npz && fail "centering moves nothing"

# -- A channel with an obstacle -------------------------------------------------------------------------
cat >in/channel.wkt <<'END'
POLYGON ((0 0, 1 0, 1 2, 0 2, 0 0), (0.3 0.8, 0.3 1, 0.7 1, 0.6 0.8, 0.3 0.8))
END
succeeds "a channel with an obstacle" fluid --backend cpu --case rayleigh-taylor --particles 300 --domain in/channel.wkt \
  --time 3 --trace out/channel.csv --cells out/channel.geojson -o out/channel-sites.csv --stats out/channel.json
[ "$(wc -l <out/channel.csv)" -gt 30 ] || fail "there are few steps"
awk -F, 'NR > 1 && !($10 <= 1e-6) { exit 1 }' out/channel.csv || fail "areas are not kept to 1e-6 at each step"
awk -F, 'NR == 2 { first = $5 } END { exit !($5 < first - 0.01) }' out/channel.csv || fail "nothing has fallen"
/usr/bin/python3 - out/channel.geojson out/channel-sites.csv <<'END' || fail "cells or sites are not those of the channel"
import sys
import geopandas
import shapely.ops
import shapely.wkt
from shapely.geometry import Point
channel = shapely.wkt.loads(open('in/channel.wkt').read())
cells = geopandas.read_file(sys.argv[1]).geometry.set_crs('EPSG:3857', allow_override=True)
assert cells.is_valid.all()
assert shapely.ops.unary_union(list(cells)).symmetric_difference(channel).area < 1e-9
equal = channel.area / len(cells)
assert (abs(cells.area - equal) <= 1.1e-6 * equal).all(), abs(cells.area / equal - 1).max()
sites = geopandas.pd.read_csv(sys.argv[2])
assert len(sites) == len(cells) and abs(len(sites) - 300) < 20
assert max(channel.distance(Point(x, y)) for x, y in zip(sites.x, sites.y)) <= 1e-9
END
succeeds "rerun" rerun out/channel.json

folders="--every 2 --size 30 --frames"
succeeds "folders of a whole run" $vortex --steps 6 $folders out/whole-frames --series out/whole-series
succeeds "a later state" $vortex --steps 7 --checkpoint out/late.npz
succeeds "of a part" $vortex --steps 3 $folders out/frames-on --series out/series-on --checkpoint out/part.npz
succeeds "of the rest" fluid --backend cpu --resume out/part.npz --steps 3 $folders out/frames-on --series out/series-on
diff -r out/whole-frames out/frames-on || fail "other pictures"
for file in out/whole-series/*.vtp; do cmp "$file" "out/series-on/${file##*/}" || fail "another step"; done
[ "$(grep -c DataSet out/series-on/series.pvd)" -eq 5 ] || fail "the series has not its steps"
fails 2 "pictures of another run" "its last picture is 4, where a run with --every 2 has 2 up to step 3" \
  fluid --backend cpu --resume out/part.npz --steps 1 $folders out/frames-on
fails 2 "a series of another run" "its series has no step 3 at time" \
  fluid --backend cpu --resume out/part.npz --steps 1 --series out/series
mkdir out/foreign && touch out/foreign/notes.txt
fails 2 "a foreign folder" 'holds "notes.txt", which is none of a series' \
  fluid --backend cpu --resume out/part.npz --steps 1 --series out/foreign
succeeds "cells of a free surface" fluid --backend cpu --case dam-break --particles 32 --steps 1 --cells out/free.csv
awk -F, 'NR > 1 && $5 == "ok" { n++ } END { exit !(n > 25) }' out/free.csv || fail "cells of a free surface are not there"

# A trace goes on, and has its rows as soon as steps are made.
without_times() { cut -d, -f1-15 "$1"; }
succeeds "a trace of a whole run" $vortex --steps 6 --trace out/whole-trace.csv
succeeds "of a part" $vortex --steps 3 --trace out/trace-on.csv --checkpoint out/part.npz
printf '4,0.5,this row was made after the checkpoint\n' >>out/trace-on.csv
succeeds "of the rest" fluid --backend cpu --resume out/part.npz --steps 3 --trace out/trace-on.csv
cmp <(without_times out/whole-trace.csv) <(without_times out/trace-on.csv) || fail "another trace"
fails 2 "a trace of another run" "--trace: out/whole-trace.csv: its trace has no step 7 at time" \
  fluid --backend cpu --resume out/late.npz --steps 1 --trace out/whole-trace.csv
fails 2 "no trace" "--trace: out/whole.csv: it is no trace of a fluid" \
  fluid --backend cpu --resume out/part.npz --steps 1 --trace out/whole.csv

# -- Steps that are too long ----------------------------------------------------------------------------
name="an explosion"
cases=$((cases + 1))
run 1 fluid --backend cpu --case taylor-green --particles 256 --scheme springs --step 0.3 --time 3 -o out/far.csv
grep -q '^vorpipe: note: --step: 0.3 is longer than the 0.25[0-9]* up to which springs of epsilon 0.12.* are stable' log/err || fail "nothing is said before"
grep -q '^vorpipe: energy has exploded, from ' log/err || fail "nothing is said after"
[ "$(wc -l <out/far.csv)" -eq 257 ] || fail "the file is not there"

# -- What is refused ------------------------------------------------------------------------------------
refused() { fails 2 "$1" "$@"; }
refused '--case: name what to begin with (or --resume a checkpoint)' fluid -o out/a.csv
refused '--case: "river" is not ' fluid --case river -o out/a.csv
refused '-o: name what to write' fluid --case gresho
refused '--scheme: projection is for domains that are full; springs have free surfaces' \
  fluid --backend cpu --case dam-break --particles 32 --scheme projection -o out/a.csv
refused '--viscosity: -1 is not a number of 0 or more' $vortex --viscosity -1 -o out/a.csv
refused '--centering: -1 is not a number of 0 or more' $vortex --centering -1 -o out/a.csv
refused '--walls: "glue" is not slip or no-slip' $vortex --walls glue -o out/a.csv
refused '--walls: without viscosity a fluid does not stick to them' $vortex --walls no-slip -o out/a.csv
refused '--domain: outline: it reaches beyond the domain of the case, 0,0,1,1' $vortex --domain in/ring.geojson -o out/a.csv
refused '--domain: outline: this case repeats itself, in a box of its own' fluid --case shear --domain in/ring.geojson -o out/a.csv
refused '--domain: outline: this case has a free surface, in a box of its own' fluid --case dam-break --domain in/ring.geojson -o out/a.csv
refused '--domain: a checkpoint has its own' fluid --resume out/part.npz --domain in/ring.geojson -o out/a.csv
refused '--domain: in/none.wkt: ' $vortex --domain in/none.wkt -o out/a.csv
refused '--repair requires --domain' $vortex --repair -o out/a.csv
refused '--legend: colors by --flow-color have none' $vortex --frames out/none --steps 1 --flow-color speed --legend
refused '--flow-color: "heat" is not ' $vortex --frames out/none --flow-color heat
refused '--frames: "out/t.png" is the name of a file that is no film; name an .mp4 or a folder' $vortex --steps 1 --frames out/t.png
refused '--series: "out/x.vtp" is the name of a file; name a folder' $vortex --steps 1 --series out/x.vtp
refused '--labels: "@name" is for render, relax and transport; here labels are indices' $vortex --frames out/none --steps 1 --labels @name
refused '--color: "@rain" is for render, relax and transport; here colors show site, area' $vortex --frames out/none --steps 1 --color @rain
refused '--color: "in/a.jpg" is for render, relax and transport; here colors show' $vortex --frames out/none --steps 1 --color in/a.jpg
refused '--legend: "beside" is for render, relax and transport; here the legend is inside' \
  $vortex --frames out/none --steps 1 --color area --legend beside
mkdir out/a.mov
succeeds "a folder that is there" $vortex --steps 1 --frames out/a.mov --size 100 --color area --legend inside --labels
[ -e out/a.mov/frame-00001.png ] || fail "no picture in the folder"
refused '--particles: needs about' $vortex --memory-limit 1MB -o out/a.csv
# Each case is forecast as it is: what it needs is enough, but for what its sites and the device tell afterwards.
for case in shear dam-break; do
  name="what $case needs is enough"
  run 2 fluid --backend cpu --case $case --particles 20000 --steps 1 --memory-limit 1MB -o out/needed.csv
  needs=$(sed -n 's/.*needs about \([0-9]*\) MB.*/\1/p' log/err)
  run 0 fluid --backend cpu --case $case --particles 20000 --steps 1 --memory-limit "$((needs + needs / 16))MB" -o out/needed.csv
done
refused '--frames: out/frames: the folder holds something' $vortex --frames out/frames
refused '--checkpoint: out/./k.npz: is the same output file as out/k.npz' \
  $vortex --steps 1 --checkpoint out/./k.npz --cells out/k.npz
refused '--series: out/new/ is the folder of --frames' $vortex --steps 1 --frames out/new --series out/new/
mkdir out/empty
refused '--frames: another output, k.npz, lies in this folder' \
  $vortex --steps 1 --frames out/empty --checkpoint out/empty/k.npz
cp out/whole.csv in/copy.npz
refused 'in/copy.npz: it is no whole .npz file' fluid --case in/copy.npz -o out/a.csv

finish
