#!/bin/sh
# Installs the library into an empty folder and uses it from there: by pkg-config and by CMake, shared and
# static; once more after the folder was moved; and with a header of another interface.
#   installed.sh [FOLDER]    with libmediant.a in it; without, it is built
set -eu
built=${1:+--built $(cd "$1" && pwd)}
here=$(cd "$(dirname "$0")" && pwd)
examples=$here/../examples
root=$(cd "$here/../../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$root/Cargo.toml" | head -n 1)
interface=${version%.*}

fails() {
  echo "installed.sh: $1" >&2
  exit 1
}

has() {
  command -v "$1" >/dev/null 2>&1 || { echo "$1 is not here: $2"; return 1; }
}

# install_to OPTION…: what the README says.
install_to() {
  (cd "$root" && cargo xtask c $built "$@") >"$work/log" 2>&1 || { cat "$work/log" >&2; fails "cargo xtask c $*"; }
}

# says COMMAND…: it prints the path.
says() {
  "$@" >"$work/said" || fails "$* ended with $?"
  cmp "$examples/path.txt" "$work/said"
}

by_pkg_config() {
  PKG_CONFIG_PATH=$1/lib/pkgconfig
  export PKG_CONFIG_PATH
  cc $(pkg-config --cflags mediant) "$examples/path.c" $(pkg-config --libs mediant) -o "$work/path"
  says env "LD_LIBRARY_PATH=$1/lib" "$work/path"
  readelf -V "$work/path" | grep -q "MEDIANT_$interface" || fails "a program knows no version of the symbols"
  c++ -std=c++17 $(pkg-config --cflags mediant) "$examples/path.cpp" $(pkg-config --libs mediant) -o "$work/path"
  says env "LD_LIBRARY_PATH=$1/lib" "$work/path"
  # The library alone static, then all of the program.
  static="$(pkg-config --variable=libdir mediant)/libmediant.a"
  cc $(pkg-config --cflags mediant) "$examples/path.c" "$static" -lm -o "$work/path"
  says "$work/path"
  c++ -std=c++17 $(pkg-config --cflags mediant) "$examples/path.cpp" "$static" -lm -o "$work/path"
  says "$work/path"
  # The linker warns of functions that look up names of the network and of users: nothing here calls them.
  cc -static $(pkg-config --cflags mediant) "$examples/path.c" $(pkg-config --static --libs mediant) \
    -o "$work/path" 2>"$work/log" || { cat "$work/log" >&2; fails "a static program"; }
  says "$work/path"
  [ "$(pkg-config --modversion mediant)" = "$version" ] || fails "mediant.pc is not of version $version"
}

# The programs of the guide's page, which say what they print.
of_guide() {
  PKG_CONFIG_PATH=$1/lib/pkgconfig
  export PKG_CONFIG_PATH
  for language in c cpp; do
    awk -v begin="\`\`\`$language" '$0 == begin { on = 1; next } /^```/ { on = 0 } on' \
      "$root/docs/guide/src/start/c.md" >"$work/first.$language"
    [ -s "$work/first.$language" ] || fails "the guide has no program in $language"
  done
  cc "$work/first.c" $(pkg-config --cflags --libs mediant) -o "$work/first-c"
  c++ -std=c++17 "$work/first.cpp" $(pkg-config --cflags --libs mediant) -o "$work/first-cpp"
  for program in first-c first-cpp; do
    LD_LIBRARY_PATH=$1/lib "$work/$program" >"$work/said" || fails "$program of the guide ended with $?"
    grep -qx '3 points, length 6.513' "$work/said" || fails "$program of the guide prints $(cat "$work/said")"
  done
}

by_cmake() {
  rm -rf "$work/build"
  { cmake -S "$examples/cmake" -B "$work/build" "-DCMAKE_PREFIX_PATH=$1" && cmake --build "$work/build"; } \
    >"$work/log" 2>&1 || { cat "$work/log" >&2; fails "the example by CMake"; }
  says "$work/build/path"
  says "$work/build/path_cpp"
  for program in path_static path_cpp_static; do
    says "$work/build/$program"
    ! readelf -d "$work/build/$program" | grep -q libmediant || fails "$program is not static"
  done
  # A program that asks for another interface gets none.
  mkdir -p "$work/other"
  printf '%s\n' 'cmake_minimum_required(VERSION 3.16)' 'project(other C)' 'find_package(Mediant 0.0 REQUIRED)' \
    >"$work/other/CMakeLists.txt"
  ! cmake -S "$work/other" -B "$work/other" "-DCMAKE_PREFIX_PATH=$1" >/dev/null 2>&1 ||
    fails "CMake takes $version for 0.0"
}

used_in() {
  ! has pkg-config "programs are not built by it" || by_pkg_config "$1"
  ! has cmake "programs are not built by it" || by_cmake "$1"
}

# A program that was compiled with a header of another interface says so, and does nothing.
mismatched() {
  cp -r "$1/include" "$work/later"
  sed -i 's/^#define MEDIANT_INTERFACE .*/#define MEDIANT_INTERFACE 4711/' "$work/later/mediant.h"
  c++ -std=c++17 "-I$work/later" "$examples/path.cpp" "-L$1/lib" -lmediant -o "$work/path"
  ! LD_LIBRARY_PATH=$1/lib "$work/path" 2>"$work/said" || fails "a program of another interface goes on"
  grep -q 'the library has the interface [0-9]*; the program was compiled against 4711' "$work/said" ||
    fails "a program of another interface says: $(cat "$work/said")"
}

# Nothing but what is named here.
files() {
  (cd "$1" && find . ! -type d | sort) >"$work/files"
  diff - "$work/files" <<END || fails "< is missing, > is too much"
./include/mediant.h
./include/mediant.hpp
./include/mediant/planners.hpp
./include/mediant/spaces.hpp
./include/mediant/values.hpp
./$2/cmake/Mediant/MediantConfig.cmake
./$2/cmake/Mediant/MediantConfigVersion.cmake
./$2/libmediant.a
./$2/libmediant.so
./$2/libmediant.so.$interface
./$2/libmediant.so.$version
./$2/pkgconfig/mediant.pc
END
}

install_to --prefix "$work/first"
files "$work/first" lib
sh "$here/exports.sh" "$work/first/lib/libmediant.so" "MEDIANT_$interface"
readelf -d "$work/first/lib/libmediant.so" | grep -q "SONAME.*\[libmediant.so.$interface\]" || fails "the SONAME"
used_in "$work/first"
! has pkg-config "the guide's programs are not built" || of_guide "$work/first"
mismatched "$work/first"

# It may be moved.
mv "$work/first" "$work/moved"
used_in "$work/moved"

# As packagers do, over an older one.
export DESTDIR="$work/package"
install_to --prefix /usr --libdir lib/some-machine
install_to --prefix /usr --libdir lib/some-machine
unset DESTDIR
files "$work/package/usr" lib/some-machine
grep -q 'prefix=${pcfiledir}/../../..$' "$work/package/usr/lib/some-machine/pkgconfig/mediant.pc" ||
  fails "mediant.pc leads elsewhere"
echo "installed.sh: all is as it should be"
