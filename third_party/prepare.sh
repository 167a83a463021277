# Installs and builds for ./run and ./test, which source this file with `root` set.
# Nothing is written to standard output: it belongs to the program that runs afterwards.

# On a terminal only, so that standard error holds nothing but errors elsewhere.
note() {
  if [[ -t 2 ]]; then printf '%s\n' "$*" >&2; fi
}

# packagesOf column role...: the names in a column of README.md's table, one per line.
# Columns: 6 Debian, 7 Fedora, 8 Arch, 9 Homebrew.
packagesOf() {
  local column=$1 name role
  shift
  local -a cells
  while IFS='|' read -r -a cells; do
    name=${cells[1]// /} role=${cells[2]// /}
    if [[ ${#cells[@]} -ge 10 && $name =~ ^[a-z0-9-]+$ && " $* " == *" $role "* ]]; then
      printf '%s\n' ${cells[column]}
    fi
  done <"$root/third_party/README.md"
}

# installPackages role...: installs with apt what is missing, and waits where another one installs. A failure is not
# the end: the configure step names what it cannot do without.
installPackages() {
  command -v apt-get >/dev/null && command -v dpkg-query >/dev/null || return 0
  local wanted installed package
  local -a missing=() as_root=()
  wanted=$(packagesOf 6 "$@")
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null)
  for package in $wanted; do
    if [[ $'\n'$installed$'\n' != *$'\n'"$package installed"$'\n'* ]]; then missing+=("$package"); fi
  done
  if [[ ${#missing[@]} == 0 ]]; then return 0; fi
  if [[ $(id -u) != 0 ]]; then
    if ! command -v sudo >/dev/null; then
      printf 'vorpipe: missing packages and no sudo; as root: apt-get install %s\n' "${missing[*]}" >&2
      return 0
    fi
    as_root=(sudo)
  fi
  note "vorpipe: installing ${missing[*]}"
  packages_changed=1
  local log=$root/build/packages.$1.log
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600)
  "${apt[@]}" update >"$log" 2>&1
  if ! "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
    # One package that this release does not have must not keep the others out.
    for package in "${missing[@]}"; do
      "${apt[@]}" install -y --no-install-recommends "$package" >>"$log" 2>&1 ||
        printf 'vorpipe: could not install %s, see %s\n' "$package" "${log#"$root/"}" >&2
    done
  fi
}

# unpackDriver: the Vulkan driver SwiftShader in build/swiftshader, out of a package that apt downloads and verifies. Its
# failure is the log's to tell: tests that need the driver are skipped without it, and say so.
unpackDriver() {
  local to=$root/build/swiftshader folder=./usr/lib/chromium scratch
  [[ ! -e $to ]] || return 0
  command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || return 0
  scratch=$(mktemp -d "$root/build/unpacked.XXXXXX") || return 0
  (
    set -o pipefail
    cd "$scratch" || exit
    apt-get -q download "$(packagesOf 6 unpacked)" ||
      { [[ $(id -u) == 0 ]] && apt-get -q update && apt-get -q download "$(packagesOf 6 unpacked)"; } || exit
    dpkg-deb --fsys-tarfile ./*.deb | tar -x "$folder/libvk_swiftshader.so" "$folder/vk_swiftshader_icd.json" || exit
    # At once: somebody else may be doing the same.
    mv -T "$folder" "$to"
  ) >"$root/build/packages.unpacked.log" 2>&1
  rm -rf "$scratch"
}

# Names the packages without which not even the configure step can say what is missing.
requireTools() {
  local tool
  for tool in cmake ninja c++; do
    if ! command -v "$tool" >/dev/null; then
      {
        printf 'vorpipe: %s is missing. Packages for the build:\n' "$tool"
        printf '  Debian, Ubuntu: apt-get install %s\n' "$(packagesOf 6 tool build test program python shader driver | xargs)"
        printf '  Fedora: dnf install %s\n' "$(packagesOf 7 tool build test program python shader driver | xargs)"
        printf '  Arch: pacman -S %s\n' "$(packagesOf 8 tool build test program python shader driver | xargs)"
        printf '  Homebrew: brew install %s\n' "$(packagesOf 9 tool build test program python shader driver | xargs)"
      } >&2
      return 1
    fi
  done
}

# buildPreset preset target...: configures when needed, which it is as well where packages came just now, and
# builds. Its output goes to build/<preset>.log, and to standard error when something failed.
buildPreset() {
  local preset=$1 dir=$root/build/$1 log=$root/build/$1.log
  shift
  requireTools || return
  if [[ ! -f $dir/build.ninja ]] || ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$dir/CMakeCache.txt"; then
    note "vorpipe: building in build/$preset; the first time this takes a few minutes"
    cmake -S "$root" --preset "$preset" --fresh >"$log" 2>&1 || { cat "$log" >&2; return 1; }
  elif [[ -n ${packages_changed-} ]]; then
    cmake -S "$root" --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; return 1; }
  fi
  NINJA_STATUS='[%f/%t] ' ninja -C "$dir" "$@" 2>&1 | tee "$log" | showProgress
  [[ ${PIPESTATUS[0]} == 0 ]] || { cat "$log" >&2; return 1; }
}

# On a terminal, one line that says how far ninja is, and nothing once it is done.
showProgress() {
  if [[ ! -t 2 ]]; then cat >/dev/null; return; fi
  local line shown=
  while IFS= read -r line; do
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\  ]]; then
      printf '\r\033[K[%*d/%d] building' ${#BASH_REMATCH[2]} "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" >&2
      shown=1
    fi
  done
  if [[ -n $shown ]]; then printf '\r\033[K' >&2; fi
}

# Two commands at once build one after the other.
lockBuild() {
  mkdir -p "$root/build"
  if command -v flock >/dev/null; then
    exec {build_lock}>"$root/build/.lock"
    flock "$build_lock"
  fi
}

unlockBuild() {
  if [[ -n ${build_lock-} ]]; then exec {build_lock}>&-; fi
}
