# What the tests of the command line have in common. Sourced with the program as $1; the working directory is a
# new one then, with folders in and out.
set -u
export LC_ALL=C

vorpipe=$(realpath "$1") || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
mkdir in out log

cases=0
failures=0
fail() {
  failures=$((failures + 1))
  echo "FAILED: $name: $*" >&2
  sed 's/^/    stderr: /' log/err >&2
  sed 's/^/    stdout: /' log/out >&2
}

# run CODE ARGUMENT...: runs vorpipe and checks its exit code.
run() {
  local expected=$1 code
  shift
  "$vorpipe" "$@" >log/out 2>log/err </dev/null
  code=$?
  [ "$code" -eq "$expected" ] || fail "exit code $code, not $expected: vorpipe $*"
}

# What is asked some hundred times, the shell finds by itself: each program that it starts takes as long as a refusal.
one_line() {
  local said
  mapfile said <log/err
  [[ ${#said[@]} == 1 && ${said[0]} == 'vorpipe: '?*$'\n' ]] || fail "not one line 'vorpipe: ...' on standard error"
}

# mentions TEXT: standard error has it.
mentions() {
  local said
  mapfile said <log/err
  local IFS=
  [[ ${said[*]} == *"$1"* ]] || fail "the line does not say '$1'"
}

# What is in out/: which files there are, and when each was last changed.
outputs() { find out -type d -printf '%p %i\n' -o -printf '%p %i %s %C@\n'; }

# fails CODE NAME TEXT ARGUMENT...: ends with CODE and one line that has TEXT; out/ stays as it was.
fails() {
  local code=$1 text=$3
  name=$2
  shift 3
  cases=$((cases + 1))
  printf 'an older file' >out/old.png
  printf 'an older file' >out/old.npy
  printf 'an older file' >out/old.json
  printf 'an older file' >out/old.csv
  local before
  before=$(outputs)
  run "$code" "$@"
  one_line
  mentions "$text"
  [ -s log/out ] && fail "something on standard output"
  [ "$before" = "$(outputs)" ] || fail "the output folder changed"
}

# refuses NAME TEXT ARGUMENT...: render with these options is refused with exit code 2.
refuses() {
  local what=$1 text=$2
  shift 2
  fails 2 "$what" "$text" render -o out/old.png --ids out/old.npy --stats out/old.json --backend cpu "$@"
}

# refuses_file FILE TEXT: the sites of in/FILE are refused, and the line names the file.
refuses_file() {
  refuses "$1" "in/$1" --sites "in/$1"
  mentions "$2"
}

# succeeds NAME ARGUMENT...: ends with 0 and says nothing on standard error, but for how many sites have no cell, and,
# where the machine is slow, what a driver is busy with.
succeeds() {
  name=$1
  shift
  cases=$((cases + 1))
  run 0 "$@"
  local said line
  mapfile said <log/err
  for line in "${said[@]}"; do
    [[ $line =~ ^'vorpipe: note: '([0-9]*' of '[0-9]*' sites have no cell: '|'the driver of '.*' has been compiling the shader ') ]] ||
      fail "something on standard error"
  done
}

# notes NAME TEXT ARGUMENT...: ends with 0, and standard error is one line, a note that is TEXT.
notes() {
  local text=$2
  name=$1
  shift 2
  cases=$((cases + 1))
  run 0 "$@"
  local said
  mapfile said <log/err
  [[ ${#said[@]} == 1 && ${said[0]} == "vorpipe: note: $text"$'\n' ]] || fail "standard error is not the note '$text'"
}

expect() { grep -qF -- "$1" log/out || fail "standard output does not say '$1'"; }

rm -rf out && mkdir out

# skipped PART REASON: a part that cannot run here; ../skipped.sh counts it.
skipped() {
  echo "SKIPPED: $1: $2" >&2
  if [ -n "${VORPIPE_SKIPPED-}" ]; then
    printf '%s\t%s\t%s\n' "${VORPIPE_TEST_NAME-}" "$1" "$2" >>"$VORPIPE_SKIPPED" || fail "cannot write to $VORPIPE_SKIPPED"
  fi
}

# The backends that take --backend by a name of their own.
backends="cpu vulkan-geometry vulkan-compute opengl"
# The build says which Python: a machine may have several, of which not all have NumPy.
python=${VORPIPE_TEST_PYTHON:-python3}
has_numpy() { "$python" -c 'import numpy' 2>/dev/null; }

finish() {
  echo "$cases cases, $failures failures"
  [ "$failures" -eq 0 ]
}
