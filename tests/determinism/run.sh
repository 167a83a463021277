#!/usr/bin/env bash
# The same bytes whatever the compiler, the lanes and the threads: run.sh [--quick] VORPIPE [VORPIPE...] runs each line of
# inputs.txt on `cpu` by each program, with lanes of 16, 8 and 4 numbers where the processor has them, on 1, 2 and 5
# threads; with --quick in three ways instead of six. With --other-libm programs are of several C libraries: what takes
# their sines is left out. Exit code 1, and the names, where hashes differ.
set -u
here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
quick='' other_libm=''
while [[ ${1-} == --* ]]; do
  case $1 in
    --quick) quick=1 ;;
    --other-libm) other_libm=1 ;;
    *) set -- ;;
  esac
  shift
done
if [[ $# == 0 ]]; then
  echo 'usage: run.sh [--quick] [--other-libm] VORPIPE [VORPIPE...]' >&2
  exit 2
fi
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

# Lanes and threads.
ways=("16 1" "16 2" "16 5" "8 2" "4 1" "4 5")
if [[ $quick ]]; then ways=("16 2" "4 1" "8 3"); fi

# hashOf PROGRAM LANES THREADS ARGUMENT...: of what the file or files are that it writes.
hashOf() {
  local program=$1 lanes=$2 threads=$3
  shift 3
  rm -rf "$work/out"
  mkdir "$work/out"
  VORPIPE_LANES=$lanes "$program" "$@" --backend cpu --threads "$threads" >"$work/said" 2>&1 || {
    echo "failed: $(tail -n 1 "$work/said")"
    return
  }
  if [[ -z $(ls "$work/out") ]]; then
    echo 'failed: no file was written'
    return
  fi
  cat "$work"/out/* | sha256sum | cut -c1-16
}

inputs=0
runs=0
different=()
while read -r name arguments; do
  if [[ -z $name || $name == '#' ]] || [[ $other_libm && $name == *-libm ]]; then continue; fi
  inputs=$((inputs + 1))
  arguments=${arguments//OUT/$work/out/result}
  arguments=${arguments//HERE/$here/../..}
  first=
  for program in "$@"; do
    for way in "${ways[@]}"; do
      read -r lanes threads <<<"$way"
      hash=$(hashOf "$program" "$lanes" "$threads" $arguments)
      runs=$((runs + 1))
      if [[ -z $first ]]; then first=$hash; fi
      if [[ $hash != "$first" || $hash == failed* ]]; then
        echo "$name: $hash, not $first: $program, $lanes lanes, $threads threads"
        different+=("$name")
      fi
    done
  done
done <"$here/inputs.txt"
echo "$inputs inputs, $runs runs, ${#different[@]} different"
[[ ${#different[@]} == 0 ]]
