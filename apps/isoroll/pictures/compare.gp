# compare.gp - one orbit on the ball's sphere and on the point's, coloured by its phase t, with the same number at the
# same state; below, equal states joined between the two clocks.
# $states, $curve: t_part, s_part, colour, number, and of both spheres ball_right, ball_up, ball_near, point_right, ...
# $axes: of, right, up, tip_right, tip_up, number, number_right, number_up. Lines of words: rolls, potential, drawn,
# result; t_end, s_end. The whole picture is one plot, in pixels from the lower left corner.
width = 900; height = 670; panels = 2
eval page
set datafile missing # a line ends where it goes to the other side
R = 150; centre = 395; upper = 190; lower = 110 # of the spheres; of the rails of both clocks
middle(i) = i ? 710 : 190
of(i) = i ? 'point' : 'ball'

# of a page of another shape the picture takes the middle: circles stay round
eval whole_page
grown = max(900.0 / width, 670.0 / height) / 2
set xrange [450 - grown * width:450 + grown * width]; set yrange [335 - grown * height:335 + grown * height]
unset key

# --- words. No label has two fonts or a blank beside a change of height: renderers of SVG do not agree on the place of
# what follows.
set label title at 450,646 center noenhanced font ',14'
set label rolls at 22,616 left noenhanced font ',11'
set label potential at 878,616 right font ',11'
set label 'the ball: n, the normal where it touches' at 22,594 left tc rgb words
set label 'the point: γ, its place' at 878,594 right tc rgb words
set label 'γ =' at 392,415 center font ',16'
set label 'J^{−1/2}n' at 466,432 center font ',15'
set label '|J^{−1/2}n|' at 466,397 center font ',15'
set arrow from 422,415 to 510,415 nohead lw 1.2 lc rgb black
set label 'same number,' at 450,351 center tc rgb words
set label 'same state' at 450,333 center tc rgb words
set label 'the clock t of the ball: equal steps' at 60,217 left
set label sprintf('t = %.4g', t_end) at 840,217 right
set label 'the clock s of the point: the same states; each clock has its own scale' at 60,83 left
set label sprintf('s = %.4g', s_end) at 840,83 right
set label drawn at 450,48 center noenhanced tc rgb words
set label result at 450,24 center noenhanced

# --- what is drawn: behind the sphere in pale colours, then in front; then the ladder: thin rungs, rungs with numbers,
# the numbers. A hidden number is off the page: gnuplot 5.4 crashes if all labels are NaN.
do for [i=0:1] {
    set object circle at middle(i),centre size R back fc rgb sphere fs solid border lc rgb outline
}
x(i, right) = middle(i) + R * right
y(up) = centre + R * up
seen(i, near) = column(of(i).'_near') == near
at_x(i) = x(i, column(of(i).'_right'))
at_y(i) = y(column(of(i).'_up'))
clock(i) = i ? 's_part' : 't_part'
pale = "(mixed(viridis_colour(column('colour')), code(sphere), 0.7))"
bright = "(viridis_colour(column('colour')))"
letter_colour = "(column('t_part') < 0.6 ? code(white) : 0)"
ring = "with points pt 7 ps 2.15 lc rgb white"
disc = "with points pt 7 ps 1.85 lc rgb variable"
number = "with labels center font ',8' tc rgb variable"
state(i, near) = column('number') >= 0 && seen(i, near) ? at_x(i) : NaN
state_number(i, near) = column('number') >= 0 && seen(i, near) ? at_x(i) : -1000
text = "(sprintf('%d', column('number') >= 0 ? column('number') : 0))"
rung(part) = 70 + 760 * column(part)
end(part) = column('number') >= 0 ? rung(part) : NaN
end_number(part) = column('number') >= 0 ? rung(part) : -1000
plot for [i=0:1] for [c=0:10] [a=-pi/72:2*pi] '+' using (x(i, globe_x(-1, c, a))):(y(globe_y(c, a))) \
        with lines lw 0.6 lc rgb grid, \
    for [i=0:1] $axes using (strcol('of') eq of(i) ? x(i, column('right')) : NaN):(y(column('up'))): \
        (R * (column('tip_right') - column('right'))):(R * (column('tip_up') - column('up'))) \
        with vectors nohead lw 1.2 lc rgb axes, \
    for [i=0:1] $axes using (strcol('of') eq of(i) ? x(i, column('number_right')) : -1000):(y(column('number_up'))): \
        (sprintf('%d', column('number'))) with labels center tc rgb ink, \
    for [i=0:1] $curve using (seen(i, 0) ? at_x(i) : NaN):(at_y(i)):@pale with lines lw 2 lc rgb variable, \
    for [i=0:1] $states using (state(i, 0)):(at_y(i)) @ring, \
    for [i=0:1] $states using (state(i, 0)):(at_y(i)):@pale @disc, \
    for [i=0:1] $states using (state_number(i, 0)):(at_y(i)):@text:(code(help)) @number, \
    for [i=0:1] for [c=0:10] [a=-pi/72:2*pi] '+' using (x(i, globe_x(1, c, a))):(y(globe_y(c, a))) \
        with lines lw 0.7 lc rgb near_grid, \
    for [i=0:1] $curve using (seen(i, 1) ? at_x(i) : NaN):(at_y(i)):@bright with lines lw 3 lc rgb variable, \
    for [i=0:1] $states using (state(i, 1)):(at_y(i)) @ring, \
    for [i=0:1] $states using (state(i, 1)):(at_y(i)):@bright @disc, \
    for [i=0:1] $states using (state_number(i, 1)):(at_y(i)):@text:@letter_colour @number, \
    $states using (rung('t_part')):(upper):(rung('s_part') - rung('t_part')):(lower - upper):@bright \
        with vectors nohead lw 0.8 lc rgb variable, \
    $states using (end('t_part')):(upper):(rung('s_part') - rung('t_part')):(lower - upper):@bright \
        with vectors nohead lw 2.5 lc rgb variable, \
    for [i=0:1] $states using (end(clock(i))):(i ? lower : upper) @ring, \
    for [i=0:1] $states using (end(clock(i))):(i ? lower : upper):@bright @disc, \
    for [i=0:1] $states using (end_number(clock(i))):(i ? lower : upper):@text:@letter_colour @number
