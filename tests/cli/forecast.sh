# The forecast of memory against what runs take, and --memory-limit. $1 is the program.
. "$(dirname "$0")/harness.sh"
# Layers and a driver that fills memory take more of it than the forecast is about.
unset VORPIPE_VALIDATION LVP_POISON_MEMORY

figure() { grep -oP "\"$1\": \K[0-9]+" out/stats.json; }

# measures PERCENT NAME ARGUMENT...: the run takes no more than its forecast says, and no less than PERCENT of it, but for
# what newer drivers take.
measures() {
  local least=$1 what=$2 newer=17000000 forecast peak
  shift 2
  [[ " $* " != *" --backend cpu "* ]] || newer=0
  succeeds "$what" "$@" --quiet --stats out/stats.json
  forecast=$(figure forecast_memory_bytes)
  peak=$(figure peak_memory_bytes)
  printf '%-44s %5d MB, %5d MB forecast, %3d %%\n' "$what" $((peak / 1000000)) $((forecast / 1000000)) $((100 * peak / forecast))
  [ "$peak" -le "$forecast" ] || fail "took $peak bytes, the forecast was $forecast"
  [ $((100 * (peak + newer))) -ge $((least * forecast)) ] || fail "took $peak bytes, the forecast was $forecast: too much"
}

# How sites lie is not looked at: the kind that takes most memory counts, and there is room for the triangulation of all
# that a device may leave, and of all triangles, which are made anew where a tie hides one. So the forecast may be 40 %
# too high, and for pictures of even sites, and in space, where crystals take most, twice as high; never too low. On a
# busy machine a run takes up to 3 % less: which thread asks for memory first decides what gaps the heap has, a thread
# that never began has none, and of the program's own pages fewer are there. With this many sites no share is that near
# to its bound.
n=125000
ln -s /dev/null out/cells.npz
for backend in $backends; do
  measures 70 "$backend, measures" cells --backend "$backend" --sites random:$n
  measures 70 "$backend, everything" cells --backend "$backend" --sites random:$n -o out/cells.npz
done
# Drivers that were looked through stay in memory.
if [ -n "${VORPIPE_EXPECTED_BACKENDS-}" ]; then
  measures 70 "auto, measures" cells --sites random:$n
  measures 70 "auto, everything" cells --sites random:$n -o out/cells.npz
fi
# A second step of the search, and sites of which a tie hides a triangle. Of random sites, gaps that the first step leaves
# decide whether two steps take 68 or 74 %.
measures 72 "cpu, measures, two steps" cells --backend cpu --sites clusters:400000
measures 70 "cpu, all triangles anew" cells --backend cpu --sites random:500000 --seed 6 -o out/cells.npz
for format in csv obj; do
  ln -s /dev/null out/cells.$format
  measures 70 "cpu, .$format" cells --backend cpu --sites random:$n -o out/cells.$format
done
measures 70 "cpu, checked" cells --backend cpu --sites random:$n --check -o out/cells.npz
measures 70 "cpu, weights" cells --backend cpu --sites random:$n --random-weights 0,1e-6 -o out/cells.npz
measures 70 "cpu, weights, measures" cells --backend cpu --sites random:$n --random-weights 0,1e-6
measures 70 "cpu, the globe" cells --backend cpu --globe --sites random:$n -o out/cells.npz
measures 70 "cpu, the globe, measures" cells --backend cpu --globe --sites random:$n
measures 70 "cpu, the globe, weights" cells --backend cpu --globe --sites random:$n --random-weights 0,100 -o out/cells.npz
# Of crystals and clusters cells have fewer faces.
measures 55 "space, measures" cells --dim 3 --sites random:$n
measures 70 "space, everything" cells --dim 3 --sites random:$n -o out/cells.npz
measures 50 "space, clusters" cells --dim 3 --sites clusters:$n -o out/cells.npz
measures 40 "space, a crystal" cells --sites bcc:$n -o out/cells.npz
measures 60 "space, a crystal, measures" cells --sites hcp:20000
measures 55 "space, checked" cells --dim 3 --sites random:$n --check --detail measures -o out/cells.npz
ln -s /dev/null out/cells.vtu
measures 70 "space, .vtu" cells --dim 3 --sites random:$n -o out/cells.vtu
measures 70 "cpu, periodic" cells --backend cpu --sites random:$n --periodic xy -o out/cells.npz
echo 'POLYGON ((0 0, 1 0, 1 1, 0.5 0.98, 0 1, 0 0))' >in/outline.wkt
measures 70 "cpu, an outline" cells --backend cpu --sites random:$n --domain in/outline.wkt -o out/cells.npz
succeeds "a picture for a density" render --backend cpu --sites random:900 --size 400x300 --quiet -o in/density.png
measures 70 "cpu, a density" cells --backend cpu --sites random:$n --density in/density.png -o out/cells.npz
measures 70 "cpu, a density, measures" cells --backend cpu --sites random:$n --density in/density.png --detail measures -o out/measures.npz
measures 70 "cpu, a density in an outline" cells --backend cpu --sites random:$n --domain in/outline.wkt --density in/density.png -o out/cells.npz
measures 70 "cpu, a density, periodic" cells --backend cpu --sites random:$n --periodic xy --density in/density.png -o out/cells.npz
awk -v n=$n 'BEGIN { srand(7); print "x,y"; for (i = 0; i < n; ++i) printf "%.9f,%.9f\n", rand(), rand() }' >in/sites.csv
measures 70 "cpu, sites from a file" cells --backend cpu --sites in/sites.csv
measures 70 "cpu, a picture of the globe" render --globe --backend cpu --sites random:$n --size 1000 --color area -o out/picture.png
measures 70 "cpu, smooth edges on the globe" render --globe --backend cpu --sites random:$n --size 1000 --edges --antialias 4 \
  -o out/picture.png
measures 70 "cpu, shapes of the globe" render --globe --backend cpu --sites random:$n --map equal-earth --edges -o out/picture.svg
# How many cells a driver draws at a time follows from how fast it is, and its memory from that: on a machine that is
# busy, a third less than planned.
for backend in $backends; do
  for sites in 20000 50000 $n; do
    measures 55 "$backend, a picture of $sites" render --backend "$backend" --sites random:$sites --size 2000x1500 --fit stretch -o out/picture.png
  done
done
for backend in $backends; do
  [ "$backend" = cpu ] || measures 50 "$backend, by area" render --backend "$backend" --sites random:$n --color area -o out/picture.png
done
measures 70 "cpu, a picture by area" render --backend cpu --sites random:$n --color area -o out/picture.png
measures 70 "cpu, a picture with weights" render --backend cpu --sites random:20000 --random-weights 0,1e-6 -o out/picture.png
measures 55 "cpu, a picture with lines" render --backend cpu --sites random:$n --edges --antialias 2 -o out/picture.png
measures 55 "cpu, a picture, checked" render --backend cpu --sites random:$n --check -o out/picture.png
measures 40 "cpu, a large picture" render --backend cpu --sites random:1500000 -o out/picture.png
measures 55 "compare" compare --backends cpu,vulkan-compute --sites random:$n --size 500x500
# After steps: as large as a picture is in its domain.
measures 60 "cpu, sites that moved, a picture" relax --backend cpu --sites random:20000 --iterations 2 --picture out/picture.png
if [ -n "${VORPIPE_EXPECTED_BACKENDS-}" ]; then
  measures 60 "opengl, sites that moved, a picture" relax --backend opengl --sites random:20000 --iterations 2 --picture out/picture.png
  measures 60 "vulkan-geometry, weights that are sought" transport --backend vulkan-geometry --sites random:10000 -o out/moved.csv
fi
measures 70 "cpu, frames" fluid --backend cpu --case shear --particles 3000 --steps 2 --frames out/frames --size 1500

# Hard ones.
for pattern in square clusters circle; do
  measures 70 "cpu, $pattern, measures" cells --backend cpu --sites $pattern:$n
  measures 70 "cpu, $pattern, everything" cells --backend cpu --sites $pattern:$n -o out/cells.npz
  measures 55 "cpu, $pattern, a picture" render --backend cpu --sites $pattern:60000 -o out/picture.png
done
rm out/cells.*

# The limit: a run that needs more is refused before it begins, any other is the same with it.
echo x,y$'\n'0.25,0.5$'\n'0.75,0.5 >in/two.csv
for size in 0 -1 x 1XB "" 1e; do refuses "the size $size" "--memory-limit" --sites random:9 --memory-limit "$size"; done
for size in 5MB 5MiB 5000000 5e6 4.8MiB; do
  refuses "a picture within $size" "allowed by --memory-limit" --sites in/two.csv --memory-limit "$size"
done
refuses "a large picture" "; without any site it needs " --sites random:9 --size 9000x9000 --memory-limit 200MB
fails 2 "many cells within 1GB" "sites would fit" cells --backend cpu --sites random:100000000 --memory-limit 1GB -o out/old.csv
grep -qE -- '--sites: needs about [0-9.]+ GB of memory, 1.0 GB are allowed by --memory-limit; some [0-9]+ sites would fit; areas, centroids and numbers of neighbors alone need less: --detail measures$' log/err ||
  fail "the line says something else"
fails 2 "cells of a file within 30MB" "--sites: needs about" cells --backend cpu --sites in/sites.csv --memory-limit 30MB -o out/old.csv
fails 2 "pictures compared within 90MB" "--memory-limit" compare --backends cpu,vulkan-compute --sites random:9 --memory-limit 90MB --report out/old.json
fails 2 "another backend" "--backend cpu needs" cells --backend vulkan-compute --sites random:9 --memory-limit 60MB -o out/old.csv
fails 2 "without a look at drivers" "--backend cpu needs" cells --sites random:9 --memory-limit 60MB -o out/old.csv
succeeds "bench within 1MB" bench stages --backend cpu --memory-limit 1MB --max-sites 10000 --repetitions 1 --max-side 500
expect "allowed by --memory-limit"
for limit in 1GB 1.5GiB 4000000000; do
  succeeds "cells within $limit" cells --backend cpu --sites random:5000 --quiet -o out/limited.csv --memory-limit "$limit"
  succeeds "cells without a limit" cells --backend cpu --sites random:5000 --quiet -o out/free.csv
  cmp -s out/limited.csv out/free.csv || fail "other cells"
done
# What the forecast says is just enough.
succeeds "a forecast" cells --backend cpu --sites random:20000 --quiet --stats out/stats.json
enough=$(figure forecast_memory_bytes)
succeeds "just enough" cells --backend cpu --sites random:20000 --quiet --stats out/stats.json --memory-limit "$enough"
fails 2 "a byte less" "--memory-limit" cells --backend cpu --sites random:20000 --quiet --stats out/old.json --memory-limit $((enough - 1))
(
  ulimit -d 200000
  failures=0
  fails 2 "a limit of the system" "ulimit -d" cells --backend cpu --sites random:5000000 --stats out/old.json
  [ "$failures" -eq 0 ]
) || failures=$((failures + 1))

# -- Tiles ----------------------------------------------------------------------------------------------
succeeds "measures in one tile" cells --backend cpu --sites clusters:50000 --detail measures -o out/whole.npz --stats out/stats.json
expect "50000 unweighted cells (0 empty, 0 duplicate), 1 tiles, cpu on "
enough=$(figure forecast_memory_bytes)
succeeds "less than a tile takes" cells --backend cpu --sites clusters:50000 --detail measures -o out/tiles.npz --stats out/stats.json --memory-limit $((enough - 1))
grep -A 1 '"tiles"' out/stats.json | grep -Eq '"count": ([2-9]|[1-9][0-9])' || fail "not several tiles"
cmp -s out/whole.npz out/tiles.npz || fail "tiles change measures"
[ "$(figure peak_memory_bytes)" -lt "$(figure forecast_memory_bytes)" ] || fail "more memory than forecast"
fails 2 "too little for any tile" "--sites: needs about" cells --backend cpu --sites random:1000 --detail measures -o out/old.npz --memory-limit 1MB
fails 2 "measures as a table" "--detail: measures alone go to a file of arrays: -o FILE.npz" cells --sites random:9 --detail measures -o out/old.csv
fails 2 "no such detail" "--detail: \"some\" is no detail" cells --sites random:9 --detail some -o out/old.npz
succeeds "measures with weights, whole" cells --backend cpu --sites random:500 --random-weights 0,0.01 --quiet --detail measures -o out/weighted.npz
succeeds "measures of a period, whole" cells --backend cpu --sites random:500 --periodic xy --detail measures -o out/periodic.npz
finish
