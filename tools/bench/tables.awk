# SPDX-License-Identifier: Apache-2.0
# The tables of docs/performance.md.
# in: -v table=NAME, values ("case column value"), then figures.txt -> out: Markdown
# Read with README.md: a case that was not run leaves its cell empty.
function value(text, at) {
    if (text ~ /^[0-9.e+-]+$/) return text + 0
    at = index(text, "@")
    text = substr(text, 1, at - 1) " " substr(text, at + 1)
    if (!(text in values)) missing = 1
    return values[text]
}
function result(expression, n, term, i, v, x) {
    n = split(expression, term, " ")
    missing = 0
    v = value(term[1])
    for (i = 2; i < n; i += 2) {
        x = value(term[i + 1])
        if (missing || (term[i] == "/" && x == 0)) return ""
        if (term[i] == "*") v *= x
        if (term[i] == "/") v /= x
        if (term[i] == "+") v += x
        if (term[i] == "-") v -= x
    }
    return missing ? "" : v
}
# Three figures, never in exponents.
function shown(v) {
    if (v == "") return ""
    return v >= 100 ? sprintf("%.0f", v) : v >= 10 ? sprintf("%.1f", v) : sprintf("%.3g", v)
}
function verdict(got, asked, part) {
    if (got == "" || asked == "-") return ""
    split(asked, part, " ")
    if (part[1] == "<=") return got <= part[2] + 0 ? "yes" : sprintf("no, %.2f times", got / part[2])
    return got >= part[2] + 0 ? "yes" : sprintf("no, %.2f of it", got / part[2])
}
function trimmed(text) {
    gsub(/^ +| +$/, "", text)
    return text
}
FNR == 1 { file++ }
file == 1 {
    values[$1 " " $2] = $3
    if ($1 != last) cases[++count] = last = $1
    next
}
file == 2 && table == "figures" && !/^#/ && NF > 0 {
    split($0, field, "|")
    got = result(trimmed(field[3]))
    asked = trimmed(field[4])
    if (rows++ == 0) {
        print "| | figure | got | asked | reached |"
        print "|---|---|---|---|---|"
    }
    plain = asked
    sub(/<=/, "≤", plain)
    sub(/>=/, "≥", plain)
    printf "| %s | %s | %s | %s | %s |\n", trimmed(field[1]), trimmed(field[2]),
        got == "" ? "not measured" : shown(got), plain, verdict(got, asked)
}
# One row per case without a suffix; `first` is the column of a cell, `second` the one in brackets.
function by_isa(pattern, first, scale, second, i, k, n, isa, cell, name, mark) {
    n = split("scalar sse2 avx2 avx512", isa, " ")
    print "| | scalar | sse2 | avx2 | avx512 |"
    print "|---|---|---|---|---|"
    for (i = 1; i <= count; i++) {
        name = cases[i]
        if (name !~ pattern || name ~ /\/(scalar|sse2|avx2|avx512|osmesa|egl|threads:[0-9]+)$/) continue
        printf "| `%s` |", name
        for (k = 1; k <= n; k++) {
            cell = name "/" isa[k]
            if (!((cell " " first) in values)) cell = k == n ? name : ""
            if (!((cell " " first) in values)) {
                printf " |"
                continue
            }
            mark = second != "" && (cell " " second) in values ? values[cell " " second] : 0
            printf " %s%s |", shown(values[cell " " first] * scale),
                (mark > 0 ? sprintf(" (%.2g)", mark) : "")
        }
        print ""
    }
}
# One row per case, one column for each counter of the list "counter*scale".
function counters(pattern, list, heads, i, k, n, item, at, key) {
    n = split(list, item, " ")
    print heads
    gsub(/[^|]/, "", heads)
    gsub(/\|/, "|---", heads)
    print substr(heads, 1, length(heads) - 3)
    for (i = 1; i <= count; i++) {
        if (cases[i] !~ pattern) continue
        printf "| `%s` |", cases[i]
        for (k = 1; k <= n; k++) {
            # A counter's own name may hold a star: the scale follows the last one.
            at = match(item[k], /\*[^*]*$/)
            key = cases[i] " " substr(item[k], 1, at - 1)
            printf " %s |", key in values ? shown(values[key] * substr(item[k], at + 1)) : ""
        }
        print ""
    }
}
# Slope of log(y) over log(x), least squares, of all cases growth/WHAT/AXIS/X.
function growth(i, part, key, x, y, keys, k, order, n, slope) {
    print "| | from | to | at the smaller | at the larger | exponent |"
    print "|---|---|---|---|---|---|"
    for (i = 1; i <= count; i++) {
        if (cases[i] !~ /^growth\// || split(cases[i], part, "/") != 4) continue
        key = part[2] ", " part[3]
        if (!((cases[i] " x") in values)) continue
        if (!(key in n)) order[++k] = key
        x = values[cases[i] " x"]
        y = values[cases[i] " y"]
        if (++n[key] == 1) low[key] = x "|" y
        high[key] = x "|" y
        sx[key] += log(x)
        sy[key] += log(y)
        sxx[key] += log(x) * log(x)
        sxy[key] += log(x) * log(y)
    }
    for (i = 1; i <= k; i++) {
        key = order[i]
        spread = n[key] * sxx[key] - sx[key] * sx[key]
        slope = spread > 0 ? (n[key] * sxy[key] - sx[key] * sy[key]) / spread : 0
        split(low[key], part, "|")
        x = part[1]
        y = part[2]
        split(high[key], part, "|")
        printf "| %s | %.4g | %.4g | %s | %s | %.2f |\n", key, x, part[1], shown(y * 1),
            shown(part[2] * 1), slope
    }
}
END {
    if (table == "tracing") by_isa("^trace/", "s/scattering", 1e9, "times_floor")
    if (table == "rates")
        counters("^trace/[^/]+(/(local|global|bare|two_media|two_lobes))?(/threads:[0-9]+)?$",
            "photons/s*1e-6 scatterings/s*1e-6 tentative/scattering*1 crossings/scattering*1",
            "| | million photons/s | million scatterings/s | tentative | crossings |")
    if (table == "path") by_isa("^path/", "s/scattering", 1e9, "times_floor")
    if (table == "paths")
        counters("^path/[^/]+(/(chromatic|every_ray))?(/threads:[0-9]+)?$",
            "paths/s*1e-6 scatterings/s*1e-6 rays/scattering*1 relvar*s*1",
            "| | million paths/s | million scatterings/s | shadow rays a scattering | variance × s |")
    if (table == "preparation")
        counters("^prepare/[^:]*k$",
            "time*1 gradient_ms*1 samples_ms*1 tree_ms*1 collectors_ms*1 majorants_ms*1 collectors*1",
            "| | all | gradient | samples | tree | collectors | majorants | number of collectors |")
    if (table == "display") by_isa("^(shadow|splat|reconstruct|march|background|blend)", "time", 1, "times_floor")
    if (table == "composites")
        counters("^blend/(1k|8k|30k)/", "best_ms*1 best_wall_ms*1 times_floor*1",
            "| | ms of CPU | ms of wall | times its floor |")
    if (table == "math") by_isa("^math/", "s/value", 1e9, "times_libm")
    if (table == "growth") growth()
}
