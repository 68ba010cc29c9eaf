# SPDX-License-Identifier: Apache-2.0
# Runs the stages of tools/test and .ci/run one after the other, and prints what each took.
# in: stages_of (who runs them) -> out: name, wall and processor seconds of each; exit 1 at the first that fails
# docs: docs/testing.md, "Run"; read by tools/test and .ci/run
# shellcheck shell=bash disable=SC2154

stage_rows=()
stage_clock=$(mktemp)
trap 'rm -f "$stage_clock"' EXIT

# Sets `cpu` to the processor seconds, user and system, of all commands that this shell has waited for.
read_cpu() {
    # Not in a pipe or a substitution: a shell of its own has waited for none.
    times >"$stage_clock"
    cpu=$(awk -F'[ms ]+' 'NR == 2 { printf "%.1f", 60 * $1 + $2 + 60 * $3 + $4 }' "$stage_clock")
}

stage() {
    local name=$1 wall=$SECONDS cpu before row
    read_cpu
    before=$cpu
    shift
    echo "==> $name"
    "$@" </dev/null || {
        echo "$stages_of: stage \"$name\" failed" >&2
        exit 1
    }
    read_cpu
    row=$(awk -v wall=$((SECONDS - wall)) -v cpu="$cpu" -v before="$before" -v name="$name" 'BEGIN {
        printf "%5d s wall, %5.0f s CPU: %s", wall, cpu - before, name }')
    stage_rows+=("$row")
    echo "    $row"
}

# All stages once more, with their sums.
print_stages() {
    echo "==> all stages passed in $SECONDS s"
    printf '    %s\n' "${stage_rows[@]}"
}
