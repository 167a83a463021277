# `vorpipe bench`: bash bench.sh VORPIPE
source "$(dirname "$0")/harness.sh" "$1"

# Every table in all three files, from runs that are as small as they get.
succeeds "all tables" bench all --backend cpu,vulkan-compute --max-sites 300 --max-side 200 --repetitions 2 \
  --json out/all.json --markdown out/all.md --plot out/all.svg
for heading in "## vorpipe bench" "Scaling in sites" "Slopes" "Scaling in threads" "Scaling in pixels" "Stages of a run" \
  "megabytes" "own clock" "### Inputs" "### Memory" "Table 3.3 (c)" "Table 3.4" "Table 3.5"; do
  expect "$heading"
done
expect "Cut short: --max-sites 300"
expect "Cut short: --max-side 200"
expect "| cpu | circle:300 | 300 |"
expect "revision "
cmp -s log/out out/all.md || fail "--markdown is not what is printed"

if "$python" -c '' 2>/dev/null; then
  "$python" - <<'END' >log/out 2>log/err || fail "all.json or all.svg is not what it should be"
import json, statistics, xml.etree.ElementTree as xml

report = json.load(open('out/all.json'))
assert (report['repetitions'], report['max_sites'], report['max_side']) == (2, 300, 200)
for key in ('cpu', 'compiler', 'flags', 'version', 'revision', 'load', 'hardware_threads'):
    assert report['machine'][key] not in ('', None), key
assert [b['name'] for b in report['backends']] == ['cpu', 'vulkan-compute']
assert all(b['device'] and b['driver'] is not None for b in report['backends'])
tables = {table['name']: table for table in report['tables']}
assert sorted(tables) == sorted([
    'scaling_sites', 'scaling_fit', 'scaling_threads', 'scaling_pixels', 'stages_host', 'stages_bytes',
    'stages_device', 'inputs', 'memory', 'thesis_random', 'thesis_square', 'thesis_hex', 'thesis_resolution',
    'thesis_regular']), sorted(tables)
for table in tables.values():
    assert {row['backend'] for row in table['rows']} == {'cpu', 'vulkan-compute'}, table['name']
    for row in table['rows']:
        assert set(table['columns']) <= set(row), table['name']

def check(figure):
    assert len(figure['samples']) == 2
    assert figure['median'] == statistics.median(figure['samples']) > 0
    assert figure['least'] == min(figure['samples']) and figure['spread'] >= 0

for row in tables['scaling_sites']['rows']:
    assert row['sites'] == 300
    check(row['seconds'])
    assert abs(row['nanoseconds_per_site'] - row['seconds']['median'] / 300 * 1e9) < 1
for row in tables['scaling_fit']['rows']:
    assert row['sites_exponent'] is None and row['missing']['sites_exponent'] == 'needs two sizes'
    assert row['pixels_exponent'] is None
assert {row['side'] for row in tables['scaling_pixels']['rows']} == {200}
stages = ('order', 'search', 'upload', 'clip', 'draw', 'download', 'resolve', 'rest')
for row in tables['stages_host']['rows']:
    told = [row[stage] for stage in stages if row[stage] is not None]
    whole = sum(row['whole']['samples'])
    # Each run is the sum of its stages, but for what they round.
    assert abs(sum(sum(stage['samples']) for stage in told) - whole) < 1e-6 * whole, row
    assert (row['clip'] is None) == row['job'].startswith('picture'), row
    assert (row['search'] is None) == (row['job'] != 'picture, flann:30'), row
for row in tables['stages_bytes']['rows']:
    drawn = row['job'].startswith('picture')
    assert (row['download_received'] == 0.32) if drawn else (row['download_received'] is None), row
inputs = tables['inputs']['rows']
assert len(inputs) == 12 and {row['input'] for row in inputs} == {
    kind + ':300' for kind in ('random', 'jitter', 'square', 'hex', 'clusters', 'circle')}
assert [row['over_random'] for row in inputs if row['input'] == 'random:300'] == [1.0, 1.0]
for row in tables['memory']['rows']:
    assert row['sites'] == 300 and 1 < row['peak_megabytes'] < 2000, row
assert len(tables['memory']['rows']) == 6
theirs = [row for row in tables['thesis_random']['rows'] if row['sites'] == 100]
assert all(row['thesis_device'] == 0.00175 and row['thesis_neighbors'] == 8.14e-05 for row in theirs)
for row in tables['thesis_resolution']['rows']:
    for key in ('side_200', 'not_drawn'):
        check(row[key])
assert {row['pattern'] for row in tables['thesis_regular']['rows']} == {'hex', 'square'}
drawing = xml.parse('out/all.svg').getroot()
space = '{http://www.w3.org/2000/svg}'
assert drawing.tag == space + 'svg'
texts = [text.text for text in drawing.iter(space + 'text')]
for name in ('cpu', 'vulkan-compute', 'thesis, Iris Plus', 'threads', 'pixels', 'MB'):
    assert name in texts, name
END
else
  skipped "what all.json and all.svg say" "there is no python3"
fi

# Real data; a backend that this program does not know, or that cannot be used.
printf 'x,y\n0,0\n1,2\n2,0\n3,3\n' >in/four.csv
succeeds "real data" bench inputs --backend cpu --max-sites 10 --repetitions 1 --sites in/four.csv
expect "| cpu | four.csv | 4 |"
succeeds "quiet" bench stages --backend cpu --max-sites 10 --max-side 10 --repetitions 1 --quiet
[ -s log/out ] && fail "something on standard output"
succeeds "no geometry shader" bench inputs --max-sites 10 --repetitions 1 --disable geometryShader
expect "- vulkan-geometry: not measured: "

fails 2 "no such table" "speed" bench speed
fails 2 "no such backend" "--backend" bench --backend gpu
fails 2 "no repetitions" "--repetitions" bench --repetitions 0
fails 2 "a plot of nothing" "--plot" bench inputs --plot out/a.svg
fails 2 "a plot that is no SVG" "--plot" bench scaling --plot out/a.png
fails 2 "no such file" "--sites" bench inputs --backend cpu --sites in/none.csv --json out/old.json
fails 3 "a backend that cannot be used" "geometryShader" bench --backend vulkan-geometry --disable geometryShader \
  --json out/old.json

# Interrupted, it says so in one line and leaves no file, and no process either.
name="interrupted"
cases=$((cases + 1))
"$vorpipe" bench scaling --backend cpu --max-sites 100000 --repetitions 900 --json out/new.json >log/out 2>log/err &
sleep 1
kill -INT $!
wait $!
code=$?
[ "$code" -eq 130 ] || fail "exit code $code, not 130"
one_line
ls out | grep -q new && fail "a file is left"

finish
