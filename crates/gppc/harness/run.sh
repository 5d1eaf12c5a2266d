#!/usr/bin/env bash
# Builds the harness by g++ and by clang++ (with the sanitizers, if it has them), runs its tests, and then
# runs the entries in a folder:
#   run.sh [FOLDER] [--long] [--dynamic FOLDER] [--maps FOLDER] [--costs FOLDER]
# FOLDER is as `cargo xtask gppc --into FOLDER` makes it. --dynamic has scenarios of version 2, --maps has maps
# of MovingAI beside their scenarios, --costs has tables of any-angle lengths, `any-closed-NAME.csv`. Without
# --long there are small maps alone; with it 10,000 queries on generated timelines, and every map.
set -euo pipefail

fail() { echo "run.sh: $*" >&2 && exit 2; }
folder() { cd "$1" && pwd; }

entries='' dynamic='' maps='' costs='' long=
while [ $# -gt 0 ]; do
    case $1 in
    --long) long=1 ;;
    --dynamic | --maps | --costs)
        [ $# -gt 1 ] || fail "$1 needs a folder"
        folder=$(folder "$2")
        case $1 in
        --dynamic) dynamic=$folder ;;
        --maps) maps=$folder ;;
        --costs) costs=$folder ;;
        esac
        shift
        ;;
    -*) fail "the option $1 is unknown" ;;
    *) entries=$(folder "$1") ;;
    esac
    shift
done
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
seed=${SEED:-1}

has() { command -v "$1" >/dev/null 2>&1 || { echo "$1 is not here: its part is left out" && return 1; }; }

# finds FAULT REASON PROGRAM…: an entry with the fault is found to be wrong, for that reason.
finds() {
    local fault=$1 reason=$2 code=0
    shift 2
    GPPC_FAULT=$fault "$@" >"$work/out" 2>&1 || code=$?
    if [ "$code" != 1 ] || ! grep -q "$reason" "$work/out"; then
        cat "$work/out"
        echo "run.sh: the fault '$fault' was not found for the reason '$reason': code $code of $*" >&2
        exit 1
    fi
}

# passes FAULT PROGRAM…: nothing is wrong, or what was asked for is no fault.
passes() {
    local fault=$1
    shift
    if ! GPPC_FAULT=$fault "$@" >"$work/out" 2>&1; then
        cat "$work/out"
        echo "run.sh: a right entry, '$fault', was found wrong: $*" >&2
        exit 1
    fi
}

# The tests with what was built in a folder.
tests() {
    local at=$1
    rm -rf "$work/files" && mkdir "$work/files"
    "$at/check-test" "$work/files"
    local of_dynamic=("$at/gppc-dynamic" "$at/libtest.so" --timelines 7 --seed "$seed" --side 40)
    passes none "${of_dynamic[@]}"
    passes pieces "${of_dynamic[@]}"
    finds longer 'not the shortest' "${of_dynamic[@]}"
    finds cuts 'cuts the corner' "${of_dynamic[@]}"
    finds missing 'there is one' "${of_dynamic[@]}"
    finds invented 'blocked cell\|neither straight' "${of_dynamic[@]}"
    finds forgets 'blocked\|not the shortest\|there is one' "${of_dynamic[@]}"
    finds ends 'the path ends at' "${of_dynamic[@]}"
    finds single 'one point alone' "${of_dynamic[@]}"
    finds endless 'does not end' "${of_dynamic[@]}"
    finds dies 'while answering it died of signal 9' "${of_dynamic[@]}"
    finds dies-early 'while preparing it died' "${of_dynamic[@]}"
    finds leaves 'cut short' "${of_dynamic[@]}"
    finds hangs 'stopped after 1 seconds' "$at/gppc-dynamic" "$at/libtest.so" --timelines 1 --side 40 --seconds 1
    passes none "$at/gppc-dynamic" "$at/libtest.so" --tags 64
    # What is generated is the same as a file.
    passes none "${of_dynamic[@]}" --write "$work/files"
    passes none "$at/gppc-dynamic" "$at/libtest.so" --reference "$work"/files/*-?.scen
    if grep -q 'another length' "$work/out"; then
        cat "$work/out" && exit 1
    fi
    local of_classic=("$at/test-classic" --generated 8 --seed "$seed" --side 40)
    passes none "${of_classic[@]}"
    passes pieces "${of_classic[@]}"
    finds longer 'not the shortest' "${of_classic[@]}"
    finds cuts 'cuts the corner' "${of_classic[@]}"
    finds missing 'there is one' "${of_classic[@]}"
    finds invented 'blocked\|neither straight' "${of_classic[@]}"
    finds single 'one point alone' "${of_classic[@]}"
    local of_points=("$at/test-any-angle" --generated 8 --seed "$seed" --side 14)
    passes none "${of_points[@]}"
    passes pieces "${of_points[@]}"
    passes middle "${of_points[@]}"
    finds longer 'not the shortest' "${of_points[@]}"
    finds through 'blocked cell' "${of_points[@]}"
    finds gaps 'double corner' "${of_points[@]}"
    finds missing 'there is one' "${of_points[@]}"
    finds invented 'blocked' "${of_points[@]}"
    finds short 'shorter than 0.01' "${of_points[@]}"
}

sanitizers() {
    echo 'int main() { return 0; }' >"$work/none.cpp"
    local flags='-O1 -fsanitize=address,undefined -fno-sanitize-recover=all'
    # shellcheck disable=SC2086
    if clang++ $flags "$work/none.cpp" -o "$work/none" 2>/dev/null && "$work/none"; then
        echo "$flags"
    else
        echo 'clang++ has no AddressSanitizer here: built without it' >&2
    fi
}

build() { make -s -j2 OUT="$1" CXX="$2" EXTRA="${3:-}" tests; }

# The program of a track of C++ with its entry: program NAME TRACK VARIABLE.
program() {
    local at=$entries/$2
    make -s OUT="$work/gcc" "$3=$at/Entry.cpp $at/libmediant.a" ENTRY_FLAGS="-I$at" "$work/gcc/$1"
}

# Scenarios beside their maps: all, or those of small maps; if there are tables of costs, of maps that have one.
scenarios() {
    local file name
    find "$maps/" -name '*.map.scen' | sort | while read -r file; do
        name=$(basename "$file" .map.scen)
        if [ -n "$long" ]; then
            echo "$file"
        elif { [ -z "$costs" ] || [ -e "$costs/any-closed-$name.csv" ]; } && [ "$(wc -c <"${file%.scen}")" -lt 100000 ]; then
            echo "$file"
        fi
    done
}

# The scenarios in `files`; none is a mistake.
take_scenarios() {
    files=()
    [ -n "$maps" ] || return 0
    mapfile -t files < <(scenarios)
    [ ${#files[@]} -gt 0 ] || fail "there is no scenario to run in $maps"
}

run_dynamic() {
    local files=() of_timelines=(--timelines 14 --side 80)
    [ -z "$dynamic" ] || mapfile -t files < <(find "$dynamic/" -name '*.scen' | sort)
    [ -z "$long" ] || of_timelines=(--timelines 100)
    "$work/gcc/gppc-dynamic" "$entries/dynamic/lib/libGPPCentry.so" "${files[@]}" "${of_timelines[@]}" \
        --seed "$seed"
}

run_classic() {
    local every=() generated=20
    take_scenarios
    [ -n "$long" ] || every=(--every 10)
    [ -z "$long" ] || generated=200
    "$work/gcc/gppc-classic" "${files[@]}" "${every[@]}" --generated "$generated" --side 60 --seed "$seed"
}

# Every 20th instance has its length in the tables.
run_any_angle() {
    local generated=20 of_costs=()
    take_scenarios
    [ -z "$long" ] || generated=200
    [ -z "$costs" ] || of_costs=(--costs "$costs")
    "$work/gcc/gppc-any-angle" "${files[@]}" "${of_costs[@]}" --every 20 --generated "$generated" --side 24 \
        --seed "$seed"
}

has g++ || exit 1
build "$work/gcc" g++
tests "$work/gcc"
if has clang++; then
    build "$work/clang" clang++ "$(sanitizers)"
    tests "$work/clang"
fi
echo 'The harness finds what is wrong, and nothing else.'
[ -n "$entries" ] || exit 0
if [ -e "$entries/dynamic/lib/libGPPCentry.so" ]; then
    run_dynamic
else
    echo 'dynamic: no entry, left out'
fi
for track in classic any-angle; do
    if [ ! -e "$entries/$track/Entry.cpp" ]; then
        echo "$track: no entry, left out"
    elif [ "$track" = classic ]; then
        program gppc-classic classic CLASSIC_ENTRY
        run_classic
    else
        program gppc-any-angle any-angle ANY_ANGLE_ENTRY
        run_any_angle
    fi
done
