# splitting.gp - |m| over k or the level, and both curves on the section where they meet.
# $rows: over, size, low, high, sign. $curve: u, x. over: "k" or "level"; sizes, curves: whether they are drawn;
# at: of which row the curves are, such as "k = 1/2"; axis: of the section.
width = 900; panels = sizes + curves; height = panels == 2 ? 480 : 600
eval page
set multiplot layout 1,panels title title noenhanced font ',12'
if (sizes) {
    eval axes_left
    set logscale y; set format y '10^{%T}'; set xlabel over offset 0,0.5; set mxtics 2
    set title 'slope m of the curves where they meet, at π/2' offset 0,-0.5
    set ylabel '|m| (0: no splitting)' offset 1,0
    set key outside bottom center horizontal maxrows 1 Left reverse samplen 1 width 2 height 1
    has(kind) = |$rows| > 1 ? strstrt(signs, sprintf(" %d ", kind)) : 0
    signs = ' '
    do for [i=2:|$rows|] { signs = signs.word($rows[i], 5).' ' }
    if (|$rows| > 1) {
        plot $rows using 'over':(column('sign') == 1 ? column('size') : NaN):'low':'high' with yerrorbars \
                pt 7 ps 0.7 lc rgb blue title has(1) ? 'm > 0' : '', \
            $rows using 'over':(column('sign') == -1 ? column('size') : NaN):'low':'high' with yerrorbars \
                pt 6 ps 0.8 lc rgb vermillion title has(-1) ? 'm < 0' : '', \
            $rows using 'over':(column('sign') == 0 ? column('size') : NaN) with points pt 11 ps 1 lc rgb axes \
                title has(0) ? '|m| below' : ''
    } else {
        plot 1 notitle with lines lc rgb white
    }
    unset logscale y; set format y '%g'; unset mxtics
}
if (curves) {
    eval axes_all
    set xrange [-0.35:pi+0.35]; set xtics ('O' 0, 'π/4' pi/4, 'π/2' pi/2, '3π/4' 3*pi/4, "O'" pi)
    set arrow 1 from first pi/2, graph 0 to first pi/2, graph 1 nohead back dt (3,3) lw 1.2 lc rgb help
    set key outside bottom center horizontal Left reverse samplen 2 width 2 height 1
    set title 'both curves on the section '.sub('γ', axis).' = 0, '.at offset 0,-0.5
    set xlabel 'l − l(O)' offset 0,0; set ylabel sub('M', axis).' / |M|' offset 1,0
    plot $curve using 'u':'x' with lines lw 1.6 lc rgb vermillion title 'leaves the unstable rotation O', \
        $curve using (pi - column('u')):'x' with lines lw 1.6 dt (12,8) lc rgb blue \
            title "enters the opposite one, O'"
}
