# chart.gp - where the rotations about the axes of the least and of the greatest moment are stable, over k.
# $cells: side (1, 2), class, left, right, bottom, top. $borders: side, k, up. up: what varies beside k; none: whether
# there are cells of class 2.
width = 900; height = 480; panels = 2
eval page
set multiplot title title noenhanced font ',12'
set border 15 lc rgb axes; set tics nomirror out scale 0.6; set autoscale noextend
array class[4] = [0, -1, 1, 2]; array fill[4] = [pale_blue, orange, vermillion, grey]
array name[4] = ['stable', 'unstable, T < −2', 'unstable, T > 2 (T: trace)', 'no such rotation']
array moment[2] = ['least', 'greatest']
is(s, c) = column('side') == s && column('class') == c
set xlabel 'k'; set ylabel up noenhanced offset 1,0; unset key
do for [s=1:2] {
    eval box(s == 1 ? 72 : 504, s == 1 ? 441 : 873, 67, height - 110)
    set title 'rotation about the axis of the '.moment[s].' moment' offset 0,-0.5
    plot for [c=1:4] $cells using (is(s, class[c]) ? (column('left') + column('right')) / 2 : NaN): \
            ((column('bottom') + column('top')) / 2):'left':'right':'bottom':'top' with boxxyerror \
            fs solid 1 border lc rgb fill[c] lw 0.5 lc rgb fill[c], \
        $borders using (column('side') == s ? column('k') : NaN):'up' with points pt 7 ps 0.25 lc rgb black
}
eval whole_page
set key at screen 0.5, screen down(height - 55) center top vertical maxrows 2 Left reverse \
    samplen 1 width 1 font ',10'
plot for [c=1:3 + none] NaN with boxes fs solid 1 noborder lc rgb fill[c] title name[c], \
    NaN with points pt 7 ps 0.5 lc rgb black title 'border, T = ±2'
