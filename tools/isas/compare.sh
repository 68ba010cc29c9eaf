# SPDX-License-Identifier: Apache-2.0
# Renders all scenes with one program in one state and compares what must not depend on either.
# in: group, options, start (how to start it) -> out: build/isas/facts/GROUP/ROW, a line of a table
# docs: docs/determinism.md, "How it is checked"; read by tools/check-isas
# shellcheck shell=bash disable=SC2154

work=build/isas
scenes=(assets/scenes/identity/*.toml)
reference=
faults=()
skipped=0
rows=0
group=
options=()
start=()

skip() {
    skipped=$((skipped + 1))
    printf '%-24s left out: %s\n' "$group $1" "$2"
}
fault() {
    faults+=("$group $1: $2")
    printf '%-24s FAULT: %s\n' "$group $1" "$2"
}

# Whatever is compiled or rendered; a change half way would be taken for a difference.
sources() {
    find CMakeLists.txt cmake platform kernels_cpu src lab tools/pileus assets/scenes/identity \
        tests/identity/program -type f -exec sha256sum {} + | sort | sha256sum | cut -c1-16
}

# Keep of a report what must not depend on the machine: digests in order of the stages, then counts.
facts_of() {
    awk '
        BEGIN {
            count = split("version isa threads team plan memory time scatterings_per_second " \
                          "photons_per_second paths_per_second", names, " ")
            for (i = 1; i <= count; ++i) changing[names[i]] = 1
        }
        match($0, /^  "[^"]*"/) { group = substr($0, RSTART + 3, RLENGTH - 4) }
        /^[{}]/ || group in changing { next }
        {
            gsub(/[ ",]/, "")
            line = group " " $0
            if (group == "digests") print line; else rest = rest line "\n"
        }
        END { printf "%s", rest }' "$1"
}

# Print the first line of two lists of facts that is not the same: what, found, expected.
first_difference() {
    awk 'NR == FNR { want[FNR] = $0; wanted = FNR; next }
         $0 != want[FNR] { print $0 ", expected " want[FNR]; found = 1; exit }
         { last = FNR }
         END { if (!found && last < wanted) print "nothing, expected " want[last + 1] }' "$1" "$2"
}

# Render one scene; leave its facts, frame after frame, or in LOG why there are none.
render_scene() {
    local scene=$1 place=$2 program=$3 stem file status=0
    stem=$place/$(basename "$scene" .toml)
    timeout 900 "${start[@]}" "$program" render "$scene" "${options[@]}" --quiet \
        -o "$stem.pfm" --report "$stem.json" >"$stem.log" 2>&1 || status=$?
    if [ $status -ne 0 ]; then
        echo "exit status $status" >>"$stem.log"
        return 0
    fi
    # The picture written there must be the same one when it is read here.
    for file in "$stem".json "$stem".[0-9]*.json; do
        if [ -e "$file" ]; then facts_of "$file"; fi
    done >"$stem.found"
    for file in "$stem".pfm "$stem".[0-9]*.pfm; do
        if [ -e "$file" ]; then echo "file $(build/release/bin/pileus hash "$file")"; fi
    done >>"$stem.found"
    if grep -q '^digests image:' "$stem.found" && grep -Eq '^file [0-9a-f]{16}$' "$stem.found"; then
        mv "$stem.found" "$stem.facts"
    else
        echo "no digest of the image, or none of its file" >>"$stem.log"
    fi
}

# Render every scene, as many at once as there are processors; say why where one failed.
render_all() {
    local place=$1 program=$2 scene stem
    rm -rf "$place"
    mkdir -p "$place"
    for scene in "${scenes[@]}"; do
        while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n || true; done
        render_scene "$scene" "$place" "$program" &
    done
    wait
    rm -f "$place"/*.pfm
    for scene in "${scenes[@]}"; do
        stem=$(basename "$scene" .toml)
        if [ ! -e "$place/$stem.facts" ]; then
            echo "$stem: $(tail -n 3 "$place/$stem.log" | tr '\n' ' ')"
            return 1
        fi
    done
}

digest_of() { (cd "$1" && cat -- *.facts) | sha256sum | cut -c1-16; }

# The release build on one thread is what all others must equal.
make_reference() {
    local why
    reference=$work/facts/reference
    if grep -qsx "$before" "$reference/sources"; then return 0; fi
    options=(--threads 1)
    why=$(render_all "$reference" build/release/bin/pileus) || {
        fault reference "$why"
        exit 1
    }
    echo "$before" >"$reference/sources"
}

begin_group() {
    mkdir -p "$work/rows"
    echo "sources $before" >"$work/rows/$group"
}

# One row: its name in the group, words for the page, the program.
check() {
    local name=$1 words=$2 program=$3 place=$work/facts/$group/$1 begin=$SECONDS why stem digest
    why=$(render_all "$place" "$program") || {
        # A state that the machine does not have is no fault.
        if grep -qs '^exit status 77$' "$place"/*.log; then
            skip "$name" "this machine has no such state"
        else
            fault "$name" "$why"
        fi
        return 0
    }
    for stem in "${scenes[@]}"; do
        stem=$(basename "$stem" .toml)
        why=$(first_difference "$reference/$stem.facts" "$place/$stem.facts")
        if [ -n "$why" ]; then
            fault "$name" "$stem: $why"
            return 0
        fi
    done
    rows=$((rows + 1))
    digest=$(digest_of "$place")
    printf '%-24s %-17s %9s %9s\n' "$group $name" "$digest" "${built:--}" $((SECONDS - begin))
    echo "$group|$name|$words|$digest" >>"$work/rows/$group"
    built=-
}
