#!/usr/bin/env bash
# Which lines of src the tests reach: builds the preset coverage, runs the tests, and prints the lines of each folder and
# how many of them ran. build/coverage/uncovered.txt has each file with the lines that did not.
# Arguments go to ctest: tests/coverage.sh -R unit
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit
source third_party/prepare.sh
lockBuild
installPackages tool build test program python shader driver coverage
if ! command -v gcovr >/dev/null; then
  echo 'coverage.sh: gcovr is missing' >&2
  exit 1
fi
buildPreset coverage || exit
unlockBuild

built=build/coverage
find "$built" -name '*.gcda' -delete
ctest --test-dir "$built" --no-tests=error -j "$(nproc)" "$@"
code=$?
# Objects of tests have nothing of src but headers, which the others have as well.
gcovr --root . --filter src/ -j "$(nproc)" --csv "$built/lines.csv" --txt "$built/uncovered.txt" \
  "$built/src" || exit
echo
awk -F, '
  NR > 1 {
    folder = $1
    sub("^src/", "", folder)
    if (!sub("/[^/]*$", "", folder)) folder = "."
    if (split(folder, part, "/") > 2) folder = part[1] "/" part[2]
    lines[folder] += $2
    ran[folder] += $3
    lines["all"] += $2
    ran["all"] += $3
  }
  END {
    for (folder in lines) printf "%-28s %6d lines %6.1f %%\n", folder, lines[folder], 100 * ran[folder] / lines[folder]
  }' "$built/lines.csv" | sort
exit $code
