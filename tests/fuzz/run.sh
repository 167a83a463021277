#!/usr/bin/env bash
# Fuzzes each target for some time and says how often it ran, what of the code that reached, and what was found.
# Usage: tests/fuzz/run.sh [--seconds N] [TARGET...]
# Inputs that reached something new are kept in build/fuzz/corpus; findings, made small, in build/fuzz/findings.
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root" || exit
seconds=3600
if [[ ${1-} == --seconds ]]; then
  seconds=$2
  shift 2
fi
if ! [[ $seconds =~ ^[1-9][0-9]*$ ]]; then
  echo "run.sh: --seconds: $seconds is not a number of seconds" >&2
  exit 2
fi

source third_party/prepare.sh
mkdir -p build
installPackages tool build test fuzz
if [[ ! -f build/fuzz/build.ninja ]]; then cmake --preset fuzz >build/fuzz.log || exit; fi
cmake --build --preset fuzz >build/fuzz.log 2>&1 || { tail -30 build/fuzz.log >&2; exit 1; }
fuzz=build/fuzz/tests/fuzz/fuzz
tests/fuzz/seeds.sh unpack build/fuzz
export ASAN_OPTIONS=allocator_may_return_null=1:detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1
# What backends that are not asked would look for.
export VK_DRIVER_FILES=/dev/null

# fuzzOne NAME LONGEST WORDS: a line about a target. libFuzzer ends with each finding, and goes on from what it has.
fuzzOne() {
  local name=$1 longest=$2 words=$3 left=$seconds runs=0 covered=0 begin
  local corpus=build/fuzz/corpus/$name findings=build/fuzz/findings/$name
  mkdir -p "$corpus" "$findings"
  local all=build/fuzz/findings/$name.log last=build/fuzz/findings/$name.last
  : >"$all"
  local -a options=("--target=$name" -max_len="$longest" -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=1024
    -print_final_stats=1 -artifact_prefix="$findings/")
  [[ -z $words ]] || options+=(-dict="tests/fuzz/dict/$words.dict")
  while ((left > 0)); do
    begin=$SECONDS
    "$fuzz" "${options[@]}" -max_total_time="$left" "$corpus" "build/fuzz/seeds/$name" >"$last" 2>&1
    cat "$last" >>"$all"
    left=$((left - (SECONDS - begin) - 1))
    runs=$((runs + $(sed -n 's/^stat::number_of_executed_units: *//p' "$last")))
    covered=$(sed -n 's/^#.* cov: \([0-9]*\) .*/\1/p' "$last" | sort -n | tail -1)
  done
  local found
  found=$(find "$findings" -type f ! -name 'slow-unit-*' | wc -l)
  printf '%-16s %6d s %11d runs %6s edges %4d findings\n' "$name" "$seconds" "$runs" "$covered" "$found"
  return $((found > 0))
}

code=0
while read -r name longest words; do
  [[ $# == 0 || " $* " == *" $name "* ]] || continue
  fuzzOne "$name" "$longest" "$words" || code=1
done < <("$fuzz" --list)
exit $code
