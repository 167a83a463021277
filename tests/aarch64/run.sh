#!/usr/bin/env bash
# The same bytes on 64-bit Arm as here: builds vorpipe by Debian's cross compiler, with Debian's libraries for Arm in a
# folder of their own, and runs it in QEMU: `tests/determinism` without what takes sines of the C library, and `selftest`
# of the backend `cpu`.
# Usage: tests/aarch64/run.sh [--suite NAME]. NAME is Debian's, by default that of this machine.
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root" || exit
suite=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
if [[ ${1-} == --suite && $# == 2 ]]; then
  suite=$2
elif [[ $# != 0 ]]; then
  echo 'usage: tests/aarch64/run.sh [--suite NAME]' >&2
  exit 2
fi

source third_party/prepare.sh
lockBuild
installPackages tool build shader cross
built=build/aarch64
mkdir -p "$built"
if [[ ! -f $built/root.done ]]; then
  rm -rf "$built/root"
  mmdebstrap --variant=extract --architectures=arm64 --include="$(packagesOf 6 build | paste -sd ,)" "$suite" \
    "$built/root" >"$built/root.log" 2>&1 || { tail -5 "$built/root.log" >&2; exit 1; }
  touch "$built/root.done"
fi
{
  cmake -S . -B "$built" --toolchain "$root/tests/aarch64/toolchain.cmake" -G Ninja \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -DVORPIPE_TESTS=OFF \
    -DVORPIPE_INSTALL=OFF -DVORPIPE_SYSROOT="$root/$built/root" &&
    ninja -C "$built" vorpipe
} >"$built/build.log" 2>&1 || { tail -30 "$built/build.log" >&2; exit 1; }
buildPreset dev vorpipe || exit
unlockBuild

# What tests/determinism/run.sh and people call.
arm=$built/vorpipe
cat >"$arm" <<END
#!/bin/sh
exec qemu-aarch64 -L "$root/$built/root" "$root/$built/src/cli/vorpipe" "\$@"
END
chmod +x "$arm"
code=0
tests/determinism/run.sh --quick --other-libm build/dev/src/cli/vorpipe "$arm" || code=1
# Other backends would run the drivers of this machine.
"$arm" selftest --backend cpu || code=1
exit $code
