# indicators.gp - indicators of chaos against the turns, of the ball and of the point.
# $ball, $point: turn, growth, megno, mean, gali2; of one of them there may be no row.
width = 900; panels = 3; height = 640
eval page
x(pixels) = pixels * width / 900.0; y(pixels) = pixels * height / 640.0  # a page of another size
eval axes_left
set multiplot
set label 1 title at screen 0.5,down(22) center noenhanced font ',12'
# a column of the models that have rows; the point's line is wider, and seen below the ball's
line(side, rows, column, looks) = rows > 1 ? sprintf(", $%s using 'turn':'%s' with lines %s", side, column, looks) : ''
both(column, ball, point) = line('ball', |$ball|, column, 'dt 1 lw 1.6 lc rgb blue title '.ball) \
    .line('point', |$point|, column, 'dt 1 lw 2.4 lc rgb orange title '.point)

set key left top Left reverse samplen 3 spacing 1.2
set xlabel 'turns' offset 0,0.4; set ylabel 'ln |d|, d: a small distance' offset 0.5,0
eval box(x(76), x(882), y(51), y(272))
eval 'plot NaN notitle'.both('growth', "'ball'", "'point'")

unset label 1
eval box(x(76), x(432), y(336), y(582))
set arrow 1 from graph 0, first 2 to graph 1, first 2 nohead back dt (3,3) lw 1.2 lc rgb help
set ylabel 'MEGNO'
eval 'plot NaN notitle'.line('ball', |$ball|, 'megno', "dt 1 lw 1.6 lc rgb blue title 'ball'") \
    .line('ball', |$ball|, 'mean', "dt (6,3) lw 1.6 lc rgb blue title 'ball, mean'") \
    .line('point', |$point|, 'megno', "dt 1 lw 2.4 lc rgb orange title 'point'") \
    .line('point', |$point|, 'mean', "dt (2,3) lw 2.4 lc rgb orange title 'point, mean'")

unset arrow 1
eval box(x(527), x(882), y(336), y(582))
set logscale y; set key right top; set format y '10^{%T}'; set yrange [*:2]; set ylabel sub('GALI', 2)
eval 'plot NaN notitle'.both('gali2', "'ball'", "'point'")
