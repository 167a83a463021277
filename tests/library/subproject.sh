# vorpipe as a part of another project: it can be configured, and brings no tests and no install rules along. (To build
# it takes minutes.) $1 is cmake, $2 vorpipe's tree.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" -G Ninja -S "$(dirname "$0")/subproject" -B "$work" -Dvorpipe="$2" >"$work.log" 2>&1 || { cat "$work.log"; exit 1; }
rm "$work.log"
"$1" --build "$work" --target help >"$work/targets"
grep -q '^of_tree: ' "$work/targets" && grep -q '^of_library: ' "$work/targets"
"$1" --install "$work" --prefix "$work/installed" >"$work/installing"
[ ! -e "$work/installed" ]
