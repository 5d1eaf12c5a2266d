#!/bin/sh
# Each function of mediant.h is called in the tests in C, and is used by mediant.hpp.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
include=$here/../include
functions=$(grep -o '\bmediant_[a-z_]*(' "$include/mediant.h" | tr -d '(' | sort -u)
missing=0
for function in $functions; do
  if ! grep -q "\b$function(" "$here/all.c" "$here/queries.c" "$here/indexes.c" "$here/misuse.c"; then
    echo "$function: not called by the tests in C" >&2
    missing=1
  fi
  # In C++ a function may be an argument of a template, as those that free are.
  if ! grep -q "\b$function\b" "$include"/mediant/*.hpp; then
    echo "$function: not in mediant.hpp" >&2
    missing=1
  fi
done
[ "$missing" = 0 ]
echo "covered.sh: $(echo "$functions" | wc -l) functions are tested in C, and are in mediant.hpp"
