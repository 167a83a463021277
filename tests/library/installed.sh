# The library as it is installed, into a prefix that is not the system's: programs of C99 and C++17 find it by CMake
# and by pkg-config, compile without a warning, and run. $1 is cmake, $2 vorpipe's build, $3 docs/examples, $4 $5 the
# compilers.
set -eu
cmake=$1 build=$2 examples=$3 cc=$4 cxx=$5
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
DESTDIR= "$cmake" --install "$build" --prefix "$work/there" --component library >log
DESTDIR= "$cmake" --install "$build" --prefix "$work/there" --component development >>log
# Where it is built is not where it stays.
mv there elsewhere
prefix=$work/elsewhere

runs() {
  "$1" >out || { echo "$1 fails"; exit 1; }
  grep -q "$2" out || { echo "$1 does not say '$2':"; cat out; exit 1; }
}

"$cmake" -G Ninja -S "$here/consumer" -B by_cmake -DCMAKE_PREFIX_PATH="$prefix" -Dexamples="$examples" \
  -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" >>log 2>&1 || { cat log; exit 1; }
"$cmake" --build by_cmake >>log 2>&1 || { cat log; exit 1; }
runs by_cmake/cells_c '^cell 999: area '
[ -s cells.svg ]
runs by_cmake/wrapper_cpp 'of the square'

if command -v pkg-config >/dev/null; then
  PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name vorpipe.pc)")
  export PKG_CONFIG_PATH
  flags=$(pkg-config --cflags vorpipe) libraries=$(pkg-config --libs vorpipe)
  case $flags in *"$prefix"*) ;; *) echo "pkg-config: $flags is not in the prefix"; exit 1 ;; esac
  folder=$(pkg-config --variable=libdir vorpipe)
  "$cc" -std=c99 -Wall -Wextra -pedantic -Werror $flags "$examples/cells.c" -o by_pkg_c $libraries -Wl,-rpath,"$folder"
  "$cxx" -std=c++17 -Wall -Wextra -pedantic -Werror $flags "$examples/wrapper.cpp" -o by_pkg_cpp $libraries \
    -Wl,-rpath,"$folder"
  runs ./by_pkg_c '^cell 999: area '
  runs ./by_pkg_cpp 'of the square'
else
  exec sh "$here/../skip.sh" "pkg-config is not there"
fi
