# SPDX-License-Identifier: Apache-2.0
# Parts of a picture, made on two kinds of machine, merged on each of them: the hash of one run.
# in: group, start (how to start the foreign program), that program -> out: a line, or a fault
# docs: docs/farm.md, docs/testing.md; read by tools/check-isas
# shellcheck shell=bash disable=SC2154

# Rows of paths, sums of photons in both methods, finished rows.
part_scenes=(path photon_grid cumulus_billboards raymarch)

check_parts() {
    local program=$1 native=build/release/bin/pileus place=build/isas-$group/parts begin=$SECONDS
    local name scene wanted found made log=build/isas-$group/parts/log
    rm -rf "$place"
    mkdir -p "$place"
    for name in "${part_scenes[@]}"; do
        scene=assets/scenes/identity/$name.toml
        wanted=$("$native" render "$scene" --quiet -o "$place/whole.pfm" | cut -c1-16) || true
        # Two parts are foreign and one is native, then the other way about; merged here, then there.
        for made in "foreign native foreign" "native foreign native"; do
            # shellcheck disable=SC2086
            if ! make_parts "$scene" "$place" "$native" "$program" $made >"$log" 2>&1; then
                fault parts "$name: $(tail -n 1 "$log")"
                return 0
            fi
            found=$(merge_parts "$native" "$place")" "$(merge_parts "${start[@]}" "$program" "$place") || true
            if [ -z "$wanted" ] || [ "$found" != "$wanted $wanted" ]; then
                fault parts "$name, $made, merged here and there: $found, expected $wanted twice"
                return 0
            fi
        done
    done
    printf '%-24s parts of here and there, merged here and there: one hash, %d s\n' "$group parts" \
        $((SECONDS - begin))
}

make_parts() {
    local scene=$1 place=$2 native=$3 program=$4 number=0 machine run
    shift 4
    for machine in "$@"; do
        number=$((number + 1))
        run=("$native")
        if [ "$machine" = foreign ]; then run=("${start[@]}" "$program"); fi
        timeout 300 "${run[@]}" render "$scene" --quiet --threads 2 --part "$number/$#" \
            -o "$place/$number.part" || return 1
    done
}

# In another order than they were made in.
merge_parts() {
    local place=${*: -1}
    "${@:1:$#-1}" merge "$place/3.part" "$place/1.part" "$place/2.part" -o "$place/merged.pfm" 2>"$place/log" |
        cut -c1-16
}
