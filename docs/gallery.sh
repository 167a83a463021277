#!/usr/bin/env bash
# Draws every picture of docs/gallery anew: docs/gallery.sh [--program VORPIPE] [--into FOLDER] [--film STEPS]
# The film has a picture every so many steps: 4, of which the test wants fewer.
# The backend is cpu, whose pictures are the same on every machine. The test docs_gallery compares what this script
# draws with what is committed.
set -euo pipefail
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=$root/run
into=$root/docs/gallery
film=4
while [[ $# -gt 0 ]]; do
  case $1 in
    --program) program=$2 ;;
    --into) into=$2 ;;
    --film) film=$2 ;;
    *) echo "gallery.sh: $1: unknown option; there are --program VORPIPE, --into FOLDER and --film STEPS" >&2; exit 2 ;;
  esac
  shift 2
done

spheres=$(mktemp -d)/spheres.png
trap 'rm -r "$(dirname "$spheres")"' EXIT

# draw NAME OPTION...: NAME.png
draw() {
  local name=$1
  shift
  "$program" render --backend cpu -o "$into/$name.png" "$@"
}

# alike NAME OPTION...: NAME.png, and the same picture as shapes
alike() {
  local name=$1
  shift
  "$program" render --backend cpu -o "$into/$name.png" -o "$into/$name.svg" -o "$into/$name.pdf" "$@"
}

# thesis NAME OPTION...: a figure of the thesis, in its colors; smooth NAME OPTION...: the same without stairs
thesis() { draw "$@" --colormap thesis --size 500x500; }
smooth() { thesis "$@" --edges --antialias 4; }

draw title --sites clusters:3000 --seed 7 --view 0,0.25,1,0.75 --size 1000x500 --edges --antialias 4

smooth random-100 --sites random:100
smooth random-1000 --sites random:1000
thesis random-10000 --sites random:10000
thesis random-100000 --sites random:100000
thesis random-1000000 --sites random:1000000
smooth hex-136 --sites hex:136
smooth hex-1235 --sites hex:1235
draw hex-11758 --sites hex:11758 --edges --colormap thesis --size 808x808
smooth square-100 --sites square:100
draw square-1024 --sites square:1024 --edges --colormap thesis --size 512x512
thesis square-10000 --sites square:10000 --edges

alike print --sites random:60 --edges --dual --show-sites --labels --antialias 4 --edge-width 1.5 --size 700
draw dual --sites jitter:100 --periodic xy --edges --dual --no-fill --antialias 4 --edge-width 1.5 --size 400x400
draw labels --sites hex:60 --color area --edges --labels --label-size 14 --antialias 4 --size 400x400
draw bold --sites random:150 --random-weights 0,0.01 --color weight --colormap magma --edges --edge-width 5 --antialias 4 \
  --size 400x400

draw area --sites jitter:2000 --color area --colormap viridis --edges --antialias 4 --size 500x500
draw neighbors --sites random:2000 --color neighbors --colormap plasma --edges --antialias 4 --size 500x500
draw circle --sites circle:60 --colormap turbo --edges --show-sites --antialias 4 --size 500x500

draw power --sites random:300 --random-weights 0,0.01 --color weight --edges --show-sites --antialias 4 --size 500x500
draw periodic --sites random:40 --seed 3 --periodic xy --colormap turbo --edges --show-sites --antialias 4 --size 500x500
draw islands --sites random:2000 --domain "$root/docs/examples/islands.geojson" --edges --antialias 4 --size 800

draw gauges --sites "$root/docs/examples/gauges.csv" --domain "$root/docs/examples/islands.geojson" --edges --show-sites \
  --labels --antialias 4 --size 800
# relaxing DIAGRAMS: sites after that many of Lloyd's steps
relaxing() {
  "$program" relax --backend cpu --sites clusters:120 --seed 4 --domain 0,0,1,1 --method lloyd --iterations "$1" \
    --picture "$into/relaxing-$1.png" --edges --show-sites --antialias 4 --colormap turbo --size 200x200
}
for diagrams in 0 1 4 16 64; do relaxing $diagrams; done

python3 "$root/docs/examples/spheres.py" "$spheres"
"$program" relax --backend cpu --sites density:20000 --density "$spheres" --equal-masses --iterations 100 \
  --picture "$into/stipple.png" --no-fill --show-sites --dot-size 3 --antialias 4 --size 800

python3 "$root/docs/examples/evening.py" "$(dirname "$spheres")/evening.png"
"$program" relax --backend cpu --sites random:1000 --domain 0,0,480,320 --iterations 10 \
  --color "$(dirname "$spheres")/evening.png" --edges --edge-color "#181420" --edge-width 2.5 --antialias 4 --size 960 \
  --picture "$into/glass.png"

# transport NAME OPTION...: NAME.png of cells with prescribed masses
transport() {
  local name=$1
  shift
  "$program" transport --backend cpu --picture "$into/$name.png" --color area --edges --antialias 4 --size 600 "$@"
}
transport shares --sites "$root/docs/examples/states.csv" --domain "$root/docs/examples/disc.wkt" --masses @people \
  --normalize --edge-width 3

made=$(dirname "$spheres")
python3 "$root/docs/examples/towns.py" "$made/towns.png"
"$program" relax --backend cpu --sites density:24 --density "$made/towns.png" --equal-masses -o "$made/centers.csv"
transport districts --sites "$made/centers.csv" --domain 0,0,300,200 --density "$made/towns.png" --edge-width 3 --show-sites

awk 'BEGIN { for (i = 0; i < 300; i++) print i % 25 ? 1 + i % 5 : 40 }' >"$made/bubbles.txt"
"$program" relax --backend cpu --sites random:300 --periodic xy --iterations 10 -o "$made/middles.csv"
transport bubbles --sites "$made/middles.csv" --domain 0,0,1,1 --periodic xy --masses "$made/bubbles.txt" --normalize \
  --color-scale log --edge-width 2

# flow CASE EVERY OPTION...: flow-CASE.png, the end of a fluid; pictures every EVERY steps are in $made/CASE
flow() {
  local case=$1 every=$2
  shift 2
  "$program" fluid --backend cpu --case "$case" --frames "$made/$case" --every "$every" "$@"
  cp "$(ls "$made/$case"/*.png | tail -n 1)" "$into/flow-$case.png"
}
flow taylor-green 100 --particles 1024 --flow-color speed --size 200
flow gresho 100 --particles 1600 --time 0.5 --flow-color speed --size 200
flow shear 100 --particles 1600 --time 0.4 --flow-color speed --size 200
flow shear-wave 100 --particles 1024 --flow-color speed --size 200
flow channel 100 --particles 576 --flow-color speed --size 200
flow dam-break 1000 --particles 1024 --time 0.5 --flow-color speed --size 400
flow rayleigh-taylor "$film" --antialias 2 --size 200x400
# Without Pillow the film that is there stays.
if python3 -c 'import PIL' 2>/dev/null; then
  python3 "$root/docs/examples/film.py" "$made/rayleigh-taylor" "$into/mushroom.gif"
fi

draw masts --sites "$root/docs/examples/masts.csv" --color weight --edges --show-sites --antialias 4 --size 800

draw airports --globe --sites "$root/tests/data/navaids.csv" --map equal-earth --color area --legend --antialias 4 --size 1600 \
  --quiet
draw globe --globe --sites "$root/tests/data/navaids.csv" --view-from=-40,50 --color area \
  --colormap '#ffffe5,#fdae61,#74add1,#b5d6ea' --edges --edge-color '#1b3a57' --antialias 4 --size 800 --quiet
alike italy --sites "$root/tests/data/navaids.csv" --domain "$root/docs/examples/italy.geojson" --project auto --color area \
  --edges --edge-width 1.5 --show-sites --antialias 4 --size 1200 --quiet
draw cities --sites "$root/docs/examples/italian-cities.csv" --domain "$root/docs/examples/italy.geojson" --project auto \
  --color @people --color-scale log --legend beside --legend-title 'people, thousands' --labels @city --label-size 8 \
  --show-sites --edges --antialias 4 --title 'Italy by the nearest of 37 cities' --quiet
draw rain --sites "$root/docs/examples/rain.csv" --domain "$root/docs/examples/catchments.geojson" --color area --legend beside \
  --labels @name --label-size 12 --show-sites --edges --antialias 4 --title 'Thiessen polygons of eight rain gauges' --quiet
alike foam --sites random:500 --random-weights 0,0.001 --periodic xy --color neighbors --colormap plasma --edges \
  --edge-width 2 --legend --antialias 4 --size 800
