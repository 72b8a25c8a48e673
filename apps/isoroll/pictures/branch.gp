# branch.gp - followed periodic orbits: above the trace, with the events, below the place, over what varies.
# $points: branch, at, trace, place. $events: the same, and event, a word. branches: how many; over: what varies.
width = 900; height = 640; panels = 2
eval page
set multiplot title title noenhanced font ',12'
set border 15 lc rgb axes; set tics nomirror out scale 0.6; unset key; set autoscale xfix
least = 1e300; most = -1e300
if (|$points| > 1) { stats $points using 'at' nooutput; least = STATS_min; most = STATS_max }
if (|$events| > 1) { stats $events using 'at' nooutput; least = min(least, STATS_min); most = max(most, STATS_max) }
room = least < most ? 0 : max(0.1 * abs(least), 0.1) # a single number has room on both sides
set xrange [least - room:most + room]
look(b) = (b - 1) % strokes + 1
of(b, name) = column('branch') == b ? column(name) : NaN

eval box(90, width - 27, 45, 0.5 * height - 26)
set ylabel 'trace' offset 1,0; set yrange [-6:6]
set object 1 rectangle from graph 0, first -2 to graph 1, first 2 back fc rgb pale_blue fs solid noborder
set label 2 'stable' at graph 0.01, first 1.5 tc rgb words
plot for [b=1:branches] $points using 'at':(of(b, 'trace')) with lines ls look(b) lw 1.5, \
    for [i=1:|$events| > 1] $events using 'at':'trace':'event' with labels noenhanced left offset 0.7,0.7 \
        rotate by 15 font ',8' point pt 7 ps 0.8 lc rgb black

unset object; unset label
eval box(90, width - 27, 0.5 * height + 13, height - 58)
set ylabel 'place on the line: 2 u/π'; set yrange [0:1]; set xlabel over noenhanced
plot for [b=1:branches] $points using 'at':(of(b, 'place')) with lines ls look(b) lw 1.5, \
    for [i=1:|$events| > 1] $events using 'at':'place' with points pt 7 ps 0.8 lc rgb black
