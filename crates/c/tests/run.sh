#!/bin/sh
# Builds and runs the tests and the examples against a built library:
#   run.sh FOLDER    with libmediant.so and libmediant.a in it
# By gcc and by clang; with the sanitizers of addresses, of undefined behavior and of threads; by valgrind;
# with the static library. It says what is not there, and leaves it out. The library itself is not
# instrumented: the sanitizers watch the programs, and the memory that the library is given or gives.
set -eu
[ $# = 1 ] || { echo "usage: $0 FOLDER" >&2; exit 2; }
library=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
examples=$here/../examples
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LD_LIBRARY_PATH="$library${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"

c="-std=c11 -g -Wall -Wextra -Werror -pedantic"
cpp="-std=c++17 -g -Wall -Wextra -Werror -pedantic"
all="$here/all.c $here/queries.c $here/indexes.c $here/misuse.c"
link="-L$library -lmediant -lm -pthread"
static="$library/libmediant.a -lm -pthread -ldl -lrt -lutil"

has() {
  command -v "$1" >/dev/null 2>&1 || { echo "$1 is not here: $2"; return 1; }
}

# A folder in which nothing is.
empty() {
  rm -rf "$work/files"
  mkdir "$work/files"
  echo "$work/files"
}

# The tests by a compiler of C and one of C++.
tests() {
  "$1" $c $all $link -o "$work/all"
  "$work/all" "$(empty)"
  "$1" $c "$here/threads.c" $link -o "$work/threads"
  "$work/threads"
  "$2" $cpp "$here/all.cpp" $link -o "$work/allcpp"
  "$work/allcpp" "$(empty)"
  "$1" $c "$examples/path.c" "-I$here/../include" $link -o "$work/path"
  "$2" $cpp "$examples/path.cpp" "-I$here/../include" $link -o "$work/pathcpp"
  "$work/path" >"$work/of_c"
  "$work/pathcpp" >"$work/of_cpp"
  cmp "$examples/path.txt" "$work/of_c"
  cmp "$examples/path.txt" "$work/of_cpp"
  "$1" $c "$here/fault.c" $link -o "$work/fault"
  fault
  "$2" $cpp "$here/fault.cpp" $link -o "$work/fault"
  fault
}

# Rust tells each fault on stderr, too.
fault() {
  RUST_BACKTRACE=0 "$work/fault" 2>"$work/told" || { tail -n 5 "$work/told" >&2; exit 1; }
}

# The tests with sanitizers, by a compiler of C and one of C++ that have them.
sanitized() {
  echo 'int main(void) { return 0; }' >"$work/none.c"
  if "$1" -fsanitize=address,undefined "$work/none.c" -o "$work/none" 2>/dev/null && "$work/none"; then
    flags="-O1 -fsanitize=address,undefined -fno-sanitize-recover=all"
    "$1" $c $flags $all $link -o "$work/all"
    "$work/all" "$(empty)"
    "$2" $cpp $flags "$here/all.cpp" $link -o "$work/allcpp"
    "$work/allcpp" "$(empty)"
  else
    echo "$1 has no AddressSanitizer here: memory is left to valgrind"
  fi
  if "$1" -fsanitize=thread "$work/none.c" -o "$work/none" 2>/dev/null && "$work/none"; then
    "$1" $c -O1 -fsanitize=thread "$here/threads.c" $link -o "$work/threads"
    # It does not see the locks of the library, nor what they guard.
    TSAN_OPTIONS="ignore_noninstrumented_modules=1 halt_on_error=1" "$work/threads"
  else
    echo "$1 has no ThreadSanitizer here: threads are tested without it"
  fi
}

sh "$here/covered.sh"
sh "$here/exports.sh" "$library/libmediant.so"
echo "gcc"
has gcc "the tests by gcc are left out" && has g++ "the tests by gcc are left out" && tests gcc g++
echo "clang"
has clang "the tests by clang are left out" && has clang++ "the tests by clang are left out" && tests clang clang++
echo "sanitizers"
if has clang "gcc has the sanitizers"; then sanitized clang clang++; else sanitized gcc g++; fi

echo "the static library"
cc $c $all $static -o "$work/all"
"$work/all" "$(empty)"
cc $c "$here/fault.c" $static -o "$work/fault"
fault
echo "valgrind"
if has valgrind "leaks are left to mediant_objects"; then
  valgrind -q --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
    --error-exitcode=9 "$work/all" "$(empty)"
fi
echo "run.sh: all is as it should be"
