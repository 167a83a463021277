#!/usr/bin/env bash
# What --stats says, and `vorpipe rerun`, which does it again.
# Usage: rerun.sh VORPIPE
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

printf 'x,y\n0.2,0.3\n0.7,0.1\n0.4,0.8\n0.9,0.9\n' >in/sites.csv
printf '0\n0.01\n0\n0.02\n' >"in/the weights.txt"
printf 'POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))' >in/outline.wkt

# key FILE KEY: what follows "KEY": in a file of --stats, without blanks and lines' ends.
key() { tr -d ' \n' <"$1" | sed "s/.*\"$2\"://"; }

# -- What stands in --stats -----------------------------------------------------------------------------
succeeds "all that a run reads and writes" cells --backend cpu --threads 2 --search grid --sites in/sites.csv \
  --weights "in/the weights.txt" --domain in/outline.wkt -o out/a.csv -o out/a.npz --stats out/a.json
[[ $(key out/a.json arguments) == '["cells","--backend","cpu","--threads","2","--search","grid",'* ]] || fail "other arguments"
[[ $(tr -d ' \n' <out/a.json) == *'"search":"grid","threads":2,'* ]] || fail "another search, or other threads"
[[ $(key out/a.json choice) == null,* ]] || fail "the backend was named: there is no choice"
grep -qE '"revision": ("[0-9a-f]{12}|null)' out/a.json || fail "no revision"
for file in in/sites.csv "in/the weights.txt" in/outline.wkt out/a.csv out/a.npz; do
  [ "$(grep -A1 -F "\"path\": \"$file\"" out/a.json | grep -oE '[0-9]+,$')" = "$(wc -c <"$file")," ] || fail "the bytes of $file"
done
[ "$(grep -c '"path"' out/a.json)" -eq 5 ] || fail "not five files"
if command -v xxh128sum >/dev/null; then
  name="hashes are those of xxh128sum"
  cases=$((cases + 1))
  for file in in/sites.csv "in/the weights.txt" in/outline.wkt out/a.csv out/a.npz; do
    hash=$(xxh128sum <"$file" | cut -d' ' -f1)
    grep -A2 -F "\"path\": \"$file\"" out/a.json | grep -qF "\"xxh128\": \"$hash\"" || fail "not that of $file, $hash"
  done
else
  skipped "hashes are those of xxh128sum" "there is no xxh128sum"
fi
succeeds "why a backend was taken" render --sites random:9 --search flann --size 9x9 --quiet -o out/b.png --stats out/b.json
[[ $(key out/b.json choice) == '"autotook'* ]] || fail "it is not there"
grep -q '"search": "flann:30",' out/b.json || fail "another search"

run 0 cells --backend cpu --sites random:9 --stats in/told.json
succeeds "a run that wrote nothing else" rerun in/told.json

# -- The same bytes -------------------------------------------------------------------------------------
cp out/a.json in/a.json
cp out/a.npz in/a.npz
rm out/a.csv
succeeds "cells again" rerun out/a.json
expect "same bytes: out/a.csv, out/a.npz"
cmp -s out/a.npz in/a.npz || fail "they are not"
cmp -s out/a.json in/a.json || fail "the evidence has changed"
succeeds "cells again, quietly" rerun --quiet out/a.json
[ -s log/out ] && fail "not quiet"
succeeds "a picture" render --backend cpu --sites hex:50 --color area --size 30x30 -o out/c.png --ids out/c.npy --stats=out/c.json
succeeds "a picture again" rerun out/c.json
expect "same bytes: out/c.png, out/c.npy"
succeeds "a comparison" compare --backends cpu,vulkan-compute --sites random:50 --size 20x20 --report out/d.json -o out/d.png --stats out/e.json
succeeds "a comparison again" rerun out/e.json
expect "same bytes: out/d.json (but for times), out/d.png"
succeeds "a run without files" cells --backend cpu --sites random:50 --check --stats out/f.json
succeeds "a run without files, again" rerun out/f.json
expect "no files to compare"

again() { # again FILE CODE: runs out/g.json again with FILE as standard input
  name="standard input that is $1"
  cases=$((cases + 1))
  "$vorpipe" rerun out/g.json <"$1" >log/out 2>log/err
  code=$?
  [ "$code" -eq "$2" ] || fail "exit code $code, not $2"
}
cat in/sites.csv | "$vorpipe" cells --backend cpu --sites - -o out/g.csv --stats out/g.json >log/out 2>log/err
again in/sites.csv 0
expect "same bytes: out/g.csv"
cp out/g.csv in/g.csv
sed 2d in/sites.csv >in/fewer.csv
again in/fewer.csv 2
grep -qF "<stdin>: has changed since" log/err || fail "it is not told"
cmp -s out/g.csv in/g.csv || fail "the output has changed"

gzip -c in/sites.csv >in/sites.csv.gz
"$vorpipe" cells --backend cpu --sites - -o out/g.csv --stats out/g.json <in/sites.csv.gz >log/out 2>log/err
again in/sites.csv.gz 0
again in/sites.csv 2
succeeds "gzip" cells --backend cpu --sites in/sites.csv.gz -o out/h.csv --stats out/h.json
grep -A1 -F '"in/sites.csv.gz"' out/h.json | grep -qF "\"bytes\": $(wc -c <in/sites.csv.gz)," || fail "not its bytes"
succeeds "gzip again" rerun out/h.json

succeeds "the command line" rerun --dry-run out/a.json
[ "$(cat log/out)" = "vorpipe cells --backend cpu --threads 2 --search grid --sites in/sites.csv --weights 'in/the weights.txt' --domain in/outline.wkt -o out/a.csv -o out/a.npz" ] ||
  fail "it is not what was typed"
name="the command line, pasted"
cases=$((cases + 1))
line=$(cat log/out)
(vorpipe() { "$vorpipe" "$@"; } && eval "$line") >log/out 2>log/err || fail "exit code $?"
cmp -s out/a.npz in/a.npz || fail "other bytes"

printf '{"arguments": ["cells", "a\\u001b[2J\\u009b\\u0027\\\\ ö"], "inputs": [], "outputs": []}' >in/controls.json
name="the command line of a name with controls"
cases=$((cases + 1))
run 0 rerun --dry-run in/controls.json
[ "$(cat log/out)" = "vorpipe cells \$'a\\033[2J\\302\\233\\047\\134 \\303\\266'" ] || fail "it is not escaped"

# -- What differs ---------------------------------------------------------------------------------------
cp in/sites.csv in/before.csv
echo 0.5,0.5 >>in/sites.csv
fails 2 "an input that has changed" "in/sites.csv: has changed since the run that out/a.json tells of" rerun out/a.json
mv in/sites.csv in/moved.csv
fails 2 "an input that is gone" "in/sites.csv: cannot be read" rerun out/a.json
mv in/before.csv in/sites.csv

sed 's/"version": "[^"]*"/"version": "0.0.9"/; s/"device": ".*"/"device": "an abacus"/' out/a.json >in/other.json
name="another version and another device"
cases=$((cases + 1))
run 0 rerun in/other.json
grep -qxF "vorpipe: note: another version: 0.0.9 then, $("$vorpipe" --version | cut -d' ' -f2) now" log/err || fail "no note of the version"
grep -q "^vorpipe: note: another device: an abacus then, " log/err || fail "no note of the device"
[ "$(wc -l <log/err)" -eq 2 ] || fail "more than two notes"
run 0 rerun --quiet in/other.json
[ -s log/err ] && fail "not quiet"
hash=$(grep -A2 '"out/a.npz"' out/a.json | sed -n 's/.*"xxh128": "\(.*\)"/\1/p')
sed "s/$hash/00000000000000000000000000000000/" out/a.json >in/wrong.json
name="another output"
cases=$((cases + 1))
run 1 rerun in/wrong.json
one_line
grep -qF "out/a.npz: other bytes: " log/err || fail "the line does not name it"
grep -qF "out/a.csv" log/err && fail "the line names what is the same"

# -- Files that are no good -----------------------------------------------------------------------------
fails 2 "no file" "out/none.json: cannot be read" rerun out/none.json
fails 2 "no JSON" "in/sites.csv: is no JSON" rerun in/sites.csv
printf '[1]' >in/bad.json
fails 2 "no object" "in/bad.json: is no JSON object" rerun in/bad.json
printf '{"version": "0.1.0", "command": "cells", "sites": 9}' >in/bad.json
fails 2 "an older file" 'in/bad.json: has no "arguments": an older version wrote it' rerun in/bad.json
printf '{"arguments": ["cells", 7]}' >in/bad.json
fails 2 "arguments that are no texts" '"arguments" is no list of texts' rerun in/bad.json
printf '{"arguments": ["cells"], "inputs": []}' >in/bad.json
fails 2 "no outputs" 'has no list "outputs"' rerun in/bad.json
printf '{"arguments": ["cells"], "inputs": [{"path": "a"}], "outputs": []}' >in/bad.json
fails 2 "no hash" '"inputs", number 1: has no "path", "bytes" and "xxh128"' rerun in/bad.json
printf '{"arguments": ["rerun", "in/bad.json"], "inputs": [], "outputs": []}' >in/bad.json
fails 2 "itself" 'no subcommand "rerun" has --stats' rerun in/bad.json
printf '{"arguments": ["cells", "--sits", "random:9"], "inputs": [], "outputs": []}' >in/bad.json
fails 2 "arguments of another version" 'unknown option --sits; did you mean --sites?' rerun in/bad.json
printf '{"arguments": ["cells", "--sites", "random:9", "-o", "out/a\xef\xbf\xbd.csv"], "inputs": [], "outputs": []}' >in/bad.json
fails 2 "a name that JSON does not hold" "which was not UTF-8: run it by hand" rerun in/bad.json
fails 2 "no file of --stats" "STATS" rerun

finish
