#!/usr/bin/env bash
# What is refused: exit codes, one line per error, files whole or untouched.
# Usage: errors.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# -- Bad command lines ----------------------------------------------------------------------------------
fails 2 "no subcommand" "subcommand"
fails 2 "unknown subcommand" "paint" paint
fails 2 "unknown option" "--nope" render --sites random:9 -o out/old.png --nope
# what is typed|what is said: the first that is not known, and what may have been meant
while IFS='|' read -r typed text; do
  fails 2 "'$typed'" "vorpipe: $text" $typed
  grep -qxF -- "vorpipe: $text" log/err || fail "the line is not '$text'"
done <<'END'
rende|unknown subcommand "rende"; did you mean render?
dif a.npy b.npy|unknown subcommand "dif"; did you mean diff?
paint|unknown subcommand "paint"; see vorpipe --help
--vesion|unknown option --vesion; did you mean --version?
--backend cpu render|unknown option --backend; see vorpipe --help
render --colour site --nope|unknown option --colour; did you mean --color?
render --nope --colour site|unknown option --nope; see vorpipe render --help
render --zebra --aardvark --nope|unknown option --zebra; see vorpipe render --help
render --sites random:9 --mem=8GB --size nonsense|unknown option --mem; did you mean --memory-limit?
cells --Sites random:9|unknown option --Sites; did you mean --sites?
cells --sites random:9 --domain -1,-1,1,1 --wieghts w.txt|unknown option --wieghts; did you mean --weights?
cells -s random:9|unknown option -s; see vorpipe cells --help
diff a.npy b.npy c.npy --wat|unknown option --wat; see vorpipe diff --help
END
refuses "a color that was meant" '"aera" is not one of site, area, neighbors, weight, distinct; did you mean area?' --sites random:9 --color aera
refuses "a backend that was meant" 'did you mean vulkan-compute?' --sites random:9 --backend vulkan-comp
refuses "a colormap that was meant" 'did you mean viridis?' --sites random:9 --colormap Virids
fails 2 "an option twice" "--size: is given 2 times; once is enough" render --sites random:9 --size 4 --size=5 -o out/old.png
fails 2 "sites of other subcommands" "density:N is for relax and transport" cells --sites density:9 -o out/old.csv
fails 2 "memory of some bytes" "1000 bytes are allowed by --memory-limit; without any site it needs " \
  cells --backend cpu --sites random:9 --memory-limit 1KB -o out/old.csv
fails 2 "no sites" "--sites" render -o out/old.png
fails 2 "nothing to write" "-o" render --sites random:9 --backend cpu
refuses "no value" "--size" --sites random:9 --size
for size in 0x10 10x0 -1x5 1000000x1000000 32769x1 10x x10 10x10x10 1.5x2 ax2 "" 99999999999999999999x1; do
  refuses "size '$size'" "--size" --sites random:9 --size "$size"
done
for domain in land.shp 1,0,0,1 0,1,1,0 0,0,0,1 0,0,1 0,0,1,1,1 0,0,1,nan 0,0,inf,1 0,0,1e999,1 a,0,1,1 -1e308,0,1e308,1; do
  refuses "domain $domain" "--domain" --sites random:9 --domain "$domain"
done
fails 2 "backend" '--backend: "nope" is not one of auto, vulkan' render --sites random:9 --backend nope -o out/old.png
for threads in 0 -1 1025 x; do refuses "threads $threads" "--threads" --sites random:9 --threads "$threads"; done
for search in flann:2 flann:1025 flann: flann:x trees grid:3 Grid ""; do
  refuses "search $search" "--search" --sites random:9 --search "$search"
done
for seed in -1 x 18446744073709551616; do refuses "seed $seed" "--seed" --sites random:9 --seed "$seed"; done
for limit in maxTexelBufferElements maxTexelBufferElements=x =5; do
  refuses "limit $limit" "--limit" --sites random:9 --limit "$limit"
done
refuses "unknown limit" '--limit: "maxNope" is not one of maxTexelBufferElements' --sites random:9 --limit maxNope=5
refuses "unknown feature" '--disable: "nopeShader" is not one of geometryShader' --sites random:9 --disable nopeShader
fails 2 "unknown feature of devices" '--disable: "nopeShader"' devices --disable nopeShader
fails 2 "unknown limit of devices" '--limit: "maxNope"' devices --limit maxNope=5
refuses "color" "--color" --sites random:9 --color blue
refuses "colormap" "viridis" --sites random:9 --colormap nope
refuses "color by weight without weights" "--color: weight needs weights; random:9 has none" --sites random:9 --color weight
gigabytes=$(($(getconf _PHYS_PAGES) * $(getconf PAGE_SIZE) / 1000000000))
if [ "$gigabytes" -lt 150 ]; then
  refuses "more sites than memory" "--sites: needs about" --sites random:2147483647
  fails 2 "more cells than memory" "--sites: needs about" cells --backend cpu --sites random:2147483647 -o out/old.csv
  for options in "" "--density d.npy" "--random-weights 0,1" "--weights w.txt" "--domain o.wkt" "--periodic xy"; do
    fails 2 "too many cells: $options" "sites would fit" cells --backend cpu --sites random:2147483647 --stats out/old.json $options
  done
  for options in "--random-weights 0,1" "--domain o.wkt"; do
    refuses "too many sites for pictures: $options" "sites would fit" --sites random:2147483647 $options
  done
else
  skipped "more sites than memory" "there are $gigabytes GB of memory"
fi
refuses "more sites than indices" "--sites: random:2147483648" --sites random:2147483648
fails 2 "an option where a file belongs" "-o" render --backend cpu --sites random:9 -o --quiet
fails 2 "the same for --stats" "--stats" render --backend cpu --sites random:9 --stats --quiet
refuses "an option given twice" "--size" --sites random:9 --size 9x9 --size 8x8
refuses "quiet and verbose" "--quiet" --sites random:9 --quiet --verbose
for sites in random:0 random:-5 random:x random: random random:99999999999; do
  refuses "sites $sites" "--sites" --sites "$sites"
done
fails 2 "one file for two outputs" "out/old.npy" render --backend cpu --sites random:9 --ids out/old.npy --stats out/../out/old.npy
fails 2 "a picture that is no .png" "-o" render --backend cpu --sites random:9 -o out/old.json

# -- Outputs over inputs --------------------------------------------------------------------------------
mkdir in/own
printf 'x,y\n0,0\n1,1\n' >in/own/s.csv
printf 'x,y,n\n0,0,1\n1,1,2\n' >in/own/m.csv
ln in/own/s.csv in/own/hard.csv
ln -s s.csv in/own/link.csv
printf '1\n2\n' >in/own/w.csv
printf '{"type":"Polygon","coordinates":[[[-1,-1],[2,-1],[2,2],[-1,2],[-1,-1]]]}' >in/own/land.geojson
succeeds "a picture for a density" render --backend cpu --sites random:9 --size 9x9 -o in/own/d.png
succeeds "ids" render --backend cpu --sites random:9 --size 9x9 --ids in/own/i.npy
succeeds "a fluid" fluid --backend cpu --case shear --particles 64 --steps 1 --checkpoint in/own/f.npz
ln in/own/f.npz in/own/f.csv
before=$(cksum in/own/*)
while read -r options; do
  fails 2 "$options" "is an input of this run" $options
done <<'END'
cells --backend cpu --sites in/own/s.csv -o in/own/s.csv
cells --backend cpu --sites in/own/s.csv -o out/old.csv -o in/own/../own/hard.csv
cells --backend cpu --sites in/own/link.csv -o in/own/s.csv
cells --backend cpu --sites in/own/s.csv -o in/own/link.csv
cells --backend cpu --sites in/own/s.csv --weights in/own/w.csv -o in/own/w.csv
cells --backend cpu --quiet --sites in/own/s.csv --domain in/own/land.geojson -o in/own/land.geojson
render --backend cpu --quiet --sites in/own/s.csv --domain in/own/land.geojson -o in/own/d.png --stats in/own/land.geojson
relax --backend cpu --sites in/own/s.csv -o in/own/s.csv
fluid --backend cpu --case in/own/f.npz --steps 1 --checkpoint in/own/f.npz
relax --backend cpu --sites random:9 --density in/own/d.png --picture in/own/d.png
transport --backend cpu --sites in/own/s.csv --masses in/own/w.csv --normalize --save-weights in/own/w.csv
transport --backend cpu --sites in/own/m.csv --masses @n --normalize --trace in/own/../own/m.csv
compare --backends cpu,vulkan-compute --sites in/own/s.csv --report in/own/s.csv
fluid --backend cpu --resume in/own/f.npz --steps 1 -o in/own/f.csv
diff in/own/d.png in/own/d.png -o in/own/d.png
view --sites in/own/s.csv --density in/own/d.png --screenshot in/own/d.png
END
grep -q "in/own/d.png: is an input of this run, and would be replaced; name another file" log/err || fail "it does not say what to do"
name="standard input"
"$vorpipe" cells --backend cpu --sites - -o in/own/s.csv <in/own/s.csv >log/out 2>log/err && fail "exit code 0"
grep -q "is an input of this run, read as -, and would be replaced" log/err || fail "standard input is replaced"
[ "$before" = "$(cksum in/own/*)" ] || fail "an input changed"
succeeds "a checkpoint goes on in its file" fluid --backend cpu --resume in/own/f.npz --steps 1 --checkpoint in/own/f.npz
rm -r in/own

# -- Bad files ------------------------------------------------------------------------------------------
for number in nan inf 1e999 text ""; do
  printf 'x,y\n0,0\n1,%s\n' "$number" >"in/value.csv"
  refuses_file value.csv "in/value.csv:3:"
done
printf 'x,y\n0,0\n1\n' >in/columns.csv
refuses_file columns.csv "in/columns.csv:3:"
printf 'a,b\n1,1\n' >in/header.csv
refuses_file header.csv "in/header.csv:1"
: >in/empty.csv
: >in/empty.npy
: >in/empty.xyz
printf 'x,y\n' >in/rows.csv
printf '0 0\n1 nan\n' >in/value.xyz
"$vorpipe" render --backend cpu --sites random:300 --size 90x60 --fit stretch --ids in/whole.npy >log/out 2>log/err || fail "exit code $?"
head -c 1000 in/whole.npy >in/truncated.npy
printf 'not an array at all' >in/text.npy
printf 'x,y\n0,0\n' >in/kind.doc
mkdir in/folder in/folder.csv
for file in empty.csv empty.npy empty.xyz rows.csv truncated.npy text.npy kind.doc folder folder.csv missing.csv; do
  refuses_file "$file" "in/$file"
done
refuses_file value.xyz "in/value.xyz:2:"

# Sites that can be read, and have no cells; the backend is not asked, so that it need not be there.
unusable() {
  fails 2 "$1, drawn" "$2" render --backend opengl --device 77 --sites in/unusable.csv "${@:3}" -o out/old.png
  fails 2 "$1, as cells" "$2" cells --backend opengl --device 77 --sites in/unusable.csv "${@:3}" -o out/old.csv
  fails 2 "$1, compared" "$2" compare --backends cpu,opengl --device 77 --sites in/unusable.csv "${@:3}" --report out/old.json
}
printf 'x,y\n0.5,0.5\n0,1e300\n' >in/unusable.csv
unusable "a site too far away" "--sites: site 1 is too far from the domain: 0, 1e+300" --domain 0,0,1,1
unusable "a site too far away, periodic" "--sites: site 1 is too far from the domain: 0, 1e+300" --domain 0,0,1,1 --periodic x
unusable "a site too far to be wrapped" "--sites: site 1 is too far from the domain" --domain 0,0,1,1 --periodic y
printf 'x,y,weight\n0.5,0.5,1\n0,1,1e300\n' >in/unusable.csv
unusable "a weight too large" "--sites: the weight of site 1 is too large for the domain: 1e+300" --domain 0,0,1,1
unusable "a weight too large, periodic" "--sites: the weight of site 1" --domain 0,0,1,1 --periodic xy
unusable "weights and FLANN" "--search: of sites with weights" --search flann
printf 'x,y\n0.5,0.5\n0,1\n' >in/unusable.csv
printf '1\n1e300\n' >in/heavy.txt
unusable "a weight of a file too large" "--weights: the weight of site 1" --domain 0,0,1,1 --weights in/heavy.txt
refuses "random weights too large" "--random-weights: the weight of site 0" --sites random:9 --random-weights 0,1e300
printf 'POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))' >in/crossing.wkt
unusable "an outline that crosses itself" "--domain: in/crossing.wkt: Self-intersection at (0.5, 0.5)" --domain in/crossing.wkt
for size in 1e-200 1e200 1e308; do
  printf 'POLYGON ((-%s 0, %s 0, %s %s, -%s 0))' $size $size $size $size $size >in/size.wkt
  unusable "an outline of size $size" "has no area that a double can hold" --domain in/size.wkt
  grep -q -- '--domain: in/size.wkt: its box' log/err || fail "the line does not name --domain"
done
printf 'x,y\n0.2,0\n0.2,1e-26\n' >in/near.csv
near="sites 0 and 1: 0.2, 0 and 0.2, 1e-26 are not equal"
for periodic in "" "--periodic x"; do
  refuses "sites too near '$periodic'" "--sites: $near" --sites in/near.csv --domain 0,0,1,1 $periodic
  fails 2 "cells of sites too near '$periodic'" "--sites: $near" cells --backend cpu --sites in/near.csv --domain 0,0,1,1 $periodic -o out/old.csv
done

# -- Outputs that cannot be written ---------------------------------------------------------------------
fails 2 "no such folder" "out/none/a.png" render --backend cpu --sites random:9 -o out/none/a.png
fails 2 "a folder as output" "in/folder" render --backend cpu --sites random:9 -o in/folder
fails 2 "the second output cannot be written" "out/none/a.npy" render --backend cpu --sites random:9 -o out/old.png --ids out/none/a.npy
if [ -w /dev/full ]; then
  fails 3 "a full disk" "/dev/full" render --backend cpu --sites random:9 -o out/old.png --stats /dev/full
  name="standard output is full"
  cases=$((cases + 1))
  "$vorpipe" devices --json >/dev/full 2>log/err && fail "exit code 0"
  one_line
  name="help, while standard output is full"
  cases=$((cases + 1))
  "$vorpipe" --version >/dev/full 2>log/err && fail "exit code 0"
  one_line
else
  skipped "a full disk" "there is no /dev/full"
fi

# A stream that is closed has a number that the first file would get.
name="streams that are closed"
cases=$((cases + 1))
"$vorpipe" render --backend cpu --sites random:9 --size 90x40 -o out/closed.png 0<&- 2>&- >log/out || fail "it fails"
head -c 4 out/closed.png | grep -q PNG || fail "a note is in the picture"
"$vorpipe" cells --backend cpu --sites random:9 -o out/closed.csv >&- 2>log/err && fail "exit code 0"
one_line
head -n 1 out/closed.csv | grep -q '^site,' || fail "the summary is in the cells"

# As another user: root has as many processes as it likes.
if [ "$(id -u)" = 0 ] && command -v setpriv prlimit >/dev/null; then
  name="no more threads"
  cases=$((cases + 1))
  chmod 755 . && mkdir -p out/another && chmod 777 out/another
  prlimit --nproc=3 setpriv --reuid=65533 --clear-groups -- "$vorpipe" cells --sites random:20000 --backend cpu --threads 4 \
    -o out/another/a.csv >log/out 2>log/err
  code=$?
  case $code in
    0) [ "$(wc -l <out/another/a.csv)" = 20001 ] || fail "not all cells are there" ;;
    3) one_line && [ -z "$(ls -A out/another)" ] || fail "something is left over" ;;
    *) fail "exit code $code" ;;
  esac
else
  skipped "no more threads" "it takes root, setpriv and prlimit"
fi

# -- Devices that are not there -------------------------------------------------------------------------
none() { VK_DRIVER_FILES=/nonexistent.json VK_ICD_FILENAMES=/nonexistent.json "$@"; }
none fails 3 "no Vulkan driver" "vulkan" render --backend vulkan-geometry --sites random:9 -o out/old.png
none fails 3 "compare without a Vulkan driver" "vulkan" compare --backends cpu,vulkan-geometry --sites random:9 --report out/old.json
none succeeds "cpu without a Vulkan driver" render --backend cpu --sites random:9 --size 9x9 -o out/l.png
none succeeds "devices without a Vulkan driver" devices
expect "cannot be used"
VORPIPE_VALIDATION=maybe fails 2 "validation, perhaps" 'VORPIPE_VALIDATION: "maybe" is neither yes nor no' \
  render --backend cpu --sites random:9 -o out/old.png
if [ -n "${VORPIPE_EXPECTED_BACKENDS:-}" ]; then
  # Where there are no layers, who asks for them is told so.
  for word in yes True on; do
    VK_LAYER_PATH=/nonexistent VORPIPE_VALIDATION=$word fails 3 "validation: $word" VK_LAYER_KHRONOS_validation \
      render --backend vulkan-compute --sites random:9 -o out/old.png
  done
  VK_LAYER_PATH=/nonexistent VORPIPE_VALIDATION=off succeeds "validation: off" \
    render --backend vulkan-compute --sites random:9 --size 9x9 -o out/l.png
else
  skipped "validation by a word" "the software drivers are not installed"
fi
broken_egl() { __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json __EGL_VENDOR_LIBRARY_DIRS=/nonexistent "$@"; }
broken_egl fails 3 "no EGL" "opengl" render --backend opengl --sites random:9 -o out/old.png
broken_egl succeeds "cpu without EGL" render --backend cpu --sites random:9 --size 9x9 -o out/l.png
fails 3 "geometry shader masked" "geometryShader" render --backend vulkan-geometry --disable geometryShader --sites random:9 -o out/old.png
fails 3 "no such device" "no-such-device" render --backend vulkan-geometry --device no-such-device --sites random:9 -o out/old.png
fails 3 "no such device of cpu" "'3'" render --backend cpu --device 3 --sites random:9 -o out/old.png
succeeds "the device of cpu" render --backend cpu --device 0 --sites random:9 --size 9x9 -o out/l.png
fails 3 "no such index" "'77'" render --backend vulkan-geometry --device 77 --sites random:9 -o out/old.png
grep -qF "there are 0" log/err && fail "it says that there are no devices"
# A number is no part of a name, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
for backend in vulkan-geometry vulkan-compute opengl cpu; do
  for index in 256 00099999999999999999999; do
    fails 3 "no such index of $backend" "'$index'" cells --backend $backend --device $index --sites random:9 -o out/old.csv
  done
done

finish
