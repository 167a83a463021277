#!/usr/bin/env bash
# Files that are made to crash, to hang or to take memory: exit code 2 and a place, or right results; within the time
# and the memory that their size explains. Usage: hostile.sh VORPIPE [MEGABYTES], of the longest lines.
here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/harness.sh"
if ! has_numpy; then
  skipped "hostile files" "there is no numpy"
  exit 77
fi
megabytes=${2:-64}
"$python" "$here/hostile.py" in "$megabytes" || exit 1

# within KILOBYTES ARGUMENT...: runs vorpipe; it must end within a minute, and take no more memory at its peak.
within() {
  local most=$1
  shift
  timeout 60 "$python" -c '
import os, resource, sys
child = os.spawnv(os.P_WAIT, sys.argv[1], sys.argv[1:])
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=open("log/peak", "w"))
sys.exit(child if child >= 0 else 128 - child)' "$vorpipe" "$@" >log/out 2>log/err </dev/null
  code=$?
  peak=$(cat log/peak 2>/dev/null || echo 0)
  [ "$peak" -le "$most" ] || fail "took $peak KB of memory, not $most: vorpipe $*"
}

# bad FILE TEXT [KILOBYTES or domain]: as sites, it is refused; the line begins with the file, or is about the
# domain, and has TEXT.
bad() {
  name=$1
  cases=$((cases + 1))
  local most=${3:-150000}
  within "${most/domain/150000}" cells --backend cpu --sites "in/$1" -o out/cells.csv
  [ "$code" -eq 2 ] || fail "exit code $code, not 2"
  one_line
  [ "$(wc -c <log/err)" -le 1000 ] || fail "a line of $(wc -c <log/err) bytes"
  [ "${3-}" = domain ] || grep -qF -- "vorpipe: --sites: in/$1" log/err || fail "the line does not begin with the file"
  grep -qF -- "$2" log/err || fail "the line does not say '$2'"
  [ -z "$(ls out)" ] || fail "something was written"
}

# bad_as OPTION FILE TEXT [KILOBYTES]: the same for other files than sites.
bad_as() {
  name="$1 $2"
  cases=$((cases + 1))
  within "${4:-150000}" cells --backend cpu --sites random:9 "$1" "in/$2" -o out/cells.csv
  [ "$code" -eq 2 ] || fail "exit code $code, not 2"
  one_line
  grep -qF -- "in/$2" log/err || fail "the line does not name the file"
  grep -qF -- "$3" log/err || fail "the line does not say '$3'"
}

# good FILE LINES [KILOBYTES]: cells of as many sites.
good() {
  name=$1
  cases=$((cases + 1))
  within "${3:-150000}" cells --quiet --backend cpu --check --sites "in/$1" -o out/cells.csv
  [ "$code" -eq 0 ] || fail "exit code $code, not 0"
  [ "$(wc -l <out/cells.csv)" -eq $(($2 + 1)) ] || fail "$(wc -l <out/cells.csv) lines"
  rm -f out/cells.csv
}

# -- Noise under every name; text in other encodings, with other numbers ----------------------------------
for kind in csv tsv txt npy geojson geojsonl wkt gpkg csv.gz; do bad "noise.$kind" "in/noise.$kind"; done
for number in 1e999 hex inf nan digits nul; do bad "$number.csv" ":3:3: "; done
bad thousands.csv '1,234.5'
bad blanks.csv ':2:1: "1 234.5" is not a number'
bad utf16.csv ":1:1: the text is UTF-16"
bad far.csv "the sites reach too far for a default" domain
bad subnormal.csv "areas need one whose own lies between" domain
good latin1.csv 3
good cr.csv 3
good tiny.csv 3
good duplicates.csv 1000000 700000
good columns.csv 3

# -- Lines without an end, in a file and packed a thousand to one -----------------------------------------
for kind in csv txt geojsonl; do
  bad "line.$kind" "the line is longer than 1048576 bytes"
  bad "packed.$kind.gz" "the line is longer than 1048576 bytes"
  bad "zeros.$kind" "the line is longer than 1048576 bytes"
done
bad line.wkt "a word is longer than 1048576 bytes"
bad packed.wkt.gz "a word is longer than 1048576 bytes"
bad zeros.wkt "a word is longer than 1048576 bytes"
# One string of JSON is kept while it is read: up to some times its text.
bad line.geojson "no JSON" $((150000 + 9 * megabytes * 1024))
bad packed.geojson.gz "no JSON" $((150000 + 9 * megabytes * 1024))
bad zeros.geojson ":1:7: is no JSON from here on"

# -- JSON that is deep, wide, or built so that a parser compares much --------------------------------------
bad deep.geojson ":1:201: stands in more than 200 lists and objects"
bad deep.geojsonl ":1:201: stands in more than 200 lists and objects"
bad deep_property.geojson "stands in more than 200 lists and objects"
bad deep_geometry.geojson "stands in more than 200 lists and objects"
bad members.geojson "an object has more than 2000 members"
bad attributes.geojson "features have more than 2000 different properties"
bad 1e999.geojson ":1:32: the number is too large for a double"
good siblings.geojson 1 400000
bad surrogate.geojson "is no JSON from here on"
for kind in deep members; do bad_as --domain "$kind.geojson" "more than 200"; done
bad_as --domain line.wkt '"POINT", where POLYGON or MULTIPOLYGON is needed'
bad_as --domain noise.wkt ""
name="a ring that crosses itself in a million places"
cases=$((cases + 1))
within 150000 cells --backend cpu --sites random:9 --domain in/tangle.wkt -o out/cells.csv
[ "$code" -eq 2 ] || fail "exit code $code, not 2"
one_line
grep -qF -- "; --repair may mend it" log/err || fail "the line does not say what may help"

# -- Arrays with headers that lie ----------------------------------------------------------------------------
bad more.npy "is truncated: it holds 288 bytes"
bad less.npy "is too long"
bad huge.npy "claims an impossible size"
bad wrapped.npy "claims an impossible size"
bad negative.npy "is not understood"
bad object.npy "numbers are needed"
bad structured.npy "is not understood"
bad axes.npy "claims 20000 axes; 32 are the most"
bad header.npy "claims 4294967295 bytes"
bad nan.npy "element [1, 0]"
bad more.npy.gz ""
good fortran.npy 3
bad_as --density packed.npy "what is packed in it cannot hold float64 (1048576, 1048576)"
bad_as --density picture.png "cannot hold 65535 x 65535 pixels"
bad_as --weights more.npy "is truncated"
# bad_checkpoint FILE TEXT: the same for what a fluid goes on from.
bad_checkpoint() {
  name=$1
  cases=$((cases + 1))
  within 150000 fluid --backend cpu --resume "in/$1" --time 1 -o out/cells.csv
  [ "$code" -eq 2 ] || fail "exit code $code, not 2"
  one_line
  grep -qF -- "vorpipe: in/$1: $2" log/err || fail "the line does not say '$2'"
}
bad_checkpoint shape.npz '"sites" is no array that is understood'
bad_checkpoint columns.npz "sites is float64 (9, 3), not numbers (N, 2)"
bad_checkpoint other.npz 'a fluid has no array "velocities"; did you mean velocity?'
bad_checkpoint bit.npz '"domain.npy" is damaged: its checksum is another'
bad_checkpoint cut.npz "it is no whole .npz file"
bad_checkpoint deflated.npz '"sites" is no array that is understood'
bad_checkpoint noise.npz "it is no whole .npz file"
bad_checkpoint time.npz "time is not finite"
bad_checkpoint length.npz "step: it is not 0 or more"
bad_checkpoint gravity.npz "gravity has 3 numbers, not 2"
bad_checkpoint box.npz "the domain 0,0,0,0 is not a rectangle"
bad_checkpoint tolerance.npz "tolerance: inf is not"

# -- Pictures that claim more than they hold -----------------------------------------------------------------
for file in bomb bomb16 interlaced; do bad_as --density $file.png "cannot hold 65535 x 65535 pixels"; done
bad_as --density short.png "is a damaged PNG"
bad_as --density noise.png "is not a PNG file"
bad_as --density bomb.jpg "cannot hold 65500 x 65500 pixels"
bad_as --density bomb_progressive.jpg "cannot hold 20000 x 20000 pixels"
bad_as --density short.jpg "is a damaged JPEG"
bad_as --density noise.jpg "is not a JPEG file"
# text.png: text is passed over; flat.jpg: as many pixels as its bytes hold at best.
for file in text.png flat.jpg; do
  name=$file
  cases=$((cases + 1))
  within 60000 cells --quiet --backend cpu --sites random:9 --density in/$file -o out/cells.csv
  [ "$code" -eq 0 ] || fail "exit code $code, not 0"
  rm -f out/cells.csv
done

# -- Databases -----------------------------------------------------------------------------------------------
bad cut.gpkg "cannot be read"
bad page.gpkg "cannot be read"
bad endless.gpkg "is recursive, and may never end"
bad join.gpkg "more memory than a file of its size has" 250000
bad views.gpkg "too many references" 400000
bad blob.gpkg "calls zeroblob"
good triggers.gpkg 500
good wal.gpkg 500

# -- What is no file -----------------------------------------------------------------------------------------
for kind in csv txt npy geojson geojsonl wkt; do
  ln -s /dev/zero "in/endless.$kind"
  bad "endless.$kind" "in/endless.$kind"
done
for option in --domain:wkt --domain:geojson --density:npy --weights:txt; do
  ln -sf /dev/zero "in/device.${option#*:}"
  bad_as "${option%:*}" "device.${option#*:}" ""
done
ln -sf /dev/zero in/device.npz
name="a checkpoint without an end"
cases=$((cases + 1))
within 150000 fluid --backend cpu --resume in/device.npz --until 1 -o out/cells.csv
[ "$code" -eq 2 ] || fail "exit code $code, not 2"
# The window may not be built.
if "$vorpipe" --help | grep -q '^ *view '; then
  name="a script without an end"
  cases=$((cases + 1))
  within 150000 view --script /dev/zero
  [ "$code" -eq 2 ] || fail "exit code $code, not 2"
  one_line
  grep -qF -- "--script: /dev/zero: is larger than 16 MiB" log/err || fail "the line does not say that it is too large"
fi

name="a file that is cut off while it is mapped"
cases=$((cases + 1))
echo old >out/cells.npz
"$python" -c '
import os, subprocess, sys
import numpy
numpy.save("in/cut_off.npy", numpy.random.default_rng(1).random((2_000_000, 2)))
run = subprocess.Popen([sys.argv[1], "cells", "--quiet", "--backend", "cpu", "--threads", "8", "--sites", "in/cut_off.npy",
                        "--detail", "measures", "-o", "out/cells.npz"])
while run.poll() is None:
    with open(f"/proc/{run.pid}/maps") as maps:
        if "cut_off.npy" in maps.read():
            os.truncate("in/cut_off.npy", 4096)
            break
sys.exit(run.wait())' "$vorpipe" >log/out 2>log/err
code=$?
[ "$code" -eq 2 ] || fail "exit code $code, not 2"
one_line
grep -qF -- "--sites: a part of the file is gone" log/err || fail "the line does not say that the file was cut off"
[ "$(ls out)" = cells.npz ] && [ "$(cat out/cells.npz)" = old ] || fail "the old file is not as it was, or not alone"
rm -f out/cells.npz

mkdir in/folder.csv in/folder.gpkg
bad folder.csv "is a directory"
bad folder.gpkg "is a directory"
mkfifo in/pipe.csv
printf 'x,y\n0,0\n1,1\n2,0\n' >in/pipe.csv &
good pipe.csv 3
mkfifo in/pipe.npy
{ head -c 128 in/more.npy; head -c 160 /dev/zero; } >in/pipe.npy &
bad pipe.npy ""

finish
