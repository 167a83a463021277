# What the library shows is what symbols.txt lists: names that vanish break programs, and names that nobody meant to
# show must be kept for ever. $1 is nm, $2 the library.
here=$(dirname "$0")
"$1" -D --defined-only "$2" | awk '{ print $3 }' | LC_ALL=C sort >shown.txt
[ -s shown.txt ] || { echo "$2 shows nothing"; exit 1; }
diff "$here/symbols.txt" shown.txt || { echo "$2 does not show what tests/library/symbols.txt lists"; exit 1; }
! grep -v '^vorpipe_' shown.txt
