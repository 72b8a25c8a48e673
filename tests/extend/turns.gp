# turns.gp - the angle of each turn. $table: number, angle.
width = 900; height = 420; panels = 1
eval page
eval axes_left
set title title noenhanced
set xlabel 'turn'; set ylabel 'angle in rad'; set yrange [0:*]
plot $table using 'number':'angle' with linespoints pt 7 lw 1.5 lc rgb blue notitle
