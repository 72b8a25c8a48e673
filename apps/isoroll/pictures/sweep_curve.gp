# sweep_curve.gp - a value over the number that varies, with the band of its error. Lines have gaps where there is no
# value. $curve: at, value, low, high. $marks: axis, at: where the free ball is integrable. over, value: names; error:
# what the band is, or ''; sizes: |value| on a logarithmic axis; logarithmic_x.
width = 900; height = 480; panels = 1
eval page
eval axes_left
set title title noenhanced
set key outside bottom center horizontal Left reverse samplen 1.6 width 2 height 1 noenhanced
set xlabel over noenhanced; set ylabel value noenhanced
if (sizes) { set logscale y; set format y '10^{%T}' }
if (logarithmic_x) { set logscale x; set format x '10^{%T}' }
set style line 11 dt (12,9) lw 1.2 lc rgb ink
do for [i=2:|$marks|] {
    k = real(word($marks[i], 2))
    set arrow from first k, graph 0 to first k, graph 1 nohead front ls 11
}
pale = "$curve using 'at':'low':'high' with filledcurves fc rgb far_blue fs solid 0.7 noborder title error, "
mark = ", NaN with lines ls 11 title 'k = ±1: the free ball is integrable'"
eval 'plot '.(error ne '' ? pale : '') \
    ."$curve using 'at':'value' with linespoints pt 7 ps 0.45 lw 1.4 lc rgb blue notitle" \
    .(|$marks| > 1 ? mark : '')
