#!/bin/sh
# Runs a test with SwiftShader as the one Vulkan driver, where it is: on_swiftshader.sh COMMAND...
tests=$(cd "$(dirname "$0")" && pwd) || exit 1
driver=$tests/../build/swiftshader/vk_swiftshader_icd.json
if ! [ -f "$driver" ]; then
  exec sh "$tests/skip.sh" "SwiftShader is not in build/swiftshader, where ./test puts it out of Debian's package chromium-common"
fi
export VK_DRIVER_FILES="$driver" VK_ICD_FILENAMES="$driver" VORPIPE_EXPECTED_BACKENDS=vulkan-compute
exec "$@"
