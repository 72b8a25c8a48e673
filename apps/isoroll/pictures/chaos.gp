# chaos.gp - orbits by their starts on the section: regular, chaotic (coloured by exponent), undecided.
# $regular, $undecided: l, x. $chaotic: l, x, exponent. right_name, up_name: of the axes.
width = 900; panels = 1; height = 520
eval page
eval axes_all
eval angles
set title title noenhanced font ',12'
set yrange [-1:1]; set ytics 0.5; set xlabel right_name noenhanced; set ylabel up_name offset 1,0 noenhanced
set cblabel 'exponent per turn'; set cbrange [0:*]
eval exponents
set key outside bottom center horizontal samplen 1 height 1
spot = min(max(30 / sqrt(|$regular| + |$chaotic| + |$undecided| - 2.9), 0.12), 1.6) * (narrow ? 0.6 : 1)
if (|$chaotic| == 1) { unset colorbox }
# a block without rows is not drawn
some(block, rows, looks) = rows > 1 ? ', '.block.' using 1:2'.looks : ''
eval 'plot NaN notitle' \
    .some('$regular', |$regular|, " with points pt 7 ps spot lc rgb far_blue title 'regular'") \
    .some('$chaotic', |$chaotic|, ":3 with points pt 7 ps spot lc palette title 'chaotic'") \
    .some('$undecided', |$undecided|, " with points pt 2 ps spot lc rgb black title 'undecided'")
