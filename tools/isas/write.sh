# SPDX-License-Identifier: Apache-2.0
# Prints the digest of every scene and stage, and writes the tables of docs/determinism.md.
# in: build/isas/rows, build/isas/facts -> out: lines; the page between its markers
# docs: docs/determinism.md, "How it is checked"; read by tools/check-isas
# shellcheck shell=bash disable=SC2154

# Print one line a scene and frame: its stages with their digests.
digests_of() {
    local file
    for file in "$reference"/*.facts; do
        awk -v scene="$(basename "$file" .facts)" '
            !/^digests [a-z]*:[0-9a-f]+$/ { next }
            {
                split($2, part, ":")
                if (part[1] in seen) { print line; delete seen; ++frame; line = "" }
                seen[part[1]] = 1
                if (line == "") line = scene (frame ? ", frame " frame : "") "|"
                line = line part[1] " " part[2] " "
            }
            END { print line }' "$file"
    done
}
print_digests() {
    echo "digests of every scene and stage, the same in all $rows rows:"
    digests_of | sed 's/^/  /; s/|/: /'
}

# Write the page anew from all rows of the sources as they are now.
write_page() {
    local page=$1 name table=$work/table.md line missing=()
    reference=$work/facts/reference
    {
        echo "<!-- isas: begin -->"
        echo "Version $(sed -n 's/^project(pileus VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)," \
            "$(date -u +%Y-%m-%d), sources $before:"
        echo
        echo "| configuration | | digest of all scenes, stages and counts |"
        echo "|---|---|---|"
        for name in "${groups[@]}"; do
            if ! grep -qsx "sources $before" "$work/rows/$name"; then
                missing+=("$name")
                continue
            fi
            grep '|' "$work/rows/$name" | while IFS='|' read -r a b words digest; do
                echo "| $a $b | $words | $digest |"
            done
        done
        echo
        echo "| scene | digests of its stages, in all of these rows |"
        echo "|---|---|"
        digests_of | while IFS='|' read -r name line; do echo "| $name | ${line% } |"; done
        echo "<!-- isas: end -->"
    } >"$table"
    awk -v table="$table" '
        /^<!-- isas: begin -->/ { while ((getline line < table) > 0) print line; skip = 1 }
        !skip { print }
        /^<!-- isas: end -->/ { skip = 0 }' "$page" >"$work/page.md"
    cp "$work/page.md" "$page"
    echo "$page: $(grep -c ' | [0-9a-f]\{16\} |$' "$table") rows written"
    if [ ${#missing[@]} -gt 0 ]; then
        echo "not on the page, not run with these sources: ${missing[*]}"
    fi
}
