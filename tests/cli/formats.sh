#!/usr/bin/env bash
# Files with sites as people have them: each kind gives the same cells, what is reinterpreted is said in one line, and
# what GDAL writes is read. Usage: formats.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# says NAME TEXT ARGUMENT...: cells with these options succeed, and say one line on standard error, which has TEXT.
says() {
  local text=$2
  name=$1
  shift 2
  cases=$((cases + 1))
  run 0 cells --backend cpu "$@"
  one_line
  grep -qF -- "vorpipe: note: $text" log/err || fail "the line does not say '$text'"
}
# same NAME: the cells in out/other.csv are those in out/first.csv.
same() { cmp -s <(cut -d, -f1-11 out/first.csv) <(cut -d, -f1-11 out/other.csv) || fail "other cells"; }

# -- The same sites in every kind ---------------------------------------------------------------------------
printf 'x,y,name\n1,2.5,Aachen\n4,1,Bonn\n3,5,Köln\n' >in/a.csv
printf 'x;y;name\n1;2,5;Aachen\n4;1;Bonn\n3;5;Köln\n' >in/b.csv
printf 'name\ty\tx\nAachen\t2.5\t1\nBonn\t1\t4\nKöln\t5\t3\n' >in/c.tsv
printf '# a note\n1 2.5\n4 1\n3 5\n' >in/d.xyz
printf 'POINT (1 2.5)\nMULTIPOINT (4 1, 3 5)\n' >in/e.wkt
feature() { printf '{"type":"Feature","properties":{"name":"%s"},"geometry":{"type":"Point","coordinates":[%s]}}' "$1" "$2"; }
crs='"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3857"}}'
{
  printf '{"type":"FeatureCollection",%s,"features":[' "$crs"
  feature Aachen 1,2.5 && printf ',' && feature Bonn 4,1 && printf ',' && feature Köln 3,5 && printf ']}'
} >in/f.geojson
gzip -k in/a.csv in/f.geojson
succeeds "a table" cells --backend cpu --sites in/a.csv -o out/first.csv
for file in b.csv c.tsv d.xyz e.wkt f.geojson a.csv.gz f.geojson.gz; do
  succeeds "$file" cells --backend cpu --sites "in/$file" -o out/other.csv
  same
done
name="from standard input" cases=$((cases + 1))
"$vorpipe" cells --backend cpu --sites - --format geojson -o out/other.csv <in/f.geojson.gz >log/out 2>log/err || fail "exit code $?"
same
[ -s log/err ] && fail "something on standard error"

# -- What is reinterpreted is said ----------------------------------------------------------------------------
for header in Radius r Weight w; do
  printf 'x,y,%s\n0,0,1\n1,1,1\n' $header >in/w.csv
  says "a column $header" "in/w.csv: \"$header\" is taken as" --sites in/w.csv -o out/w.csv
done
printf '0 0 100\n1 1 200\n2 0 300\n' >in/points.xyz
third="the third column is taken as weights; --columns 1,2 leaves it out"
name="heights"
cases=$((cases + 1))
run 0 cells --backend cpu --sites in/points.xyz -o out/w.csv
grep -qxF "vorpipe: note: in/points.xyz: $third" log/err || fail "what they are taken for"
grep -qxF "vorpipe: note: 2 of 3 sites have no cell: others of larger weight hide them" log/err || fail "what came of it"
succeeds "heights left out" cells --backend cpu --sites in/points.xyz --columns 1,2 -o out/w.csv
expect "3 unweighted cells (0 empty"
succeeds "quiet" cells --backend cpu --quiet --sites in/points.xyz -o out/w.csv
printf '1,2\n3,4\n' >in/n.csv
says "no header" "in/n.csv: there is no header: columns 1 and 2 are taken as x and y" --sites in/n.csv -o out/w.csv
says "columns not used" "in/a.csv: not used: name" --sites in/a.csv -o out/w.npz
printf 'x,y\n-120,50\n130,-40\n' >in/world.csv
says "degrees" "in/world.csv: coordinates look like degrees" --sites in/world.csv -o out/w.csv
printf 'x,y\n1,2\n,3\n4,5\n' >in/m.csv
says "missing rows" "in/m.csv: 1 row without a place or a weight is left out" --sites in/m.csv --missing skip -o out/w.csv
fails 2 "missing fields" "--sites: in/m.csv:3:1: empty field; --missing skip leaves such rows out (column x)" cells --backend cpu --sites in/m.csv -o out/old.csv

# -- What cannot be -------------------------------------------------------------------------------------------
refuses "columns" '--columns: "x,,y"' --sites in/a.csv --columns x,,y
refuses "a column that is not there" 'in/a.csv:1:1: the header "x,y,name" names no column "lon"' --sites in/a.csv --columns lon,y
refuses "missing" '--missing: "drop" is not skip' --sites in/a.csv --missing drop
refuses "a format" '--format: "a b"' --sites in/a.csv --format "a b"
refuses "a layer of a table" "in/a.csv: has no layers" --sites in/a.csv --layer a
refuses "an unknown kind of standard input" "<stdin>: unknown kind of file" --sites - --format docx
refuses "a GeoPackage by standard input" "<stdin>: a GeoPackage cannot be read" --sites - --format gpkg
head -c 60 in/a.csv.gz >in/cut.csv.gz
refuses "truncated gzip" "in/cut.csv.gz: is truncated: its gzip data end too early" --sites in/cut.csv.gz
printf '[%.0s' $(seq 100000) >in/deep.geojson
refuses "deep JSON" "in/deep.geojson:1:201: stands in more than 200 lists" --sites in/deep.geojson

# -- What GDAL writes -----------------------------------------------------------------------------------------
if command -v ogr2ogr >/dev/null; then
  # GeoJSONSeq is always in degrees, and GDAL would make them.
  for kind in "GeoJSON geojson" "GeoJSONSeq geojsonl -a_srs EPSG:4326" "GPKG gpkg" "CSV csv -lco GEOMETRY=AS_WKT"; do
    # shellcheck disable=SC2086
    set -- $kind
    ogr2ogr -f "$1" "in/gdal.$2" in/f.geojson "${@:3}" 2>log/ogr || fail "ogr2ogr: $(cat log/ogr)"
    name="GDAL's $1" cases=$((cases + 1))
    run 0 cells --backend cpu --sites "in/gdal.$2" -o out/other.csv -o out/other.geojson
    same
  done
else
  skipped "what GDAL writes" "there is no ogr2ogr"
fi

finish
