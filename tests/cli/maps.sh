#!/usr/bin/env bash
# Domains of files in degrees: the plane of --project and the way back, --margin, hulls, outlines that are dissolved
# or repaired: maps.sh VORPIPE NAVAIDS ITALY
navaids=$(realpath "$2") || exit 1
italy=$(realpath "$3") || exit 1
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# notes NAME TEXT ARGUMENT...: ends with 0 and says lines of notes alone, one of which has TEXT.
notes() {
  name=$1
  local text=$2
  shift 2
  cases=$((cases + 1))
  run 0 "$@"
  grep -qF -- "$text" log/err || fail "no line says '$text'"
  grep -qv '^vorpipe: note: ' log/err && fail "a line is no note"
}
# area LOW HIGH: area_sum in out/s.json lies there.
area() {
  awk -F '[:,]' -v low="$1" -v high="$2" '/"area_sum"/ { seen = $2 > low && $2 < high } END { exit !seen }' out/s.json ||
    fail "area_sum is not between $1 and $2: $(grep area_sum out/s.json)"
}
cells="cells --backend cpu --check --stats out/s.json -o out/s.csv"
printf 'x,y,name\n12,42,a\n13,42.5,b\n12.5,43,c\n' >in/three.csv
printf 'x,y\n12,42\n13,95\n' >in/bad.csv
printf 'x,y\n1012,42\n1013,42.5\n1012.5,43\n' >in/plane.csv
printf '1\n2\n3\n' >in/weights.txt
printf 'x,y\n179,1\n-179,-1\n180,0.5\n' >in/fiji.csv

# -- Projection ---------------------------------------------------------------------------------------
# What lines that are straight in longitude and latitude enclose on the ellipsoid, by numerical integration of the
# outline: 300774.49 km2; of the box, in closed form: 624223.15.
succeeds "a country" $cells --sites "$navaids" --domain "$italy" --project auto
area 300774 300775
grep -q '"name": "Lambert azimuthal equal-area"' out/s.json || fail "out/s.json does not say how it projects"
tr -d ' \n' <out/s.json | grep -qF '"center":[12.6,41.84],"unit":"km"' || fail "out/s.json does not name the center"
cmp -s <(awk -F, 'NR > 1 && $2 < 180 { print $2 "," $3 }' out/s.csv) <(awk -F, 'NR > 1 && $1 > -167.4' "$navaids") ||
  fail "the sites are others"
awk -F, 'NR > 1 && $5 == "ok" && ($8 < 6 || $8 > 19 || $9 < 35 || $9 > 48) { exit 1 }' out/s.csv || fail "a centroid is elsewhere"
# 2 pi R^2 (1 - sin b), with R the authalic radius and b the authalic latitude of 60 degrees.
notes "a box around the pole" "4 %" $cells --sites "$navaids" --domain=-180,60,180,90 --project auto
area 34415000 34416000
succeeds "a box in degrees" $cells --sites "$navaids" --domain 5,47,15,55 --project auto
area 624220 624226
succeeds "a center that is named" $cells --sites "$navaids" --domain 5,47,15,55 --project 11,50
area 624220 624226
tr -d ' \n' <out/s.json | grep -qF '"center":[11.0,50.0]' || fail "out/s.json does not name the center"
succeeds "no domain" $cells --sites in/three.csv --project auto
succeeds "across the antimeridian" $cells --sites in/fiji.csv --project auto
area 50000 65000
cut -d, -f2 out/s.csv | tr '\n' ' ' | grep -q 'x 179 181 180 ' || fail "the sites are not side by side"
succeeds "no projection" $cells --sites in/plane.csv
grep -q '"projection": null' out/s.json || fail "out/s.json has a projection"
succeeds "a picture of a country" render --backend cpu --check --sites "$navaids" --domain "$italy" --project auto --size 60x70 --stats out/s.json
notes "weights are areas" "weights are square kilometers" $cells --sites in/three.csv --weights in/weights.txt --project auto
notes "a domain that is large" "reaches 4" $cells --sites "$navaids" --domain=-30,-30,30,30 --project auto
refuses "the world" "--project: the domain reaches 180 degrees" --sites "$navaids" --project auto
refuses "a center on the other side" "name one that is nearer" --sites "$navaids" --domain "$italy" --project 190,-40
refuses "a latitude that is none" "--project: site 1 at 13, 95" --sites in/bad.csv --project auto
refuses "a domain that is no box of degrees" "--domain" --sites in/three.csv --project auto --domain 0,0,1,91
refuses "a generator in degrees" "--project: is for files" --sites random:9 --project auto
refuses "the Earth repeats itself" "--periodic" --sites in/three.csv --project auto --domain 0,0,1,1 --periodic x
for center in "" here 1 1,2,3 1,91 400,0 nan,0; do refuses "center '$center'" "--project" --sites in/three.csv --project "$center"; done

# -- Margin, hull, period -----------------------------------------------------------------------------
succeeds "a margin" $cells --sites in/plane.csv --margin 0.5
area 3.9999 4.0001
succeeds "a margin in percent" $cells --sites in/plane.csv --margin 100%
area 8.9999 9.0001
succeeds "no margin" $cells --sites in/plane.csv --margin 0
area 0.9999 1.0001
succeeds "a margin in kilometers" $cells --sites in/three.csv --project auto --margin 0
area 8800 9400
succeeds "a hull" $cells --sites in/plane.csv --domain hull
area 0.3749 0.3751
succeeds "a hull with a margin" $cells --sites in/plane.csv --domain hull --margin 10%
area 0.7 0.8
succeeds "a hull in degrees" $cells --sites in/three.csv --domain hull --project auto
area 3400 3450
succeeds "a hull of a generator" $cells --sites random:50 --domain hull
for margin in "" -1 a 1%% nan -5%; do refuses "margin '$margin'" "--margin" --sites in/plane.csv --margin="$margin"; done
refuses "a margin of a domain" "--margin" --sites in/plane.csv --margin 1 --domain 0,0,1,1
refuses "a margin of a generator" "--margin" --sites random:9 --margin 1
refuses "a hull of two" "--domain: the hull of 2 sites has no area" --sites random:2 --domain hull
refuses "a hull that repeats itself" "--periodic" --sites random:9 --domain hull --periodic x
printf 'x,y\n1001,1\n1002,1\n1003,1\n' >in/line.csv
refuses "a hull of a line" "they all lie on a line" --sites in/line.csv --domain hull
refuses "no margin around a line" "--margin: the sites lie on a line" --sites in/line.csv --margin 0
refuses "a file does not say its period" "--periodic: name the period by --domain XMIN,YMIN,XMAX,YMAX" --sites in/plane.csv --periodic xy
succeeds "a period that is named" $cells --sites in/plane.csv --periodic xy --domain 1012,42,1013,43

# -- Dissolved and repaired ---------------------------------------------------------------------------
printf 'MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((1 0, 2 0, 2 1, 1 1, 1 0)))' >in/touch.wkt
printf 'POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0)) POLYGON ((1 1, 3 1, 3 3, 1 3, 1 1))' >in/overlap.wkt
printf 'POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))' >in/bow.wkt
notes "districts" "--domain: in/touch.wkt: 2 polygons that touch dissolved into 1" $cells --sites random:50 --domain in/touch.wkt
area 1.9999 2.0001
notes "districts that overlap" "the area of all was 8, without overlaps it is 7" $cells --sites random:50 --domain in/overlap.wkt
area 6.9999 7.0001
refuses "a bow-tie" "Self-intersection at (0.5, 0.5)" --sites random:9 --domain in/bow.wkt
grep -q -- '--repair mends it' log/err || fail "the line does not say what helps"
notes "a bow-tie repaired" "1 of 1 polygons repaired" $cells --sites random:50 --domain in/bow.wkt --repair
area 0.4999 0.5001
refuses "nothing to repair" "--repair" --sites random:9 --repair

finish
