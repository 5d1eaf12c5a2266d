#!/bin/sh
# A shared library exports the functions of mediant.h and nothing else, and needs nothing but the C library:
#   exports.sh libmediant.so [VERSION]    with this version at each symbol
set -eu
library=$1
version=${2:+@@$2}
header=$(cd "$(dirname "$0")/../include" && pwd)/mediant.h
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

grep -o '\bmediant_[a-z_]*(' "$header" | tr -d '(' | sort -u | sed "s/\$/$version/" >"$work/declared"
# The version itself is a symbol, too.
nm -D --defined-only "$library" | awk '$2 != "A" { print $3 }' | sort >"$work/exported"
diff "$work/declared" "$work/exported" || { echo "$library: > is exported, and not in mediant.h" >&2; exit 1; }

# Parts of glibc.
others=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
  grep -Ev '^(libc|libm|libdl|libpthread|librt|libutil|ld-linux.*)\.so\.[0-9]$' || :)
[ -z "$others" ] || { echo "$library needs $others" >&2; exit 1; }
echo "exports.sh: $(wc -l <"$work/exported") functions, and only the C library is needed: ${library##*/}"
