#!/usr/bin/env bash
# Golden id images: run.sh VORPIPE draws every scene on every backend and compares it with the ids in
# this folder, ties aside. run.sh VORPIPE --update draws them anew on the cpu backend.
set -u
vorpipe=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

scenes=(
  "random       --sites random:150 --seed 3"
  "square       --sites square:64"
  "hex          --sites hex:60"
  "clusters     --sites clusters:400 --seed 2"
  "circle       --sites circle:40"
  "outside      --sites $here/outside.csv --domain 0.4,0.4,0.6,0.5"
  "collinear    --sites $here/collinear.csv --domain 0,0,1,1"
  "duplicates   --sites $here/duplicates.csv --domain 0,0,1,1"
)

failed=0
for scene in "${scenes[@]}"; do
  read -r name options <<<"$scene"
  if [[ ${2-} == --update ]]; then
    "$vorpipe" render --backend cpu $options --size 72x60 --fit stretch --ids "$here/$name.npy" --quiet || exit 1
    continue
  fi
  for backend in cpu vulkan-compute vulkan-geometry opengl; do
    if "$vorpipe" render --backend $backend $options --size 72x60 --fit stretch --ids "$work/$name.npy" --quiet &&
       "$vorpipe" diff "$here/$name.npy" "$work/$name.npy" $options --fit stretch >"$work/said" 2>&1; then
      echo "ok      $name on $backend"
    else
      echo "FAILED  $name on $backend: $(cat "$work/said")"
      failed=$((failed + 1))
    fi
  done
done
echo "$failed golden pictures differ"
exit $((failed > 0))
