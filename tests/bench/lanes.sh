#!/bin/sh
# lanes.sh BEFORE AFTER [PASSES] - how much faster the lanes of one build are than those of another.
#
# BEFORE and AFTER are the programs bench_batch of two builds. They run in turns, PASSES times (5) for each k. A line
# has k, the vectors, the medians of orbits per second where the 95th percentile of the errors is 1e-9, and the median
# of the ratios of the passes.
set -eu
[ $# -ge 2 ] || { echo "usage: sh lanes.sh BEFORE AFTER [PASSES]" >&2; exit 2; }
before=$1 after=$2 passes=${3:-5}
echo "k vectors before after ratio"
for k in -1 1 0.5 0.75 -0.4; do
    i=0
    while [ "$i" -lt "$passes" ]; do
        i=$((i + 1))
        for side in before after; do
            eval "program=\$$side"
            # shellcheck disable=SC2154 # eval sets it
            "$program" "$k" 3 lanes | sed -n "s/^\([a-z0-9]*\) *at 1e-9: \([0-9]*\) .*/$k $i $side \1 \2/p"
        done
    done
done | awk '
    function median(list,    x, n, i, j, t) {
        n = split(list, x, " ")
        for (i = 2; i <= n; i++)
            for (j = i; j > 1 && x[j] < x[j - 1]; j--) { t = x[j]; x[j] = x[j - 1]; x[j - 1] = t }
        return n % 2 ? x[(n + 1) / 2] : (x[n / 2] + x[n / 2 + 1]) / 2
    }
    {
        name = $1 " " $4
        if (!(name in seen)) { seen[name] = 1; order[++count] = name }
        rates[name, $3] = rates[name, $3] " " $5
        if ($3 == "before") last[name] = $5
        else ratios[name] = ratios[name] " " $5 / last[name]
    }
    END {
        for (i = 1; i <= count; i++) {
            name = order[i]
            printf "%s %.0f %.0f %.2f\n", name, median(rates[name, "before"]), median(rates[name, "after"]),
                median(ratios[name])
        }
    }'
