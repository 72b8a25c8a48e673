# columns.gp - one column over another.
# $curves: chart, over, name, right, begin, end, low, high; one row. $values: curve, x, y. equal: 1: one unit is equally
# long on both axes.
width = 900; panels = 1; height = equal ? 900 : 560
eval page
entry(i) = word($curves[2], i)
first = number(entry(5)); last = number(entry(6)); low = number(entry(7)); high = number(entry(8))
along = equal ? 0.04 * (last - first) : 0; up = 0.04 * (high - low) # room beyond the ends
set multiplot title title noenhanced font ',12'
eval axes_left
eval box(95, width - 55, 85, height - 60)
if (equal) { set size ratio -1 }
unset key
set label 1 entry(3).' over '.entry(2) noenhanced left at graph 0,1 offset 0,0.9
tick_name = entry(2)
eval named('x', first - along, last + along, 9)
tick_name = ''
eval ticks('y', low >= 0 && low < 0.3 * high ? 0 : low - up, high + up, 5)
set label 2 tick_text noenhanced right tc rgb ink at graph 0,1 offset -1,0.6
if (|$values| > 2) {
    plot $values using 'x':'y' with lines lw 1.5 lc rgb blue
} else {
    plot $values using 'x':'y' with points pt 7 lc rgb blue
}
