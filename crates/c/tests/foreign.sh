#!/bin/sh
# The examples in Go and C#, against a built library:
#   foreign.sh FOLDER    with libmediant.so in it
# Go needs golang-go, C# mono-mcs and mono-runtime. It says what is not there, and leaves it out.
set -eu
[ $# = 1 ] || { echo "usage: $0 FOLDER" >&2; exit 2; }
library=$(cd "$1" && pwd)
tests=$(cd "$(dirname "$0")" && pwd)
examples=$tests/../examples
include=$tests/../include
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LD_LIBRARY_PATH="$library${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"

has() {
  command -v "$1" >/dev/null 2>&1 || { echo "$1 is not here: the example in $2 is left out"; return 1; }
}

if has go Go; then
  CGO_CFLAGS="-I$include" CGO_LDFLAGS="-L$library -lmediant" GOCACHE=$work/cache GO111MODULE=off \
    go build -o "$work/path" "$examples/path.go"
  "$work/path" >"$work/said"
  cmp "$examples/path.txt" "$work/said"
  echo "Go: as in C"
fi
if has mcs 'C#' && has mono 'C#'; then
  mcs -nologo -warnaserror "-out:$work/path.exe" "$examples/Path.cs"
  mono "$work/path.exe" >"$work/said"
  cmp "$examples/path.txt" "$work/said"
  echo "C#: as in C"
  mcs -nologo -warnaserror "-out:$work/unity.exe" "$examples/unity/MediantGrid.cs" "$tests/unity.cs"
  mono "$work/unity.exe"
fi
echo "foreign.sh: all is as it should be"
