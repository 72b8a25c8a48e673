# cost.gp - work and precision: time over error, a panel for each backend, a line for each method.
# $points: panel, series, named, error, seconds. $panels, $methods: name. $closed: error, seconds. series: how many;
# nameless: whether some methods have no name; uncertainty: smaller errors are not known.
width = 900; height = 490; panels = 2
eval page
array sign[10] = [7, 5, 9, 11, 13, 6, 4, 8, 10, 12]
name(n) = n < |$methods| ? word($methods[n + 1], 1) : ''
count = |$panels| - 1; names = |$methods| - 1; closed = |$closed| > 1
set multiplot title title noenhanced font ',12'
eval axes_left
unset key; set logscale xy; set format x '10^{%T}'; unset mxtics

# both panels have one range, of whole powers of ten; errors of 1 are no results
least = 1e300; most = 0; fastest = 1e300; slowest = 0
if (|$points| > 1) {
    stats $points using 'error':'seconds' nooutput
    least = STATS_min_x; most = STATS_max_x; fastest = STATS_min_y; slowest = STATS_max_y
}
if (closed) {
    stats $closed using 'error':'seconds' nooutput
    least = min(least, STATS_min_x); most = max(most, STATS_max_x)
    fastest = min(fastest, STATS_min_y); slowest = max(slowest, STATS_max_y)
}
below(x) = 10 ** floor(log10(x) - 0.05); above(x) = 10 ** ceil(log10(x) + 0.05)
most = min(most, 0.8); least = below(min(least, most)); most = above(most)
set xrange [most:least]; set yrange [below(fastest):above(slowest)]
set xlabel 'largest relative error of (ω, n)' offset 0,0.3
if (uncertainty > least) {
    set object 1 rectangle from first min(uncertainty, most), graph 0 to graph 1, graph 1 behind fs solid 1 noborder \
        fc rgb band
}
line(s, p, named) = column('series') == s && column('panel') == p && (column('named') > 0) == named
named(n, p) = column('named') == n && column('panel') == p
gap = 45; wide = (width - 32 - 77 - gap * (count - 1)) / count
do for [p=1:count] {
    from = 77 + (p - 1) * (wide + gap)
    eval box(from, from + wide, 59, height - 146)
    set ylabel p == 1 ? 'processor time in seconds' : ''; set format y p == 1 ? '10^{%T}' : ''
    set title word($panels[p + 1], 1) noenhanced offset 0,-0.6
    plot for [s=1:series] $points using (line(s, p, 0) ? column('error') : NaN):'seconds' with lines \
            dt 1 lw 0.8 lc rgb others, \
        for [n=1:names] $points using (named(n, p) ? column('error') : NaN):'seconds' with linespoints ls n \
            pt sign[n] ps 0.75 lw 1.5, \
        for [i=1:closed] $closed using 'error':'seconds' with points pt 3 ps 1.5 lw 2 lc rgb black
}
eval whole_page
entries = names + nameless + closed + (uncertainty > 0)
set key at screen 0.5, screen 96.0 / height center top Left reverse vertical maxrows (entries + 2) / 3 samplen 3.5 \
    spacing 1.05 width -1 noenhanced font ',9'
# an entry that is not there is left out: an empty loop would keep its place
key = names ? 'for [n=1:names] NaN with linespoints ls n pt sign[n] ps 0.75 lw 1.5 title name(n)' : 'NaN notitle'
if (nameless) { key = key.", NaN with lines dt 1 lw 0.8 lc rgb others title 'other methods'" }
if (closed) { key = key.", NaN with points pt 3 ps 1.5 lw 2 lc rgb black title 'closed solution'" }
if (uncertainty > 0) { key = key.", NaN with boxes fs solid 1 noborder lc rgb band title 'below what is known'" }
eval 'plot '.key
