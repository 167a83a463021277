#!/usr/bin/env bash
# Installs the programs that vorpipe is measured against, builds the preset bench, and measures: prints the table
# of the README. Arguments go to bench_cells: tests/bench/run.sh --sites 100000 --patterns random,clusters; those behind
# --space, which comes first, to bench_space.
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/third_party/prepare.sh"

lockBuild
installPackages tool build test program python shader driver peer
program=bench_cells
if [[ ${1-} == --space ]]; then
  program=bench_space
  shift
fi
buildPreset bench $program || exit 3
modules=$root/build/bench/tests/bench
if command -v npm >/dev/null; then
  npm install --no-audit --no-fund --prefix "$modules" d3-delaunay@6.0.6 delaunator@5.1.0 >"$root/build/npm.log" 2>&1 ||
    printf 'run.sh: npm could not install d3-delaunay, see build/npm.log\n' >&2
fi
unlockBuild

exec "$modules/$program" "$@"
