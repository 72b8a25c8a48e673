# sweep_map.gp - a value over two numbers that vary, as a map; maps side by side where a third number varies.
# $cells: cell, map, missing, value, x, y: the corners of cells, a gap behind each. $maps: name. $marks: axis (1: x,
# 2: y), at: where the free ball is integrable. x, y, value: names of axes; low, high: the range of colours; sizes:
# |value| on a logarithmic scale; logarithmic_x, logarithmic_y; missing: whether values are missing.
maps = |$maps| - 1; columns = min(maps, 3); rows = maps > 3 ? 2 : 1; marked = |$marks| > 1
keys = missing || marked ? 30 : 0
width = 900; height = rows * 400 + (maps == 1 ? 200 : 0) + keys; panels = 2
eval page
eval viridis
set multiplot title title noenhanced
set border 15 lc rgb axes; set tics nomirror out scale 0.6; unset key
set xlabel x noenhanced
set cbrange [low:high]; set colorbox user origin screen 0.865, screen 0.27 size screen 0.015, screen 0.46
set cblabel value noenhanced
if (sizes) { set logscale cb; set format cb '10^{%T}' }
if (logarithmic_x) { set logscale x; set format x '10^{%T}' }
if (logarithmic_y) { set logscale y; set format y '10^{%T}' }
set autoscale noextend; set offsets graph 0.02, graph 0.02, graph 0.02, graph 0.02
set style line 11 dt (12,9) lw 1.2 lc rgb ink
do for [i=2:|$marks|] {
    k = real(word($marks[i], 2))
    if (int(word($marks[i], 1)) == 1) {
        set arrow from first k, graph 0 to first k, graph 1 nohead front ls 11
    } else {
        set arrow from graph 0, first k to graph 1, first k nohead front ls 11
    }
}
# about four steps of 1, 2 or 5 times a power of ten: maps are narrow
if (!logarithmic_x) {
    stats $cells using 'x' nooutput
    rough = (STATS_max - STATS_min) / 3.5; power = 10 ** floor(log10(rough))
    set xtics power * (rough < 2 * power ? 1 : rough < 5 * power ? 2 : 5)
}
shown(i, none) = column('map') == i && column('missing') == none ? column('x') : NaN
wide = 0.83 * width / columns; tall = 0.9 * (height - keys) / rows
do for [i=1:maps] {
    left = 0.075 * width + wide * ((i - 1) % columns); top = 0.09 * (height - keys) + tall * ((i - 1) / columns)
    eval box(left, left + wide - 58, top + (word($maps[i + 1], 1) eq '' ? 0 : 32), top + tall - 52)
    set title word($maps[i + 1], 1) noenhanced
    set ylabel (i - 1) % columns == 0 ? y : '' noenhanced
    if (i == 2) { unset colorbox }
    plot $cells using (shown(i, 1)):'y' with filledcurves closed fs solid 1 noborder lc rgb grey, \
        $cells using (shown(i, 0)):'y':'value' with filledcurves closed fs solid 1 noborder lc palette
}
if (keys > 0) {
    eval whole_page
    set key at screen 0.5, screen 28.0 / height center top vertical maxrows 1 Left reverse samplen 2 width 2
    line = "NaN with lines ls 11 title 'k = ±1: the free ball is integrable'"
    fill = "NaN with boxes fs solid 1 noborder lc rgb grey title 'no value'"
    eval 'plot '.(marked ? line : '').(marked && missing ? ', ' : '').(missing ? fill : '')
}
