# frequencies.gp - the spectral lines of n(t): of the pair of components across the axis, and of the one along it.
# $lines: signal (1, 2), frequency, amplitude, label. axis: 1 to 3; labels: how many; warning: above the lines, or ''.
width = 900; height = 420; panels = 2 # wide: the warning is long
eval page
eval axes_left
warned = warning ne ''
set label 1 title at screen 0.5, screen down(21) center noenhanced font ',12'
set label 2 warning at screen 0.5, screen down(48) center tc rgb vermillion
eval box(80, width - 27, warned ? 92 : 67, height - 63)
set logscale y; set format y '10^{%T}'; set key at graph 1, graph 1.02 right bottom horizontal
set xlabel 'frequency in t'.(labels > 0 ? '; m,n: m times frequency 1 and n times frequency 2' : '')
set ylabel 'amplitude'; set offsets graph 0.04, graph 0.04, 0, 0
stats $lines using 'amplitude' nooutput
set yrange [10 ** (floor(log10(min(1, STATS_min))) - 1):4]
array colour[2] = [blue, vermillion]; array sign[2] = [7, 6]
array name[2] = [sub('n', axis % 3 + 1).' + i '.sub('n', (axis + 1) % 3 + 1), sub('n', axis)]
set style line 11 lw 2 lc rgb blue dt 1
set style line 12 lw 2 lc rgb vermillion dt (4,2)
present(s) = strstrt(signals, sprintf(' %d ', s)) > 0
signals = ' '
do for [i=2:|$lines|] { signals = signals.word($lines[i], 1).' ' }
of(s) = column('signal') == s ? column('frequency') : NaN
plot for [s=1:2] $lines using (of(s)):'amplitude' with impulses ls 10 + s title present(s) ? name[s] : '', \
    for [s=1:2] $lines using (of(s)):'amplitude' with points pt sign[s] ps 0.5 + 0.1 * s lc rgb colour[s] notitle, \
    for [i=1:labels > 0] $lines using 'frequency':'amplitude':'label' with labels left rotate by 90 offset 0,0.5 \
        font ',8' notitle
