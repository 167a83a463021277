#!/usr/bin/env bash
# Tries ./run, ./test and the packages in new roots of Debian's releases, as those who have just cloned the tree do.
# Usage, as root: tests/debian.sh [--keep] [--ccache] [RELEASE...]; without names bookworm (12) and trixie (13).
# debootstrap makes the roots in build/debian, from where apt has its packages here; logs lie beside them. What is cloned
# is HEAD. --keep goes on in roots that are there, to look after a mend; --ccache shares this machine's compiler cache.
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit

fail() {
  printf 'debian.sh: %s\n' "$*" >&2
  exit 3
}

cache='' keep=''
while [[ ${1-} == --* ]]; do
  case $1 in
    --ccache) cache=$(ccache --get-config cache_dir) || fail 'there is no ccache' ;;
    --keep) keep=1 ;;
    *) fail "$1: known are --keep and --ccache" ;;
  esac
  shift
done
if [[ $# == 0 ]]; then set -- bookworm trixie; fi
[[ $(id -u) == 0 ]] || fail 'roots are made by root'
for tool in debootstrap unshare git; do
  command -v "$tool" >/dev/null || fail "$tool is missing"
done

# From where apt has packages with that label here.
mirrorOf() {
  apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' | sed -n "s/^$1 //p" | head -1
}
mirror=$(mirrorOf Debian)
security=$(mirrorOf Debian-Security)
[[ -n $mirror ]] || fail 'apt has no packages of Debian here'
work=$root/build/debian
mkdir -p "$work"

# makeRoots RELEASE: as small as debootstrap makes them, without git; one to build in, and one for what was built.
makeRoots() {
  local release=$1 to=$work/$1 with=()
  if [[ -n $keep && -d $to && -d $to.new ]]; then return; fi
  rm -rf --one-file-system "$to" "$to.new"
  [[ $mirror != https:* ]] || with=(--include=ca-certificates)
  debootstrap --variant=minbase "${with[@]}" "$release" "$to" "$mirror" || return
  {
    printf "deb $mirror %s main\n" "$release" "$release-updates"
    [[ -z $security ]] || printf 'deb %s %s-security main\n' "$security" "$release"
  } >"$to/etc/apt/sources.list"
  apt-config dump | grep -E '^Acquire::(Check-|https?::|Retries)' >"$to/etc/apt/apt.conf.d/99host"
  cp /etc/resolv.conf /etc/hosts "$to/etc/"
  inRoot "$to" apt-get -q update || return
  if [[ -n $cache ]]; then inRoot "$to" apt-get -q install -y --no-install-recommends ccache || return; fi
  cp -a "$to" "$to.new"
}

cloneTree() {
  if [[ ! -d $1/vorpipe ]]; then
    git clone --depth 1 "file://$root" "$1/vorpipe"
  else
    git -C "$1/vorpipe" fetch --depth 1 "file://$root" HEAD && git -C "$1/vorpipe" reset --hard FETCH_HEAD
  fi
}

# inRoot FOLDER COMMAND...: runs it there, with an environment of its own. What it mounts and starts ends with it.
inRoot() {
  local to=$1 kept=()
  shift
  local name
  for name in http_proxy https_proxy no_proxy; do
    if [[ -n ${!name-} ]]; then kept+=("$name=${!name}"); fi
  done
  [[ -z $cache ]] || kept+=(CCACHE_DIR=/ccache CCACHE_BASEDIR=/vorpipe)
  CACHE=$cache unshare --mount --pid --fork --kill-child sh -ec '
    mount -t proc proc "$0/proc"
    mount --rbind /sys "$0/sys"
    mount --rbind /dev "$0/dev"
    if [ -n "$CACHE" ]; then
      mkdir -p "$0/ccache"
      mount --bind "$CACHE" "$0/ccache"
    fi
    exec chroot "$0" env -i "$@"' "$to" HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin "${kept[@]}" "$@"
}

# step RELEASE NAME COMMAND...: a line that says whether it went well, how long it took, and what the tests say at their end.
failures=0
step() {
  local release=$1 name=$2 log=$work/$1.$2.log begin=$SECONDS result=ok code
  shift 2
  "$@" >"$log" 2>&1
  code=$?
  [[ $code == 0 ]] || result="FAILED with $code, see ${log#"$root/"}"
  printf '%-10s %-8s %5d s  %s\n' "$release" "$name" $((SECONDS - begin)) "$result"
  sed -n '/^test: /,$p' "$log"
  [[ $code == 0 ]] || failures=$((failures + 1))
  return $code
}

# What ./run writes to standard error is a fault: nothing that a release lacks or the build says belongs to users.
firstRun() {
  inRoot "$1" sh -ec 'mkdir -p /tmp/first && cd /tmp/first && /vorpipe/run 2>said || true; cat said; test -s voronoi.png; test ! -s said'
}

# runOf PROGRAM: checks cells, in a root where nothing was built.
runOf() {
  inRoot "$new" sh -ec '"$0" --version && "$0" cells --sites clusters:2000 --check -o /tmp/cells.npz && "$0" selftest --quick --backend cpu' "$1"
}

tryArchive() {
  tar -C "$new/opt" -xJf "$built"/vorpipe-*.tar.xz && runOf "$(cd "$new" && printf '/%s' opt/vorpipe-*/bin/vorpipe)"
}

# Of Debian the wheel takes Python and a driver, which brings Vulkan's loader.
tryWheel() {
  cp "$built"/vorpipe-*.whl "$root/tests/python/installed.py" "$new/tmp/" &&
    inRoot "$new" sh -ec 'DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends python3-venv mesa-vulkan-drivers
      python3 -m venv /tmp/venv
      /tmp/venv/bin/pip install --no-index /tmp/vorpipe-*.whl
      cd /tmp
      VK_DRIVER_FILES=$(echo /usr/share/vulkan/icd.d/lvp*) /tmp/venv/bin/python installed.py vulkan-compute vulkan-geometry'
}

tryDeb() {
  cp "$built"/*.deb "$new/tmp/" &&
    inRoot "$new" sh -ec 'DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends /tmp/*.deb' &&
    runOf /usr/bin/vorpipe
}

for release in "$@"; do
  to=$work/$release new=$work/$release.new built=$work/$release/vorpipe/build/packages
  step "$release" roots makeRoots "$release" || continue
  step "$release" clone cloneTree "$to" || continue
  step "$release" run firstRun "$to"
  step "$release" test inRoot "$to" /vorpipe/test
  step "$release" packages inRoot "$to" /vorpipe/src/package/make || continue
  step "$release" archive tryArchive
  step "$release" wheel tryWheel
  step "$release" deb tryDeb
done
exit $((failures > 0))
