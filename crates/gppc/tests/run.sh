#!/bin/sh
# Tests the entries of the classic and the any-angle track, as `cargo xtask gppc --into FOLDER` wrote them:
#   run.sh FOLDER [MAPS [SEED]]
# They are compiled by the rules of the kits, with declarations in the place of a kit's.
set -eu
[ $# -ge 1 ] || { echo "usage: $0 FOLDER [MAPS [SEED]]" >&2; exit 2; }
entries=$(cd "$1" && pwd)
maps=${2:-100}
seed=${3:-41}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
strict="-std=c++17 -g -O1 -Wall -Wextra -Werror -pedantic"

# test_of TRACK FLAG…
test_of() {
  track=$1
  shift
  folder=$entries/$track
  ${CXX:-g++} $strict "$@" -I "$here" -I "$folder" "$here/entries.cpp" "$folder/Entry.cpp" \
    "$folder/libmediant.a" -lpthread -ldl -lm -o "$work/$track"
  mkdir -p "$work/files"
  if ! "$work/$track" "$work/files" "$maps" "$seed" 2>"$work/said"; then
    grep -v 'searching without an index' "$work/said" >&2
    exit 1
  fi
}

echo "classic"
test_of classic
echo "any-angle"
test_of any-angle -DANY_ANGLE
