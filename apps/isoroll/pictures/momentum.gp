# momentum.gp - kinds of motion over the energy h: on the left the integral F, on the right F/h, where thin parts can be
# told apart. $parts: part, h, low, high. $kinds: part, name, h, over. $lines: line, h, f. $rotations: line, name.
# f: the index of F; at_h, at_f: the orbit; low, high: F/h that is shown.
width = 900; height = 560; panels = 2
eval page
set multiplot title title noenhanced font ',12'
eval axes_left
array fill[4] = [far_blue, pale_yellow, pale_purple, pale_green]
set style line 11 dt 1 lw 1.8 lc rgb blue
set style line 12 dt (8,4) lw 2.2 lc rgb black
set style line 13 dt (12,4) lw 1.8 lc rgb vermillion
set style line 14 dt (2,3) lw 2.2 lc rgb ink
parts = |$kinds| - 1; rotations = |$rotations| - 1
part(i) = int(word($kinds[i + 1], 1)); line(i) = int(word($rotations[i + 1], 1))
set xlabel 'energy h'; set xrange [0:2 * at_h]; unset key
set yrange [*:*] noextend; set format y '%g'
do for [over=0:1] {
    by(x) = over ? x / column('h') : x
    eval over ? box(0.6 * width, width - 18, 56, height - 202) : box(90, 0.48 * width, 56, height - 202)
    set ylabel 'F_{'.f.'}'.(over ? "\342\201\240 / h" : '')
    if (over) {
        set yrange [low:high]
        do for [i=1:parts] {
            at = word($kinds[i + 1], 3)
            if (at ne 'NaN') {
                set label word($kinds[i + 1], 2) at real(at), real(word($kinds[i + 1], 4)) center front noenhanced
            }
        }
    }
    plot for [i=1:parts] $parts using (column('part') == part(i) ? column('h') : NaN):(by(column('low'))): \
            (by(column('high'))) with filledcurves fs solid 1 noborder fc rgb fill[part(i)], \
        for [i=1:rotations] $lines using (column('line') == line(i) ? column('h') : NaN):(by(column('f'))) \
            with lines ls 10 + line(i), \
        '+' using (at_h):(over ? at_f / at_h : at_f) every ::0::0 with points pt 7 ps 1.2 lc rgb black
}
eval whole_page
set key at screen 0.1, screen down(height - 135) left top Left reverse vertical maxrows 5 samplen 3 spacing 1.2 noenhanced
plot for [i=1:parts] NaN with boxes fs solid 1 noborder lc rgb fill[part(i)] title word($kinds[i + 1], 2), \
    for [i=1:rotations] NaN with lines ls 10 + line(i) title word($rotations[i + 1], 2), \
    NaN with points pt 7 ps 1.2 lc rgb black title 'this orbit'
