#!/bin/sh
# The library itself, watched by tools of nightly Rust, while its tests and mistaken calls run:
#   sanitized.sh address [CALLS]   AddressSanitizer and LeakSanitizer: memory that is not there, or forgotten
#   sanitized.sh thread [CALLS]    ThreadSanitizer; it compiles the standard library, too (rust-src)
#   sanitized.sh miri [CALLS]      Miri: undefined behavior of any kind, a thousand times as slow
# It says what cannot be had, and leaves it out. `run.sh` watches programs of C, and not the library.
set -eu
tool=${1:-}
case $tool in
  address) calls=${2:-100000} ;;
  thread) calls=${2:-20000} ;;
  miri) calls=${2:-200} ;;
  *) echo "usage: $0 address|thread|miri [CALLS]" >&2; exit 2 ;;
esac
cd "$(dirname "$0")/../../.."
export MEDIANT_CALLS="$calls" CARGO_INCREMENTAL=0

leave_out() {
  echo "sanitized.sh $tool: $1 cannot be had here: left out"
  exit 0
}

# A component of nightly Rust.
component() {
  rustup component add "$1" --toolchain nightly >/dev/null 2>&1 || leave_out "$1 of nightly Rust"
}

cargo +nightly --version >/dev/null 2>&1 || leave_out "nightly Rust"
host=$(rustc +nightly -vV | sed -n 's/^host: //p')
case $tool in
  address)
    export RUSTFLAGS="-Zsanitizer=address" ASAN_OPTIONS="detect_leaks=1"
    cargo +nightly test --target "$host" -p mediant-c --lib -- --skip header --skip calls
    ;;
  thread)
    component rust-src
    export RUSTFLAGS="-Zsanitizer=thread"
    cargo +nightly test -Zbuild-std --target "$host" -p mediant-c --lib -- --skip header --skip calls
    ;;
  miri)
    component miri
    component rust-src
    # By the stricter rules, stacked borrows, it refuses how the library `bitvec` makes pointers to bits. The
    # header is written from files, which it cannot read.
    # The threads of rayon end with the program.
    export MIRIFLAGS="-Zmiri-tree-borrows -Zmiri-permissive-provenance -Zmiri-ignore-leaks"
    export MIRIFLAGS="$MIRIFLAGS -Zmiri-env-forward=MEDIANT_CALLS -Zmiri-env-forward=MEDIANT_SEED"
    cargo +nightly miri test -p mediant-c --lib -- --skip header --skip calls
    ;;
esac
echo "sanitized.sh $tool: all is as it should be, $calls calls"
