#!/usr/bin/env bash
# What is skipped is reported by every kind of test, and counted: skipped_test.sh UNIT_TEST VORPIPE CTEST
set -u
here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
unit_test=$1 vorpipe=$2 ctest=$3
real_reports=${VORPIPE_SKIPPED-} real_name=${VORPIPE_TEST_NAME-}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
export VORPIPE_SKIPPED=$work/reported VORPIPE_TEST_NAME=some
failures=0
fail() {
  failures=$((failures + 1))
  echo "FAILED: $*" >&2
}

# reports CODE LINE... -- COMMAND...: the command ends with CODE, and each LINE, with ~ for tabs, is reported.
reports() {
  local expected=$1 code
  local -a lines=()
  shift
  while [[ $1 != -- ]]; do
    lines+=("$1")
    shift
  done
  shift
  rm -f reported
  "$@" >said 2>&1 </dev/null
  code=$?
  [[ $code == "$expected" ]] || fail "exit code $code, not $expected: $*: $(tail -n 3 said)"
  printf '%s\n' "${lines[@]}" | tr '~' '\t' | sort >wanted
  sort reported 2>/dev/null | diff wanted - || fail "not what was to be reported (<): $*"
}

no_numpy="there is no python3 with NumPy"
reports 0 "some~Npy.IdsComeBack~$no_numpy" "some~CellsFile.NumPyReadsTheArrays~$no_numpy" -- \
  env VORPIPE_TEST_PYTHON=/nonexistent "$unit_test" --gtest_filter=Npy.IdsComeBack:CellsFile.NumPyReadsTheArrays:Npy.Ref*
rm -f reported
if "$unit_test" --gtest_filter=NoSuch.* >said 2>&1; then fail "no case is selected, and that passes"; fi
grep -q "no test case is selected" said || fail "it does not say that no case is selected"
reports 0 "some~a part~no pen" -- bash -c "source '$here/cli/harness.sh' '$vorpipe'; skipped 'a part' 'no pen'; finish"
reports 77 "some~~no paper" -- sh "$here/skip.sh" "no paper"

python=${VORPIPE_TEST_PYTHON:-python3}
if "$python" -c '' 2>/dev/null; then
  # Without site packages there is no NumPy.
  reports 77 "some~~there is no NumPy, and with it nothing to compare with" -- \
    "$python" -S "$here/cli/cells_readers.py" "$vorpipe"
else
  VORPIPE_SKIPPED=$real_reports VORPIPE_TEST_NAME=$real_name sh "$here/skip.sh" "there is no python3" || true
fi
if "$python" -c 'import geopandas, numpy, shapely, vtkmodules' 2>/dev/null; then
  reports 0 "some~ogr_geojson~there is no ogr2ogr" "some~libxml_svg~there is no xmllint" \
    "some~librsvg_svg~there is no rsvg-convert" "some~assimp_meshes~there is no assimp" \
    "some~attributes_in_ogr~there is no ogrinfo" "some~ogr_gpkg~there is no ogrinfo" -- \
    env PATH=/nonexistent "$python" "$here/cli/cells_readers.py" "$vorpipe"
fi

# counts TEXT: what skipped.sh makes of the reports and of ctest's results.
counts() {
  local made
  made=$("$here/skipped.sh" "$work/reported" "$work/junit.xml")
  [[ $made == "$1" ]] || fail "it says: $made"
}
rm -f reported
counts "0 skipped"
cat >CTestTestfile.cmake <<'CTEST'
add_test(passes true)
add_test(silent sh -c "exit 77")
add_test(speaks sh -c "printf 'speaks\\t\\tno ink\\n' >>\"\$VORPIPE_SKIPPED\"; exit 77")
add_test(parts sh -c "printf 'parts\\ta\\tno ink\\nparts\\tb\\tno ink\\nparts\\tc\\tno pen\\n' >>\"\$VORPIPE_SKIPPED\"")
set_tests_properties(silent speaks PROPERTIES SKIP_RETURN_CODE 77)
CTEST
"$ctest" --test-dir "$work" --output-junit junit.xml >said 2>&1 || fail "ctest: $(cat said)"
counts "5 skipped:
  parts: 2 cases: no ink
  parts: c: no pen
  speaks: no ink
  silent: ctest skipped it, and it gave no reason"

echo "$failures failures"
[[ $failures == 0 ]]
