# SPDX-License-Identifier: Apache-2.0
# Google Benchmark's JSON as lines that other tools can join.
# in: --benchmark_format=json, plain or aggregates -> out: "case column value", medians where there
# are aggregates. Read with README.md: `time` is ms of CPU, `wall` ms between begin and end.
/^ *"run_name":/ {
    split($0, part, "\"")
    name = part[4]
    manual = name ~ /\/manual_time$/
    sub(/\/(manual|process)_time$/, "", name)
    sub(/\/iterations:1$/, "", name)
    skip = 0
    next
}
name == "" { next }
/"aggregate_name":/ { skip = $0 !~ /"median"/ }
/"(error_occurred|error_message)":/ { print name, "error", 1 }
/^ *}/ { name = "" }
!skip && match($0, /^ *"[^"]+": -?[0-9.]+(e[-+]?[0-9]+)?,?$/) {
    split($0, part, "\"")
    column = part[2]
    value = part[3]
    gsub(/[:, ]/, "", value)
    if (column ~ /^(family_index|per_family_instance_index|repetitions|threads|iterations)$/) next
    if (column == "repetition_index") next
    if (column == "real_time") column = manual ? "time" : "wall"
    else if (column == "cpu_time") column = manual ? "whole" : "time"
    print name, column, value
}
