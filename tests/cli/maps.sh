#!/usr/bin/env bash
# Domains of files in degrees: the plane of --project and the way back, --margin, hulls, outlines that are dissolved
# or repaired: maps.sh VORPIPE NAVAIDS ITALY
navaids=$(realpath "$2") || exit 1
italy=$(realpath "$3") || exit 1
examples=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../docs/examples") || exit 1
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
# Sides that bend have places in between; only where a cell around a pole is led along the meridian is one longer.
printf 'lon,lat\n0,75\n45,75\n90,75\n135,75\n180,75\n225,75\n270,75\n315,75\n0,90\n' >in/cap.csv
sed 's/,75/,-75/; s/,90/,-90/' in/cap.csv >in/south.csv
steps() {
  sed -n '/POLYGON/{s/[^(]*((//; s/)).*//; p}' "out/$1" | awk -F ', ' '{
    most = 0
    for (k = 2; k <= NF; ++k) { split($k, b, " "); split($(k - 1), a, " "); d = b[1] - a[1]; if (d < 0) d = -d; if (d > most) most = d }
    printf "%d ", most + 0.5 }'
}
notes "cells around the north pole" "4 %" $cells -o out/n.wkt -o out/n.geojson -o out/edges.geojson --sites in/cap.csv --domain=-180,60,180,90 --project auto
[ "$(steps n.wkt)" = "6 6 6 6 6 6 6 6 360 " ] || fail "longitudes jump: $(steps n.wkt)"
sed -n 6p out/n.wkt | grep -q '202.[45]' || fail "the cell of 180 does not reach 202.5: $(sed -n 6p out/n.wkt)"
sed -n 10p out/n.wkt | grep -q ', 180 90, -180 90, ' || fail "the pole's cell does not hold it: $(sed -n 10p out/n.wkt)"
notes "cells around the south pole" "4 %" $cells -o out/n.wkt --sites in/south.csv --domain=-180,-90,180,-60 --project auto
[ "$(steps n.wkt)" = "6 6 6 6 6 6 6 6 360 " ] || fail "longitudes jump: $(steps n.wkt)"
sed -n 10p out/n.wkt | grep -q ', -180 -90, 180 -90, ' || fail "the pole's cell does not hold it: $(sed -n 10p out/n.wkt)"
printf 'x,y,name\n9.19,45.46,Mi\n12.5,41.9,Ro\n14.25,40.85,Na\n' >in/cities.csv
printf '50\n80\n10\n' >in/trade.txt
succeeds "transport leaves sites where they are" transport --backend cpu --sites in/cities.csv --domain "$italy" --project auto \
  --masses in/trade.txt --normalize -o out/t.csv --cells out/tc.csv
cut -d, -f1,2 out/t.csv | tail -n +2 | cmp -s - <(cut -d, -f1,2 in/cities.csv | tail -n +2) || fail "transport moved the sites"
cut -d, -f2,3 out/tc.csv | tail -n +2 | cmp -s - <(cut -d, -f1,2 in/cities.csv | tail -n +2) || fail "transport moved the sites of cells"
refuses "the world" "--project: the domain may reach 90 degrees from the center of the projection, and reaches 180; the center is " --sites "$navaids" --project auto
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
succeeds "a hull of a line with a margin" $cells --sites in/line.csv --domain hull --margin 10%
area 0.9599 0.9601
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
refuses "a bow-tie" "--domain: in/bow.wkt: Self-intersection at (0.5, 0.5)" --sites random:9 --domain in/bow.wkt
grep -q -- '--repair mends it' log/err || fail "the line does not say what helps"
notes "a bow-tie repaired" "1 of 1 polygons repaired" $cells --sites random:50 --domain in/bow.wkt --repair
area 0.4999 0.5001
refuses "nothing to repair" "--repair" --sites random:9 --repair

# -- Systems ------------------------------------------------------------------------------------------
crs() { printf '"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::%s"}},' "$1"; }
geojson() { printf '{"type":"FeatureCollection",%s"features":[{"type":"Feature","properties":{},"geometry":%s}]}' "$1" "$2"; }
ring='{"type":"Polygon","coordinates":[[[3.5,51],[7,51],[7,53],[3.5,53],[3.5,51]]]}'
geojson "$(crs 3857)" '{"type":"MultiPoint","coordinates":[[731641,6902454],[507024,6850045],[600000,6800000]]}' >in/mercator.geojson
geojson "" '{"type":"MultiPoint","coordinates":[[4,52],[5,52.5],[6,51.5]]}' >in/towns.geojson
geojson "" "$ring" >in/country.geojson
geojson "$(crs 4258)" "$ring" >in/etrs.geojson
refuses "sites in another system" "--domain: in/country.geojson is in EPSG:4326, in/mercator.geojson in EPSG:3857; take one" \
  --sites in/mercator.geojson --domain in/country.geojson
refuses "in another system to be projected" "in/mercator.geojson in EPSG:3857; --project takes both in degrees, as ogr2ogr -t_srs EPSG:4326 makes" \
  --sites in/mercator.geojson --domain in/country.geojson --project auto
geojson "$(crs 25832)" "$ring" >in/utm.geojson
refuses "an outline of a plane to be projected" "--project: in/utm.geojson says that its coordinates are those of a plane" \
  --sites in/three.csv --domain in/utm.geojson --project auto
notes "degrees that are near to each other" "in/etrs.geojson is in EPSG:4258, in/towns.geojson in EPSG:4326, which is the same" \
  $cells --sites in/towns.geojson --domain in/etrs.geojson --project auto
printf 'x,y\n731641,6902454\n507024,6850045\n' >in/unnamed.csv
notes "no site in the domain" "--domain: no site lies in the box 3.5,51,7,53; those of in/unnamed.csv lie in 507024,6850045,731641,6902454" \
  $cells --sites in/unnamed.csv --domain in/country.geojson
printf 'PROJCS["WGS_1984_UTM_Zone_32N",GEOGCS["GCS_WGS_1984"]]' >in/unnamed.prj
refuses "a system beside sites" "in/country.geojson is in EPSG:4326, in/unnamed.csv in EPSG:32632" --sites in/unnamed.csv --domain in/country.geojson
mv in/unnamed.prj in/unnamed.PRJ
refuses "a system beside sites, in capitals" "in/unnamed.csv in EPSG:32632" --sites in/unnamed.csv --domain in/country.geojson
printf 'apples' >in/unnamed.PRJ
refuses "a system that is none" "--sites: in/unnamed.PRJ: is no coordinate system in WKT" --sites in/unnamed.csv
printf 'lon,lat\n12,42\n13,89\n14,-80\n' >in/polar.csv
notes "a box of degrees ends at the poles" "it ends at 90" $cells --sites in/polar.csv
grep -q '"domain": \[' out/s.json && tr -d ' \n' <out/s.json | grep -q ',90.0\],\|,90\],' || fail "the domain goes beyond the pole"
printf 'x,y\n-120,42\n130,89\n14,-70\n' >in/polar.csv
notes "a box of what looks like degrees ends there as well" "would reach latitude 101.5: it ends at 90" $cells --sites in/polar.csv
printf 'lon,lat\n0,60\n20,60\n10,80\n' >in/north.csv
notes "a hull of degrees ends at the poles" "with its margin the hull of the sites would reach latitude" \
  $cells -o out/north.wkt --sites in/north.csv --domain hull --margin 20
grep -oE '[-0-9.]+ [-0-9.]+[,)]' out/north.wkt | tr -d ',)' | awk '$2 > 90 { exit 1 } $2 == 90 { seen = 1 } END { exit !seen }' ||
  fail "the hull does not end at 90"

# -- Systems that are adopted and named -----------------------------------------------------------------
# in_system FILE EPSG: the GeoPackage is in that system, as SQLite finds it in the layer's own row.
in_system() {
  local found
  found=$(/usr/bin/python3 -c 'import sqlite3, sys
print(*sqlite3.connect(sys.argv[1]).execute("select organization || char(58) || organization_coordsys_id from gpkg_contents join gpkg_spatial_ref_sys using (srs_id)").fetchone())' "$1")
  [ "$found" = "$2" ] || fail "$1 is in $found, not in $2"
}
printf 'x,y,name,code\n300,200,Aa,1\n700,300,"B, b",2\n500,800,Cc,3\n700,300,Twin,4\n' >in/wells.csv
geojson "$(crs 25832)" '{"type":"Polygon","coordinates":[[[0,0],[1000,0],[1000,1000],[0,1000],[0,0]]]}' >in/district.geojson
geojson "$(crs 25832)" '{"type":"MultiPoint","coordinates":[[300,200],[700,300],[500,800]]}' >in/wells.geojson
succeeds "GeoJSON of a plane names it" cells --backend cpu --sites in/wells.csv --crs EPSG:25832 --quiet -o out/a.geojson --edges out/e.geojson --triangulation out/t.geojson
for file in a e t; do head -1 out/$file.geojson | grep -qF '"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},"features":[' || fail "out/$file.geojson: $(head -1 out/$file.geojson)"; done
succeeds "and is an outline in it" cells --backend cpu --sites random:20 --domain out/a.geojson --quiet -o out/own.gpkg
in_system out/own.gpkg EPSG:25832
notes "lines of a plane do not" "out/a.geojsonl: readers take the coordinates of GeoJSON for degrees" cells --backend cpu --sites in/wells.csv --crs EPSG:25832 -o out/a.geojson -o out/a.geojsonl
succeeds "degrees are the usual" cells --backend cpu --sites in/towns.geojson --domain in/country.geojson --project auto --quiet -o out/a.geojson
head -1 out/a.geojson | grep -q crs && fail "WGS 84 is named"
notes "sites adopt the system of their outline" "in/wells.csv: names no coordinate system, and is taken to be in EPSG:25832, as in/district.geojson is" \
  cells --backend cpu --check --sites in/wells.csv --domain in/district.geojson -o out/a.gpkg -o out/a.csv --edges out/e.gpkg --triangulation out/t.gpkg
for file in a e t; do in_system out/$file.gpkg EPSG:25832; done
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == "area_km2") at = k; next }
  { d = $6 / 1e6 - $at; if (!at || d > 1e-15 || d < -1e-15) exit 1 } END { exit NR != 5 }' out/a.csv || fail "area_km2 is not the area in square kilometers"
succeeds "a pattern is in the system of the outline that it fills" cells --backend cpu --sites random:20 --domain in/district.geojson -o out/a.gpkg
in_system out/a.gpkg EPSG:25832
succeeds "a system that is named" cells --backend cpu --check --sites in/wells.csv --crs EPSG:25832 -o out/a.gpkg -o out/a.geojsonl --quiet
in_system out/a.gpkg EPSG:25832
grep -q '"area_km2":0' out/a.geojsonl || fail "no square kilometers in GeoJSON"
succeeds "a plane in degrees has no square kilometers" cells --backend cpu --sites in/wells.csv -o out/a.csv
head -1 out/a.csv | grep -q km2 && fail "square kilometers of a unit that nothing names"
succeeds "Web Mercator has none" cells --backend cpu --sites in/wells.csv --crs EPSG:3857 -o out/a.csv
head -1 out/a.csv | grep -q km2 && fail "square kilometers of Web Mercator"
printf 'PROJCS["Some state",GEOGCS["X",UNIT["degree",0.0174532925199433]],UNIT["US survey foot",0.3048006096012192]]' >in/feet.prj
cp in/wells.csv in/feet.csv
succeeds "feet are known by the definition" cells --backend cpu --sites in/feet.csv --domain 0,0,5280,5280 -o out/a.csv
awk -F, -v OFMT=%.9f 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == "area_km2") at = k; next } { sum += $at } END { exit !(at && sum > 2.58999 && sum < 2.590007) }' out/a.csv ||
  fail "a square mile is not 2.59 km2"
succeeds "a system to be projected" cells --backend cpu --sites in/three.csv --crs EPSG:4258 --project auto -o out/a.gpkg
in_system out/a.gpkg EPSG:4258
refuses "a system that the sites contradict" "--crs: EPSG:25833 is named, and in/wells.geojson is in EPSG:25832" --sites in/wells.geojson --crs EPSG:25833
refuses "a system that the outline contradicts" "--crs: EPSG:4326 is named, and in/district.geojson is in EPSG:25832" --sites in/wells.csv --domain in/district.geojson --crs EPSG:4326
refuses "degrees that are none" "--crs: EPSG:4326 is of degrees, and coordinates of in/wells.csv are none" --sites in/wells.csv --crs EPSG:4326
notes "no code" "--crs: EPSG:99 is no code of EPSG, which are 1024 to 32767" cells --backend cpu --sites in/wells.csv --crs EPSG:99 -o out/a.csv
for system in "" Mars EPSG:0 EPSG:x 'FRUIT["apple"]'; do refuses "the system '$system'" "--crs: " --sites in/wells.csv --crs "$system"; done
geojson "" '{"type":"Polygon","coordinates":[[[0,0],[90,0],[90,90],[0,90],[0,0]]]}' >in/degrees.geojson
succeeds "coordinates that are no degrees do not become some" cells --backend cpu --sites in/wells.csv --domain in/degrees.geojson -o out/a.gpkg --quiet
in_system out/a.gpkg NONE:-1

# -- Names, shares, owners, the triangulation -------------------------------------------------------------
succeeds "neighbors by name" cells --backend cpu --check --sites in/wells.csv --id @name --share -o out/a.csv -o out/a.geojson -o out/a.gpkg \
  --edges out/e.csv --triangulation out/t.csv --triangulation out/t.wkt --triangulation out/t.vtp
/usr/bin/python3 - <<'END' || fail "names, owners or shares are wrong"
import csv, json, sqlite3
rows = list(csv.DictReader(open("out/a.csv")))
assert [r["owner"] for r in rows] == ["Aa", "B, b", "Cc", "B, b"], rows
assert rows[0]["neighbors"].split(";") == ["ymin", "B, b", "Cc", "xmin"], rows[0]
assert abs(sum(float(r["share"]) for r in rows) - 1) < 1e-12
features = json.load(open("out/a.geojson"))["features"]
assert [f["properties"]["neighbors"] for f in features] == [r["neighbors"].split(";") if r["neighbors"] else [] for r in rows]
assert [f["properties"]["owner"] for f in features] == [r["owner"] for r in rows]
assert list(sqlite3.connect("out/a.gpkg").execute("select owner, neighbors, share from cells order by site")) == [(r["owner"], r["neighbors"], float(r["share"])) for r in rows]
edges = {(r["site_a"], r["site_b"]) for r in csv.DictReader(open("out/e.csv"))}
assert ("Aa", "B, b") in edges and ("Aa", "xmin") in edges and len(edges) == 10, edges
assert [(r["site_a"], r["site_b"]) for r in csv.DictReader(open("out/t.csv"))] == [("Aa", "B, b"), ("Aa", "Cc"), ("B, b", "Cc")]
END
printf '1\n1\n1\n1\n' >in/four.txt
printf 'x,y,name\n1,1,Aa\n# none\n2,1,Bb\n1,2,Aa\n' >in/twice.csv
printf 'x,y,name\n1,1,Aa\n2,1,\n' >in/nameless.csv
printf 'x,y,name\n1,1,Aa\n2,1,a;b\n' >in/semicolon.csv
printf 'x,y,name\n1,1,xmin\n2,1,Bb\n' >in/wall.csv
refuses_id() { fails 2 "$1" "$2" cells --backend cpu "${@:3}" -o out/old.csv; }
refuses_id "a name of two lines" '--sites: in/twice.csv:5:5: "Aa" is that of line 2 as well; each site needs another (column name)' --sites in/twice.csv --id @name
refuses_id "a line without a name" "in/nameless.csv:3:5: empty field" --sites in/nameless.csv --id @name
refuses_id "a name with what separates names" "has a semicolon" --sites in/semicolon.csv --id @name
refuses_id "a name of a wall" '"xmin" is the name of a wall' --sites in/wall.csv --id @name
refuses_id "an attribute that is not there" '--id: the sites have no attribute "nam"; they have "name", "code"' --sites in/wells.csv --id @nam
cp out/a.csv in/named.csv
for id in name @NAME Name; do
  succeeds "names by $id" cells --backend cpu --sites in/wells.csv --id $id --share -o out/a.csv
  cmp -s in/named.csv out/a.csv || fail "the names are others"
done
printf 'x,y,Name,NAME\n1,1,Aa,A\n2,1,Bb,B\n' >in/cases.csv
refuses_id "a name that may be either" '--id: the sites have no attribute "name"; they have "Name", "NAME"' --sites in/cases.csv --id @name
succeeds "a name that is meant" cells --backend cpu --sites in/cases.csv --id @NAME --quiet -o out/a.csv
[ "$(sed -n 2p out/a.csv | cut -d, -f11)" = '"ymax;xmin;ymin;B"' ] || fail "other names: $(cat out/a.csv)"
succeeds "names with what separates names, where nothing is separated" cells --backend cpu --sites in/semicolon.csv --id @name \
  -o out/a.geojson --triangulation out/t.csv --edges out/e.csv
grep -qx '0,Aa,"a;b",.*' out/t.csv || fail "other names: $(cat out/t.csv)"
refuses_id "the same where they are" '"a;b" has a semicolon, which separates neighbors in .csv and .gpkg' --sites in/semicolon.csv --id @name --edges out/old.geojson
# A cell with two edges to one neighbor, and three along an outline.
printf 'x,y,name\n0,0,mid\n0,-3,low\n' >in/bar.csv
geojson "" '{"type":"Polygon","coordinates":[[[-4,-4],[4,-4],[4,2],[1,2],[1,-2],[-1,-2],[-1,2],[-4,2],[-4,-4]]]}' >in/fork.geojson
succeeds "each neighbor once by name" cells --backend cpu --check --sites in/bar.csv --domain in/fork.geojson --id @name --quiet -o out/a.csv -o out/a.geojson -o out/a.gpkg -o out/a.npz
/usr/bin/python3 - <<'END' || fail "a neighbor is named twice, or not at all"
import csv, json, numpy, sqlite3
rows = [r["neighbors"].split(";") for r in csv.DictReader(open("out/a.csv"))]
arrays = numpy.load("out/a.npz")
offsets, neighbors = arrays["neighbor_offsets"], arrays["neighbors"]
for site, names in enumerate(rows):
    own = neighbors[offsets[site]:offsets[site + 1]].tolist()
    named = {0: "mid", 1: "low", -1: "xmin", -2: "xmax", -3: "ymin", -4: "ymax", -5: "outline"}
    assert sorted(names) == sorted({named[k] for k in own}), (names, own)
assert [len(set(neighbors[offsets[s]:offsets[s + 1]])) < offsets[s + 1] - offsets[s] for s in (0, 1)] == [True, True]
assert [f["properties"]["neighbors"] for f in json.load(open("out/a.geojson"))["features"]] == rows
assert [r[0].split(";") for r in sqlite3.connect("out/a.gpkg").execute("select neighbors from cells order by site")] == rows
END
fails 2 "names of nothing" "--id: there is no output with names" cells --backend cpu --sites in/wells.csv --id @name -o out/old.npz
fails 2 "shares of nothing" "--share: there is no output" cells --backend cpu --sites in/wells.csv --share -o out/old.npz
fails 2 "a triangulation that repeats itself" "--triangulation: there is none in a domain that repeats" cells --backend cpu --sites random:9 --periodic x --triangulation out/old.csv
fails 2 "a triangulation of drops" "--triangulation: there is none of cells with a free" cells --backend cpu --sites in/wells.csv --weights in/four.txt --surface free --triangulation out/old.csv
succeeds "the triangulation is complete whatever the domain" cells --backend cpu --sites random:400 --domain 0.45,0.45,0.55,0.55 --quiet -o out/a.npz --triangulation out/t.csv --triangulation out/t.geojson
/usr/bin/python3 - <<'END' || fail "the triangulation is not scipy's"
import csv, json, math, numpy, scipy.spatial
sites = numpy.load("out/a.npz")["sites"]
rows = list(csv.DictReader(open("out/t.csv")))
pairs = [(int(r["site_a"]), int(r["site_b"])) for r in rows]
qhull = scipy.spatial.Delaunay(sites)
assert set(pairs) == {tuple(sorted((int(t[k]), int(t[k - 1])))) for t in qhull.simplices for k in range(3)}
assert pairs == sorted(set(pairs))
for r, (a, b) in zip(rows, pairs):
    assert (float(r["x1"]), float(r["y1"]), float(r["x2"]), float(r["y2"])) == (*sites[a], *sites[b])
    assert abs(float(r["length"]) - math.dist(sites[a], sites[b])) < 1e-15
lines = [f["geometry"]["coordinates"] for f in json.load(open("out/t.geojson"))["features"]]
assert lines == [[list(sites[a]), list(sites[b])] for a, b in pairs]
END
printf '0,0\n4,4\n1,1\n2,2\n1,1\n' >in/row.csv
succeeds "sites on a line are pairs that follow each other" cells --backend cpu --sites in/row.csv --triangulation out/t.csv --quiet
[ "$(cut -d, -f2,3 out/t.csv | tr '\n' ' ')" = "site_a,site_b 0,2 1,3 2,3 " ] || fail "not the pairs: $(cat out/t.csv)"
printf '0,0,0\n4,4,0\n1,1,-9\n2,2,0\n' >in/row.csv
succeeds "a heavier site hides one on a line" cells --backend cpu --sites in/row.csv --triangulation out/t.csv --quiet
[ "$(cut -d, -f2,3 out/t.csv | tr '\n' ' ')" = "site_a,site_b 0,3 1,3 " ] || fail "not the pairs: $(cat out/t.csv)"

# -- Files with outlines ------------------------------------------------------------------------------
printf '{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,1],[0,1],[0,0]]]}\n{"type":"Polygon","coordinates":[[[2,0],[3,0],[3,1],[2,1],[2,0]]]}\n' >in/parts.geojsonl
notes "lines of GeoJSON" "dissolved into 1" $cells --sites random:50 --domain in/parts.geojsonl
area 2.9999 3.0001
gzip -c in/country.geojson >in/country.geojson.gz
succeeds "a file that is packed" $cells --sites random:50 --domain in/country.geojson.gz
area 6.9999 7.0001
succeeds "cells to be an outline" cells --backend cpu --sites random:20 --domain 0,0,3,1 -o out/own.wkt -o out/own.gpkg
notes "cells as WKT are an outline" "dissolved into 1" $cells --sites random:50 --domain out/own.wkt
area 2.9999 3.0001
notes "cells as a GeoPackage are an outline" "dissolved into 1" $cells --sites random:50 --domain out/own.gpkg
area 2.9999 3.0001
refuses "a layer that is not there" "--domain: out/own.gpkg: has no layer \"towns\"" --sites random:9 --domain out/own.gpkg --domain-layer towns
refuses "a layer of no GeoPackage" "has no layers" --sites random:9 --domain in/parts.geojsonl --domain-layer a
refuses "a layer of no file" "--domain-layer" --sites random:9 --domain-layer a
refuses "across the antimeridian" "--domain: xmin 177 is not below xmax -177; in degrees, across the antimeridian, xmax is 183" \
  --sites random:9 --domain 177,-20,-177,-15
fails 2 "a box that is none" "xmin 3 is not below xmax 1" cells --sites random:5 --domain 3,0,1,1 -o out/a.csv
grep -q 'in degrees' log/err && fail "it speaks of degrees"

# -- Cells in each feature --------------------------------------------------------------------------------
# pieces TABLE LAYER SITES OUTLINE NAME: what a table and a layer have agrees, shares add up, areas are those of the features
# and of what GEOS makes of the sites' cells; shapely and pandas are not ours.
pieces() {
  /usr/bin/python3 - "$@" <<'END' || fail "the pieces are wrong"
import sys
import geopandas, numpy, pandas, shapely.geometry, shapely.ops
table, layer, sites, outline, name = sys.argv[1:]
rows, shapes = pandas.read_csv(table, float_precision="round_trip"), geopandas.read_file(layer)
features, points = geopandas.read_file(outline), pandas.read_csv(sites, float_precision="round_trip")
assert shapes.crs.to_epsg() == features.crs.to_epsg() or features.crs.to_epsg() == 4326, shapes.crs
for column in rows:
    if column != "geometry":
        assert (rows[column].fillna(-1) == shapes[column].fillna(-1)).all(), column
numpy.testing.assert_allclose(rows.share.groupby(rows[name]).sum(), 1, rtol=1e-12)
numpy.testing.assert_allclose(rows.area_km2, rows.area / 1e6, rtol=1e-14)
numpy.testing.assert_allclose(shapes.geometry.area, rows.area, rtol=1e-9)
assert shapes.geometry.is_valid.all()
whole = features.set_index(name).geometry.area
numpy.testing.assert_allclose(rows.area.groupby(rows[name]).sum(), whole.sort_index(), rtol=1e-9)
assert list(rows[name].drop_duplicates()) == list(features[name]), "the order of features is another"
# GEOS clips the cells of an own diagram to the features.
around = shapely.geometry.box(*features.total_bounds).buffer(whole.sum() ** 0.5 * 20)
places = [shapely.geometry.Point(at) for at in zip(points.x, points.y)]
cells = list(shapely.ops.voronoi_diagram(shapely.geometry.MultiPoint(places), around).geoms)
low_x, low_y, high_x, high_y = numpy.array([cell.bounds for cell in cells]).T
def around_place(place):
    near = numpy.flatnonzero((low_x <= place.x) & (place.x <= high_x) & (low_y <= place.y) & (place.y <= high_y))
    return next(cells[k] for k in near if cells[k].contains(place))
cells = [around_place(place) for place in places]
areas = {(feature, site): area for feature, site, area in zip(rows[name], rows.site, rows.area)}
for feature, shape in zip(features[name], features.geometry):
    for site, cell in enumerate(cells):
        area = cell.intersection(shape).area
        there = areas.get((feature, site), 0)
        assert (there > 0) == (area > 0) and abs(there - area) <= 1e-9 * shape.area, (feature, site, there, area)
END
}
printf '1e7\n2e7\n0\n0\n1e8\n0\n3e7\n5\n' >in/eight.txt
succeeds "shares of catchments" cells --backend cpu --check --sites "$examples/rain.csv" --domain "$examples/catchments.geojson" --by name --quiet \
  -o out/p.csv -o out/p.gpkg -o out/p.geojson -o out/p.geojsonl --stats out/s.json
pieces out/p.csv out/p.gpkg "$examples/rain.csv" "$examples/catchments.geojson" name
head -1 out/p.csv | grep -qx 'name,site,x,y,area,area_km2,share,site_name,rain_mm' || fail "the header is another: $(head -1 out/p.csv)"
grep -q '"pieces": ' out/s.json || fail "out/s.json does not count pieces"
ogrinfo -so out/p.gpkg pieces 2>&1 | grep -q 'ETRS89 / UTM zone 32N' || fail "GDAL finds another system in out/p.gpkg"
in_system out/p.gpkg EPSG:25832
ogrinfo -so out/p.geojson p 2>&1 | grep -q 'ETRS89 / UTM zone 32N' || fail "GDAL finds another system in out/p.geojson"
[ "$(grep -c '"type":"Feature",' out/p.geojson)" = "$(wc -l <out/p.geojsonl)" ] || fail "lines are not features"
cp out/p.csv out/p4.csv
succeeds "any number of threads gives the same bytes" cells --backend cpu --threads 1 --sites "$examples/rain.csv" --domain "$examples/catchments.geojson" --by name --quiet -o out/p.csv
cmp -s out/p.csv out/p4.csv || fail "one thread gives other bytes"
seed=$RANDOM
/usr/bin/python3 - $seed <<'END'
import random, sys
random.seed(int(sys.argv[1]))
with open("in/many.csv", "w") as file:
    print("x,y", file=file)
    for _ in range(3000):
        print(random.uniform(580e3, 630e3), random.uniform(5712e3, 5752e3), sep=",", file=file)
END
succeeds "many sites (seed $seed)" cells --backend cpu --sites in/many.csv --domain "$examples/catchments.geojson" --by code --quiet -o out/p.csv -o out/p.gpkg
pieces out/p.csv out/p.gpkg in/many.csv "$examples/catchments.geojson" code
succeeds "pieces of a power diagram" cells --backend cpu --check --sites "$examples/rain.csv" --weights in/eight.txt --domain "$examples/catchments.geojson" --by name --quiet -o out/p.csv
awk -F, 'NR > 1 { sum[$1] += $8 } END { for (k in sum) if (sum[k] < 1 - 1e-12 || sum[k] > 1 + 1e-12) exit 1; exit length(sum) != 3 }' out/p.csv || fail "shares do not add up: $(cat out/p.csv)"

# by_qgis LAYER...: what QGIS reads of files in out/ goes to in/LAYER.qgis.csv: the fields, and as "qgis" the system, whether
# a shape is valid, its area in the plane, and in km2 on the ellipsoid.
by_qgis() {
  local layer
  export QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR=$work/qgis
  mkdir -p -m 700 "$XDG_RUNTIME_DIR"
  for layer in "$@"; do
    HOME=$XDG_RUNTIME_DIR "$qgis" run native:fieldcalculator --ellipsoid=EPSG:7030 --area_units=km2 -- INPUT="out/$layer" FIELD_NAME=qgis \
      FIELD_TYPE=2 FIELD_LENGTH=200 FORMULA="concat(@layer_crs, ' ', is_valid(\$geometry), ' ', area(\$geometry), ' ', \$area)" \
      OUTPUT="in/$layer.qgis.csv" >"log/$layer" 2>&1 || echo "QGIS does not read out/$layer: $(tail -1 "log/$layer")" >&2 &
  done
  wait
}
# Debian's wrapper hands on options of the window, which qgis_process does not know.
qgis=$(command -v qgis_process.bin || command -v qgis_process)
if [ -n "$qgis" ]; then
  succeeds "for QGIS: shares" cells --backend cpu --sites "$examples/rain.csv" --domain "$examples/catchments.geojson" --by name --quiet -o out/p.gpkg -o out/p.geojson
  succeeds "for QGIS: cells of gauges" cells --backend cpu --sites "$examples/rain.csv" --domain "$examples/catchments.geojson" --quiet -o out/c.geojson
  succeeds "for QGIS: a country" cells --backend cpu --sites "$examples/italian-cities.csv" --domain "$italy" --project auto --quiet -o out/i.gpkg
  name="QGIS reads shares, cells and a country"
  by_qgis p.gpkg p.geojson c.geojson i.gpkg
  /usr/bin/python3 - <<'END' || fail "QGIS reads something else"
import csv
read, areas = {}, {}
for layer in ("p.gpkg", "p.geojson", "c.geojson", "i.gpkg"):
    rows = read[layer] = list(csv.DictReader(open(f"in/{layer}.qgis.csv")))
    there = [row["qgis"].split() for row in rows]
    assert {at[0] for at in there} == {"EPSG:4326" if layer[0] == "i" else "EPSG:25832"}, (layer, there)
    assert all(at[1] == "true" for at in there), f"a shape in {layer} is not valid: {there}"
    for row, at in zip(rows, there):
        area, flat, round_ = float(row["area"]), float(at[2]), float(at[3])
        if layer[0] == "i":  # edges are straight in another plane
            assert abs(round_ - area) < 1e-2 * area, (layer, row)
        else:
            assert abs(flat - area) < 1e-9 * area and abs(float(row["area_km2"]) - area / 1e6) < 1e-9, (layer, row)
            assert abs(round_ - area / 1e6) < 1e-3 * round_, f"a part in a thousand of UTM: {layer}, {row}"
    areas[layer] = sum(float(at[3]) for at in there)
assert [len(rows) for rows in read.values()] == [13, 13, 8, 37], {layer: len(rows) for layer, rows in read.items()}
assert abs(areas["i.gpkg"] - 300774.5) < 300, areas
assert list(read["p.gpkg"][0]) == ["fid", *read["p.geojson"][0]], (list(read["p.gpkg"][0]), list(read["p.geojson"][0]))
assert list(read["p.geojson"][0]) == ["name", "site", "x", "y", "area", "area_km2", "share", "site_name", "rain_mm", "qgis"]
assert read["i.gpkg"][27]["city"] == "Forl\u00ec", read["i.gpkg"][27]
END
else
  skipped "QGIS reads shares and cells" "there is no qgis_process"
fi
square() { printf '{"type":"Feature","properties":{"name":%s,"area":7},"geometry":{"type":"Polygon","coordinates":[[[%d,0],[%d,0],[%d,2],[%d,2],[%d,0]]]}}' "$1" $2 $3 $3 $2 $2; }
printf '{"type":"FeatureCollection",%s"features":[%s,%s,%s,%s,{"type":"Feature","properties":{"name":"none"},"geometry":null}]}' "$(crs 25832)" \
  "$(square '"a"' 0 2)" "$(square '"b"' 1 3)" "$(square '"a"' 5 6)" "$(square null 6 7)" >in/squares.geojson
geojson "" '{"type":"Polygon","coordinates":[[[0,0],[1,1],[1,0],[0,1],[0,0]]]}' | sed 's/"properties":{}/"properties":{"name":"x"}/' >in/bow.geojson
printf 'x,y,share\n0,0,1\n4,0,2\n' >in/pair.csv
notes "features that overlap count each for itself, those of one name are one" '--by: 1 of the features in in/squares.geojson have the "name" of one before them' \
  cells --backend cpu --check --sites in/pair.csv --domain in/squares.geojson --by name -o out/p.csv
grep -qxF 'vorpipe: note: --by: 1 of the features in in/squares.geojson has no polygon, and is left out' log/err || fail "nothing of the feature without a polygon"
cp out/p.csv in/pieces.csv
for by in @name Name; do
  succeeds "by $by" cells --backend cpu --sites in/pair.csv --domain in/squares.geojson --by $by --quiet -o out/p.csv
  cmp -s in/pieces.csv out/p.csv || fail "other pieces"
done
notes "pieces as lines of a plane" 'out/p.geojsonl: readers take the coordinates of GeoJSON for degrees' \
  cells --backend cpu --sites in/pair.csv --domain in/squares.geojson --by name -o out/p.geojsonl
[ "$(cut -d, -f1,2,5,7,8 out/p.csv | tr '\n' ' ')" = "name,site,area,share,site_share a,0,4,0.6666666666666666,1 a,1,2,0.3333333333333333,2 b,0,2,0.5,1 b,1,2,0.5,2 ,1,2,1,2 " ] ||
  fail "other pieces: $(cat out/p.csv)"
succeeds "an attribute that is named as a field" cells --backend cpu --sites in/pair.csv --domain in/squares.geojson --by area --quiet -o out/p.csv
[ "$(cut -d, -f1,2,5 out/p.csv | head -2 | tr '\n' ' ')" = "feature_area,site,area 7,0,4 " ] || fail "other pieces: $(cat out/p.csv)"
notes "pieces in degrees" "names no coordinate system" cells --backend cpu --check --sites in/three.csv --domain "$italy" --by name -o out/p.gpkg
succeeds "pieces of a projection" cells --backend cpu --check --sites in/three.csv --domain "$italy" --by name --project auto -o out/p.geojsonl -o out/p.csv
awk -F, 'NR > 1 { sum += $6; if ($5 != $6) exit 1 } END { exit !(sum > 300774 && sum < 300775) }' out/p.csv || fail "not the square kilometers of Italy: $(cat out/p.csv)"
refuses_pieces() { fails 2 "$1" "$2" cells --backend cpu --sites in/pair.csv "${@:3}"; }
refuses_pieces "an attribute that features do not have" '--by: in/squares.geojson: its features have no attribute "river"; they have "name", "area"' --domain in/squares.geojson --by river -o out/old.csv
refuses_pieces "features without attributes" "in/touch.wkt: its features have no attribute" --domain in/touch.wkt --by name -o out/old.csv
refuses_pieces "features of no file" "--by: is for features of a file" --domain 0,0,1,1 --by name -o out/old.csv
refuses_pieces "pieces as arrays" "--by: out/old.npz: pieces go to .csv, .geojson, .geojsonl, .gpkg" --domain in/squares.geojson --by name -o out/old.npz
refuses_pieces "edges of pieces" "--by: --edges is for cells" --domain in/squares.geojson --by name -o out/old.csv --edges out/old.geojson
refuses_pieces "a feature that crosses itself" '--domain: in/bow.geojson: "x": Self-intersection' --domain in/bow.geojson --by name -o out/old.csv
succeeds "pieces on standard output" cells --backend cpu --quiet --sites in/pair.csv --domain in/squares.geojson --by name -o - --format geojsonl
[ "$(wc -l <log/out)" = 5 ] || fail "not five pieces"

# -- Shapefiles, by GDAL's program ----------------------------------------------------------------------
mkdir tmp
export TMPDIR=$PWD/tmp
ogr2ogr -lco ENCODING=ISO-8859-1 in/basins.shp "$examples/catchments.geojson" 2>/dev/null
printf 'x,y,name\n591000,5724000,Köln\n604000,5716000,Aa\n' | ogr2ogr -a_srs EPSG:25832 -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -lco ENCODING=ISO-8859-1 in/gauges.shp CSV:/vsistdin/ 2>/dev/null
succeeds "a shapefile of catchments" cells --backend cpu --check --sites "$examples/rain.csv" --domain in/basins.shp --by name --quiet -o out/p.csv -o out/p.gpkg --stats out/s.json
pieces out/p.csv out/p.gpkg "$examples/rain.csv" "$examples/catchments.geojson" name
grep -q 'basins.dbf' out/s.json || fail "out/s.json does not have the files of the shapefile"
succeeds "a shapefile of gauges" cells --backend cpu --sites in/gauges.shp -o out/a.csv -o out/a.gpkg --quiet
in_system out/a.gpkg EPSG:25832
grep -q ',Köln$' out/a.csv || fail "the attributes are others: $(cat out/a.csv)"
head -1 out/a.csv | grep -q fid && fail "the number of a row has become an attribute"
printf 'no shapefile' >in/broken.shp
refuses "a file that is no shapefile" "--sites: in/broken.shp: ogr2ogr cannot read it: " --sites in/broken.shp
refuses "a shapefile of polygons" "in/basins.shp" --sites in/basins.shp
refuses "a shapefile of points as an outline" "in/gauges.shp" --sites random:9 --domain in/gauges.shp
refuses "a shapefile that is not there" "in/none.shp: cannot be read" --sites random:9 --domain in/none.shp
printf '#!/bin/sh\nPATH=/nowhere exec "%s" "$@"\n' "$vorpipe" >in/without_gdal
chmod +x in/without_gdal
with_gdal=$vorpipe
vorpipe=$PWD/in/without_gdal
refuses "a shapefile without GDAL" "in/gauges.shp: a shapefile is read by GDAL's ogr2ogr, which is not here: install gdal-bin" --sites in/gauges.shp
vorpipe=$with_gdal
[ -z "$(ls tmp)" ] || fail "something is left behind in the folder of temporary files"
unset TMPDIR

# -- Places of densities ------------------------------------------------------------------------------
printf '\223NUMPY\001\000\166\000%-117s\n\001\002\003\004\005\006\007\010' "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 4), }" >in/d.npy
mass() {
  awk -F '[:,]' -v low="$1" -v high="$2" '/"mass_sum"/ { seen = $2 > low && $2 < high } END { exit !seen }' out/s.json ||
    fail "mass_sum is not between $1 and $2: $(grep mass_sum out/s.json)"
}
notes "pixels that are stretched" "--density: in/d.npy: its 4 x 2 pixels are stretched over the domain, and come out 2 times as high as wide; --density-box" \
  $cells --sites random:50 --density in/d.npy
succeeds "pixels that are square" $cells --sites random:50 --domain 0,0,4,2 --density in/d.npy
mass 35.9999 36.0001
notes "a box that leaves a part empty" "its pixels lie in 2,0,6,2 and cover 50 % of the domain 0,0,4,2; it is 0 elsewhere" \
  $cells --sites random:50 --domain 0,0,4,2 --density in/d.npy --density-box 2,0,6,2
mass 13.9999 14.0001
succeeds "a box larger than the domain" $cells --sites random:50 --density in/d.npy --density-box=-1,-1,3,1
mass 1.9999 2.0001
printf '1\n0\n0\n-1\n0.5\n1.5\n' >in/d.wld
succeeds "a world file" $cells --sites random:50 --domain 1,0,3,2 --density in/d.npy
mass 17.9999 18.0001
succeeds "sites drawn where a world file says" relax --backend cpu --sites density:40 --density in/d.npy --iterations 2 -o out/drawn.csv
awk -F, 'NR > 1 && ($1 < 0 || $1 > 4 || $2 < 0 || $2 > 2) { exit 1 }' out/drawn.csv || fail "a site is elsewhere"
awk -F, 'NR > 1 && $1 > 1 { seen = 1 } END { exit !seen }' out/drawn.csv || fail "no site is where the density is"
succeeds "equal masses where a box says" transport --backend cpu --sites random:30 --domain 0,0,4,2 --density in/d.npy --density-box=-1,-1,5,3 -o out/t.csv --stats out/s.json
succeeds "relaxed where a box says" relax --backend cpu --sites random:30 --domain 0,0,4,2 --density in/d.npy --density-box=-1,-1,5,3 --iterations 3 -o out/t.csv
refuses_density() { fails 2 "$1" "$2" cells --backend cpu --sites random:9 -o out/old.csv "${@:3}"; }
refuses_density "a box of no density" "--density-box" --density-box 0,0,1,1
refuses_density "a box that is none" "--density-box: xmin 1 is not below" --density in/d.npy --density-box 1,0,1,1
refuses_density "a place that repeats itself" "--density: has a place of its own" --density in/d.npy --periodic x
for what in "cells -o out/t.csv" "relax -o out/t.csv" "transport -o out/t.csv"; do
  fails 2 "$what of pixels that lie elsewhere" \
    "--density: in/d.npy: its pixels lie in 10,10,14,12, and nothing of the domain 0,0,1,1 does" \
    $what --backend cpu --sites random:9 --density in/d.npy --density-box 10,10,14,12
done
printf '1\n0\n0\n' >in/d.wld
succeeds "a box in place of a world file" $cells --sites random:50 --domain 0,0,4,2 --density in/d.npy --density-box 0,0,4,2
mass 35.9999 36.0001
refuses_density "a world file that is none" "--density: in/d.wld: has 3 numbers" --density in/d.npy

# -- Pictures of maps: attributes, titles, legends beside, own colors --------------------------------
printf 'x,y,rain,kind,two,two\n0,0,1,a,,\n1,0,2.5,b,,\n0,1,,a,,\n' >in/rain.csv
printf '#003366\n\n  white\ntomato\n' >in/colors.txt
succeeds "colors by an attribute" render --backend cpu --sites in/rain.csv --color @rain --legend beside --title 'A b' --legend-title 'rain, mm' \
  --colormap in/colors.txt --labels @kind --size 200 -o out/rain.png -o out/rain.svg --stats out/rain.json --check
cp out/rain.svg in/before.svg
succeeds "again" rerun out/rain.json
cmp -s in/before.svg out/rain.svg || fail "the picture is another"
tr -d ' \n' <out/rain.json | grep -qF '"color":{"by":"@rain","scale":"linear","range":[1.0,2.5]}' || fail "the colors are not in the figures"
printf '#000000\nblack\n' >in/colors.txt
fails 2 "another file of colors" "in/colors.txt" rerun out/rain.json
printf '#003366\nnone\n' >in/colors.txt
refuses "a color that is none" '--colormap: in/colors.txt:2:1: "none"' --sites random:9 --color area --colormap in/colors.txt
printf '#003366\n#11223344\n' >in/colors.txt
refuses "a color that shows what is below" 'in/colors.txt:2:1: "#11223344" is not opaque' --sites random:9 --color area --colormap in/colors.txt
printf 'red\n' >in/colors.txt
refuses "one color" "in/colors.txt: has 1 colors, and takes two or more" --sites random:9 --color area --colormap in/colors.txt
refuses "no file of colors" "--colormap: in/none.txt" --sites random:9 --color area --colormap in/none.txt
refuses "a list with what is no color" '--colormap: "blau"' --sites random:9 --color area --colormap 'red,blau'
refuses "a map that is none" 'did you mean viridis?' --sites random:9 --color area --colormap viridi
refuses "a color that is none" '"blue" is not one of site, area, neighbors, weight, distinct; nor @NAME, an attribute, nor a photograph, .png or .jpg' --sites random:9 --color blue
refuses "a photograph of another kind" '"p.webp" is not one of site, area, neighbors, weight, distinct; nor @NAME, an attribute, nor a photograph' --sites random:9 --color p.webp
grep -q '<title>a, site 0, area ' in/before.svg || fail "no name over a cell"
notes "names without room" 'labels: 3 names have no room, and are left out' render --backend cpu --sites in/rain.csv --labels @kind --label-size 80 --size 100 -o out/rain.png
notes "names without room in shapes" 'labels: 3 names have no room, and are left out' render --backend cpu --sites in/rain.csv --labels @kind --label-size 80 --size 100 -o out/rain.svg
[ "$(grep -c 'no room' log/err)" = 1 ] || fail "not said once"
refuses "an attribute that is none" '--color: there is no attribute "snow"; known are rain, kind' --sites in/rain.csv --color @snow
refuses "a label that is none" '--labels: there is no attribute "snow"' --sites in/rain.csv --labels @snow
refuses "an attribute without values" '--color: no site has a value of "two"' --sites in/rain.csv --color @two
refuses "no attributes" '--color: there is no attribute "rain"; the sites have none' --sites random:9 --color @rain
refuses "texts along a scale" "--color-scale: the values of @kind are no numbers" --sites in/rain.csv --color @kind --color-scale log
refuses "texts in a range" "--color-range: the values of @kind are no numbers" --sites in/rain.csv --color @kind --color-range 1,2
refuses "a legend of distinct colors" "--legend: distinct colors stand for no values" --sites random:9 --color distinct --legend
refuses "too few distinct colors" "distinct colors: these cells take" --sites random:99 --color distinct --colormap red,blue
refuses "a place of a legend that is none" '--legend: "above" is neither inside nor beside' --sites random:9 --color area --legend above
refuses "a label that is no attribute" '--labels: "name" is not @NAME' --sites random:9 --labels name
refuses "a title of a legend that is not there" "--legend-title" --sites random:9 --color area --legend-title x
for option in "--title x" "--color @x" "--labels @x" "--colormap colors.txt"; do
  fails 2 "$option of a fluid" "${option% *}" fluid --backend cpu --case shear --particles 64 --steps 1 $option --frames out/f
done
fails 2 "a legend beside a fluid" "beside" fluid --backend cpu --case shear --particles 64 --steps 1 --legend beside --frames out/f
fails 2 "a title of frames" "--title: is for pictures" relax --backend cpu --sites random:9 --iterations 1 --title x --frames out/f
succeeds "labels of a relaxation" relax --backend cpu --sites in/rain.csv --iterations 2 --labels @kind --color @rain --title T --picture out/relaxed.svg
grep -q '>T</text>' out/relaxed.svg && grep -q '>b</text>' out/relaxed.svg || fail "the title or a label is missing"

# -- The whole Earth ------------------------------------------------------------------------------------
earth="cells --backend cpu --globe"
succeeds "the beacons of the Earth" $earth --check --sites "$navaids" --stats out/s.json -o out/s.csv -o out/s.npz \
  -o out/s.geojson -o out/s.gpkg -o out/s.svg --edges out/edges.geojson --triangulation out/network.gpkg
area 510065621.7240 510065621.7241
head -1 out/s.csv | grep -q '^site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors' || fail "other columns"
grep -q 'viewBox="0 0 1000 500"' out/s.svg || fail "the drawing is no map of degrees"
cp out/s.csv out/first.csv
succeeds "again" rerun --quiet out/s.json
cmp -s out/s.csv out/first.csv || fail "other cells"
for backend in vulkan-compute vulkan-geometry opengl; do
  [[ ,${VORPIPE_EXPECTED_BACKENDS-}, == *,$backend,* ]] || continue
  succeeds "the same by $backend" cells --backend $backend --globe --quiet --sites "$navaids" -o out/other.csv
  cmp -s out/first.csv out/other.csv || fail "other bytes"
done
printf 'name,lon,lat\nA,10,50\nB,190,-20\nC,-70,85\nD,100,-80\n' >in/four.csv
notes "names of neighbors" "are taken as x, y" $earth --sites in/four.csv --id @name --share -o out/four.csv
cut -d, -f11- out/four.csv | grep -q '^"B;.*,0\..*,A$' || fail "no names, share or attribute"
# Ends of edges are vertices, and lines are cut at 180 degrees.
succeeds "lines of few cells" $earth --quiet --sites in/four.csv --edges out/e.csv --edges out/e.geojson --edges out/e.vtp --edges out/e.wkt
[ "$(wc -l <out/e.csv)" -eq 7 ] || fail "not six edges"
grep -q MULTILINESTRING out/e.wkt && grep -q '"MultiLineString"' out/e.geojson || fail "no line is cut"
succeeds "a pattern" $earth --sites random:50000 --detail measures -o out/measures.npz --stats out/s.json
area 510065621.724 510065621.725
grep -q '"tiles"' out/s.json && fail "measures of the globe in tiles of a plane"
for option in "--project auto" "--domain hull"; do
  fails 2 "$option" "--globe: is without" $earth --sites in/three.csv $option -o out/old.csv
done
fails 2 "meters" "no place on the Earth" $earth --sites in/plane.csv -o out/old.csv
fails 2 "no place" "site 1" $earth --sites in/bad.csv -o out/old.csv
fails 2 "a heavy site" "below a quarter of the Earth, 10008 km" $earth --sites random:9 --random-weights 2e8,3e8 -o out/old.csv
fails 2 "FLANN" "--search: FLANN finds neighbors in a plane, not on the globe" $earth --sites random:9 --search flann -o out/old.csv
fails 2 "a free surface" "--surface" $earth --sites random:9 --random-weights 1,2 --surface free -o out/old.csv
fails 2 "a density" "--density" $earth --sites random:9 --density in/map.png -o out/old.csv

# Outlines on the globe: each run checks its cells, and the area is that of the outline on the ellipsoid.
globe() {
  name="$1 on the globe"
  cases=$((cases + 1))
  local low=$2 high=$3
  shift 3
  run 0 $cells --globe --quiet "$@"
  area "$low" "$high"
}
globe "a box across 180 degrees" 2473440 2473460 --sites random:300 --domain 170,50,190,70
globe "the cap of a pole" 34415810 34415820 --sites random:300 --domain -180,-90,180,-60
globe "a belt around a pole" 30507250 30507270 --sites random:300 --domain -180,-80,180,-60
globe "a box that no site is in" 12253 12254 --sites random:9 --domain 10,5,11,6
globe "Italy" 300000 303000 --sites "$navaids" --domain "$italy"
globe "weights in a box" 12253 12254 --sites random:300 --random-weights 0,1e6 --domain 10,5,11,6
printf '{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"east"},"geometry":{"type":"Polygon","coordinates":[[[178,-20],[180,-20],[180,-15],[178,-15],[178,-20]]]}},
{"type":"Feature","properties":{"name":"west"},"geometry":{"type":"Polygon","coordinates":[[[-180,-20],[-179,-20],[-179,-15],[-180,-15],[-180,-20]]]}},
{"type":"Feature","properties":{"name":"far"},"geometry":{"type":"Polygon","coordinates":[[[0,10],[2,10],[2,12],[0,12],[0,10]]]}}]}' >in/fiji.geojson
globe "what a file cuts at 180 degrees" 224600 224603 --sites random:3000 --domain in/fiji.geojson
succeeds "parts by name on the globe" cells --backend cpu --globe --check --quiet --sites random:3000 --domain in/fiji.geojson --by name -o out/parts.csv
awk -F, 'NR > 1 { share[$1] += $NF } END { for (name in share) if (share[name] < 0.999999 || share[name] > 1.000001) exit 1; exit length(share) != 3 }' out/parts.csv ||
  fail "the shares of a part do not add up to 1"
fails 2 "a box of the whole Earth" "it is the whole Earth" cells --globe --sites random:9 --domain -180,-90,180,90 -o out/s.csv
fails 2 "an outline around the Earth" "on the globe a polygon reaches at most 88" cells --globe --sites random:9 --domain -180,-90,180,0 -o out/s.csv
fails 2 "a margin on the globe" "--globe: is without --margin" cells --globe --sites "$navaids" --margin 1 -o out/s.csv
fails 2 "a system of a plane on the globe" "not degrees" cells --globe --sites random:9 --crs EPSG:25832 -o out/s.csv

finish
