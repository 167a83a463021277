#!/usr/bin/env bash
# Whether the pictures of docs/gallery are what docs/gallery.sh draws: gallery.sh VORPIPE. Pixels are compared, not
# bytes, and what streams of a PDF hold, because another zlib packs them in another way. Of the film the last picture is
# compared, which is the same with fewer before it.
set -u
vorpipe=$(realpath "$1") || exit 1
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
drawn=$(mktemp -d) || exit 1
trap 'rm -rf "$drawn"' EXIT

"$root/docs/gallery.sh" --program "$vorpipe" --into "$drawn" --film 40 >/dev/null || {
  echo "FAILED: docs/gallery.sh ends with $?" >&2
  exit 1
}
# same COMMITTED DRAWN: says how they differ.
same() {
  case $1 in
    *.png) "$vorpipe" diff "$1" "$2" 2>&1 ;;
    *.pdf) "${VORPIPE_TEST_PYTHON:-python3}" "$root/tests/docs/same_pdf.py" "$1" "$2" ;;
    *) cmp "$1" "$2" 2>&1 ;;
  esac
}
failed=0
for name in $(ls "$drawn" "$root/docs/gallery" | grep -E '\.(png|svg|pdf)$' | sort -u); do
  if ! [[ -f $root/docs/gallery/$name ]]; then
    echo "FAILED: $name is drawn, and docs/gallery does not have it" >&2
  elif ! [[ -f $drawn/$name ]]; then
    echo "FAILED: docs/gallery has $name, and docs/gallery.sh does not draw it" >&2
  elif ! said=$(same "$root/docs/gallery/$name" "$drawn/$name"); then
    echo "FAILED: ${said//$drawn\//}" >&2
  elif ! grep -qF "gallery/$name" "$root/docs/gallery.md"; then
    echo "FAILED: docs/gallery.md does not show $name" >&2
  else
    continue
  fi
  failed=$((failed + 1))
done
echo "$(ls "$drawn" | wc -l) pictures drawn, $failed failures"
exit $((failed > 0))
