#!/usr/bin/env bash
# The program on a Vulkan driver that shares nothing with Mesa's, and that nothing was written for: no geometry shader,
# no double, 65,536 texels, 4 sub-pixel bits, numbers below 2^-126 flushed to 0.
# Usage: on_swiftshader.sh bash swiftshader.sh VORPIPE LAYER_FOLDER
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

succeeds "selftest" selftest --quick --backend vulkan-compute
expect "SwiftShader"
expect "; validated"
grep -q '^all [0-9]* runs on 1 device passed' log/out || fail "no summary of what passed"

# Of the layers the self-test has made use.
export VORPIPE_VALIDATION=0
succeeds "pictures and cells of both" compare --backends vulkan-compute,cpu --device SwiftShader --sites clusters:1000 \
  --random-weights 0,0.0001 --size 100 --check
if lavapipe=$(ls /usr/share/vulkan/icd.d/lvp_icd*.json 2>/dev/null | head -n 1) && [ -n "$lavapipe" ]; then
  VK_DRIVER_FILES=$VK_DRIVER_FILES:$lavapipe succeeds "two devices of one backend" compare \
    --backends vulkan-compute:SwiftShader,vulkan-compute:llvmpipe --sites clusters:300 --size 100 --report out/two.json
  expect "vulkan-compute:SwiftShader / vulkan-compute:llvmpipe"
  grep -q '"device": "SwiftShader' out/two.json && grep -q '"device": "llvmpipe' out/two.json || fail "not two devices"
else
  skipped "two devices of one backend" "there is no lavapipe"
fi
fails 3 "no geometry shader" "it lacks the feature geometryShader" cells --backend vulkan-geometry --sites hex:100 -o out/old.csv

# -- Faults, made by a layer between program and driver ---------------------------------------------------
export VK_LAYER_PATH=$2:/usr/share/vulkan/explicit_layer.d VK_INSTANCE_LAYERS=VK_LAYER_VORPIPE_faulty
VORPIPE_LAYER_LOST_AT=1 fails 3 "lost" VK_ERROR_DEVICE_LOST render --backend vulkan-compute --sites hex:100 -o out/old.png
run 0 cells --backend cpu --sites random:10000 -o out/right.csv
name="without memory" cases=$((cases + 1))
VORPIPE_LAYER_LARGEST_ALLOCATION=131072 run 0 cells --backend vulkan --sites random:10000 -o out/less.csv
expect "vulkan-compute on SwiftShader"
grep -q '^vorpipe: note: .* at a time$' log/err || fail "no note of less at a time"
cmp -s out/right.csv out/less.csv || fail "other bytes"

finish
