# difference.gp - how far two computations of one orbit are apart.
# $curves: chart, over, name, right, begin, end, low, high: a row for each quantity. $values: curve, x, y.
width = 900; height = 480; panels = 1
eval page
eval axes_left
set title title noenhanced
set key outside bottom center horizontal Left reverse samplen 3 width 2 height 1 noenhanced
set logscale y; set format y '10^{%T}'; set xlabel word($curves[2], 2) noenhanced; set ylabel differences
plot for [i=1:|$curves| - 1] $values using (column('curve') == i ? column('x') : NaN):'y' with lines ls i lw 1.5 \
    title word($curves[i + 1], 3)
