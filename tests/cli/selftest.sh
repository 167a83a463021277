#!/usr/bin/env bash
# `vorpipe selftest`: what it finds here, which is nothing wrong, and what it refuses.
# Usage: selftest.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

succeeds "all devices" selftest --quick --json out/all.json
expect "selftest --quick, seed 1"
for group in even clustered lattices curves weights periodic outline scales crowds slivers large "small limits" \
  "4 sub-pixel bits"; do
  expect "  $group ("
done
for row in quotient root "inverse root" product sum "sum of differences" "sub-pixel bits" maxTexelBufferElements; do
  expect "  $row"
done
grep -q '^all [0-9]* runs on [0-9]* devices* passed' log/out || fail "no summary of what passed"
grep -q FAULT log/out && fail "a fault, and exit code 0"

if "$python" -c '' 2>/dev/null; then
  "$python" - $backends <<'END' >log/out 2>log/err || fail "all.json is not what it should be"
import json, os, sys

report = json.load(open('out/all.json'))
assert (report['command'], report['quick'], report['seed'], report['passed']) == ('selftest', True, 1, True)
assert report['time_ms'] > 0 and report['version'] and report['machine']['system']
tested = {}
for device in report['devices']:
    for key in ('backend', 'index', 'name', 'driver', 'type', 'reason', 'features', 'limits', 'not_validated'):
        assert key in device, key
    if not device['usable']:
        assert device['reason'] and device['passed'] is None and not device['runs']
        continue
    tested[device['backend']] = device
    assert device['passed'] is True and device['arithmetic_fault'] is None
    numbers = device['arithmetic']
    for what in ('quotient', 'root', 'inverse_root', 'product', 'sum', 'sum_of_differences'):
        assert 0 < numbers[what + '_ulp'] <= report['allowed'][what + '_ulp'], what
    for what in ('fuses', 'fuses_precise', 'keeps_denormals'):
        assert numbers[what] in (True, False), what
    drawn = device['backend'] != 'cpu'
    assert numbers['subpixel_bits'] == (device['limits']['subPixelPrecisionBits'] if drawn else None)
    for run in device['runs']:
        assert run['passed'] is True and run['fault'] is None and run['seed'] in range(1, 5) and run['sites'] > 0
        assert run['time_ms'] > 0 and run['group'] and run['scene']
    names = [(run['group'], run['scene'], run['seed']) for run in device['runs']]
    assert len(set(names)) == len(names) >= 40, names
    masks = {run['masked'] for run in device['runs']} - {None}
    assert len(masks) == (2 if drawn else 0), masks
    assert device['validated'] == (device['backend'].startswith('vulkan') and device['not_validated'] is None)
expected = os.environ.get('VORPIPE_EXPECTED_BACKENDS')
assert 'cpu' in tested and (not expected or set(tested) == set(sys.argv[1:])), tested.keys()
END
else
  skipped "what all.json says" "there is no python3"
fi

succeeds "one backend, which is required" selftest --quick --backend cpu --device 0 --seed 5 --threads 1 --require cpu,cpu:0
expect "[1] cpu 0: "
expect "on 1 device passed"
grep -qF "[2]" log/out && fail "another device"
name="a required backend that is not tested" cases=$((cases + 1))
run 1 selftest --quick --backend cpu --require cpu --require vulkan-compute --json out/required.json --quiet
one_line
mentions "--require: vulkan-compute is not among what was tested"
grep -q '"passed": true' out/required.json || fail "no report beside what is lacking"
name="a required backend that cannot be used" cases=$((cases + 1))
VK_DRIVER_FILES=/none VK_ICD_FILENAMES=/none __EGL_VENDOR_LIBRARY_FILENAMES=/none run 1 selftest --quick --require vulkan --quiet
one_line
mentions "--require: vulkan: "
fails 2 "what cannot be required" '--require: "auto" is not one of' selftest --quick --require cpu,auto
fails 2 "an unknown backend that is required" '--require: "gpu" is not one of' selftest --quick --require gpu
succeeds "what auto takes" selftest --quick --backend auto --json out/auto.json --quiet
[ -s log/out ] && fail "not quiet"
grep -q "\"passed\": true" out/auto.json || fail "nothing passed"
if grep -q vulkan-compute out/all.json && [ -n "${VORPIPE_EXPECTED_BACKENDS:-}" ]; then
  succeeds "a masked device" selftest --quick --backend vulkan-compute --device llvmpipe --limit maxTexelBufferElements=2000 \
    --limit maxStorageBufferRange=65536 --json out/masked.json
  grep -q '"maxTexelBufferElements": 2000' out/masked.json || fail "out/masked.json does not have the limit"
  fails 3 "a device that lacks something" "geometryShader" selftest --quick --backend vulkan-geometry --disable geometryShader --json out/old.json
else
  skipped "a masked device" "the software drivers are not installed"
fi
fails 2 "an unknown backend" '--backend: "nope" is not one of' selftest --backend nope --json out/old.json
fails 3 "an unknown device" "there is no device '77'" selftest --quick --device 77 --json out/old.json
fails 3 "an unknown device of a backend" "there is no device 'nope'" selftest --quick --backend cpu --device nope
fails 2 "an unknown limit" '--limit: "maxNope"' selftest --quick --limit maxNope=5
fails 2 "a bad seed" "--seed" selftest --quick --seed -1
fails 2 "a folder that is not there" "out/nowhere" selftest --quick --json out/nowhere/a.json

finish
