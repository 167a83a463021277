#!/usr/bin/env bash
# The seeds of the fuzzers, which lie in one archive: seeds.sh unpack FOLDER puts them into FOLDER/seeds;
# seeds.sh add TARGET FILE... adds files to a target's, named by the hashes of their bytes.
set -euo pipefail
archive=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)/seeds.tar.xz

# pack FOLDER: the same bytes for the same files, whoever packs them and when.
pack() {
  tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=a+r,u+w,go-w -C "$1" -c seeds | xz -9e -T1 >"$archive.new"
  mv "$archive.new" "$archive"
}

case ${1-} in
  unpack)
    rm -rf "$2/seeds"
    mkdir -p "$2"
    tar -C "$2" -xJf "$archive"
    ;;
  add)
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
    tar -C "$folder" -xJf "$archive"
    [[ -d $folder/seeds/${2-} ]] || { printf 'seeds.sh: no target "%s"\n' "${2-}" >&2; exit 2; }
    for file in "${@:3}"; do cp "$file" "$folder/seeds/$2/$(sha1sum <"$file" | cut -c1-40)"; done
    pack "$folder"
    ;;
  *)
    printf 'usage: seeds.sh unpack FOLDER | seeds.sh add TARGET FILE...\n' >&2
    exit 2
    ;;
esac
