# SPDX-License-Identifier: Apache-2.0
# Compiles the program for one group of rows, and makes what its states need.
# in: group, a preset, targets, options of cmake -> out: build/isas-GROUP/bin, seconds in `built`
# docs: docs/determinism.md, "How it is checked"; read by tools/check-isas
# shellcheck shell=bash disable=SC2154

built=-

# Compile from a preset; builds that ship stay where everyone expects them.
build() {
    local preset=$1 targets=$2 folder="build/isas-$group" begin=$SECONDS
    local configure=(--preset "$preset" -B "$folder")
    shift 2
    # With the options that it has.
    if [ "$preset" = release ] || [ "$preset" = wasm ]; then
        folder=build/$preset configure=(--preset "$preset")
        if [ -e "$folder/CMakeCache.txt" ]; then configure=("$folder"); fi
    fi
    mkdir -p "$work"
    # shellcheck disable=SC2086
    { cmake "${configure[@]}" "$@" &&
        cmake --build "$folder" --target $targets; } >"$work/$group.log" 2>&1 || {
        tail -n 30 "$work/$group.log" >&2
        fault all "does not build, see $work/$group.log"
        return 1
    }
    built=$((SECONDS - begin))
}

version_of() {
    case "$1" in
        clang*) echo "Clang $("$1" -dumpversion)" ;;
        *) echo "GCC $("$1" -dumpfullversion)" ;;
    esac
}

# A locale with commas in numbers, or with an i without dot, made here for this once.
make_locale() {
    command -v localedef >/dev/null && [ -e "/usr/share/i18n/locales/$1" ] || return 1
    mkdir -p "$work/locale"
    [ -d "$work/locale/$1.UTF-8" ] ||
        localedef -i "$1" -f UTF-8 "$work/locale/$1.UTF-8" >"$work/locale.log" 2>&1
}
