#!/usr/bin/env bash
# What was skipped in a run of all tests: skipped.sh REPORTED JUNIT
#
# Tests report to the file that VORPIPE_SKIPPED names, a line for each case or part: test, part (none for the whole
# test) and reason, with tabs between. JUNIT is what ctest writes: a test that it says it skipped, and that has not
# reported so, is counted all the same. Prints "0 skipped", or "3 skipped:" and a line for each test and reason.
reported=$1 junit=$2
{
  [[ ! -f $reported ]] || cat "$reported"
  [[ ! -f $junit ]] || sed -n 's/.*<testcase name="\([^"]*\)".* status="\(notrun\|disabled\)".*/\1\t\tctest/p' "$junit"
} | LC_ALL=C sort | LC_ALL=C awk -F '\t' '
  $3 == "ctest" { silent[$1] = 1; next }
  {
    count++
    test = $1 == "" ? "a test" : $1
    if ($2 == "") whole[$1] = 1
    key = test "\t" $3
    if (!(key in parts)) order[++keys] = key
    parts[key]++
    one[key] = $2
  }
  END {
    for (test in silent) {
      if (test in whole) continue
      key = test "\tctest skipped it, and it gave no reason"
      order[++keys] = key
      parts[key]++
      count++
    }
    print count + 0 (count ? " skipped:" : " skipped")
    for (i = 1; i <= keys; i++) {
      split(order[i], field, "\t")
      part = parts[order[i]] > 1 ? parts[order[i]] " cases: " : one[order[i]] == "" ? "" : one[order[i]] ": "
      print "  " field[1] ": " part field[2]
    }
  }'
