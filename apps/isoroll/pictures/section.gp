# section.gp - a section of both models: the ball's on the left, the point's on the right.
# $ball, $point: right, up, shade (0: in colours, 1: grey, 2: dark), colour; if `images`: matrices of colours, or -1
# (grey), -2 (dark), -3 (nothing). ball_x0, ball_x1, ball_y0, ball_y1: the ends of the axes; ball_title, ball_right,
# ball_up: their names; the same with point_. bar: 1: colours are rotation numbers from low to high; else hues.
# window: only a part is drawn; few: few spots. $boundary: l, low, high: the point stays between low and high.
# grey_means, dark_means: for the key; "": there are none. Over it: $ball_orbits (right, up, stable; lines stable and
# unstable say whether there are any), $ball_leaves and $ball_enters (right, up; line curves), the same with point_.
keys = (grey_means ne '') + (dark_means ne '') + stable + unstable + curves
below = 66 + (keys > 2 ? 50 : keys > 0 ? 30 : 0)
width = 900; panels = 2; height = 404 + below
eval page
bottom = height - below; right = width - (bar ? 120 : 16); wide = (right - 76 - 84) / 2.0

# --- colours of spots. Without `bar` each orbit has its own hue, neither pale nor dark.
part(hue) = int(255 * (0.47 + 0.36 * cos(2 * pi * hue) - 0.03 * cos(4 * pi * hue)))
by_hue(hue) = part(hue) * 65536 + part(hue - 1 / 3.0) * 256 + part(hue - 2 / 3.0)
grey_code = code(grey); dark_code = code(ink); white_code = code(white)
look(shade, colour) = shade == 1 ? grey_code : shade == 2 ? dark_code : bar ? palette(colour) : by_hue(colour)
cell(value) = value == -3 ? white_code : look(value < 0 ? -value : 0, value)
eval viridis_dots
set cbrange [low:high]

# --- one side: many spots are drawn small; if there are few, the coloured ones are large
spot = min(max(9 / sqrt(|$ball| + 1), 0.08), 0.4)
cells = images ? words($ball[1]) : 1  # across, and up
spots(side) = images ? sprintf("$%s matrix every :::1 using \
        (%s_x0 + (%s_x1 - %s_x0) * ($1 + 0.5) / cells):(%s_y0 + (%s_y1 - %s_y0) * ($2 - 0.5) / cells):(cell($3)) \
        with rgbimage notitle", side, side, side, side, side, side, side) : \
    few ? '$'.side.' using 1:2:($3 > 0 ? 0.45 : 1.1):(look($3, $4)) with points pt 7 ps variable lc rgb variable \
        notitle' : \
    '$'.side.' using 1:2:(look($3, $4)) with points pt 7 ps spot lc rgb variable notitle'
over(side) = (curves ? ', $'.side.'_enters using 1:2 with lines lw 1.4 dt (12,7) lc rgb blue notitle, $'.side.'_leaves \
        using 1:2 with lines lw 1.4 lc rgb vermillion notitle' : '') \
    .(unstable ? ', $'.side.'_orbits using 1:($3 == 1 ? NaN : $2) with points pt 2 ps 0.8 lw 1.6 lc rgb black \
        notitle' : '') \
    .(stable ? ', for [under=1:0:-1] $'.side.'_orbits using 1:($3 == 1 ? $2 : NaN) with points pt (under ? 7 : 6) \
        ps 0.9 lw 1.6 lc rgb (under ? white : black) notitle' : '')
ends(side) = sprintf("set xrange [%s_x0:%s_x1]; set yrange [%s_y0:%s_y1]; set title %s_title offset 0,-0.5 noenhanced; \
    set xlabel %s_right offset 0,0.3 noenhanced; set ylabel %s_up offset 1,0 noenhanced", \
    side, side, side, side, side, side, side)

set multiplot
eval axes_all
eval angles
if (window) { set xtics autofreq }
unset key
set label 1 title at screen 0.015,down(18) left noenhanced font ',12'
eval ends('ball')
eval box(76, 76 + wide, 66, bottom)
eval 'plot '.spots('ball').over('ball')

unset label 1
set style fill solid noborder
eval ends('point')
eval box(right - wide, right, 66, bottom)
set cblabel 'rotation number: turns from crossing to crossing' offset 0.5,0
set colorbox user origin across(right + 13),down(bottom - 31) size across(12.6),across(bottom - 122) * width / height
set cbtics offset -0.5,0
# the image lies behind the area where the point cannot be
eval 'plot '.(images ? spots('point').', ' : '').'$boundary using 1:3:(point_y1) with filledcurves fc rgb band \
    notitle, $boundary using 1:2:(point_y0) with filledcurves fc rgb band notitle, \
    for [c=2:3] $boundary using 1:c with lines lw 1 lc rgb axes notitle' \
    .(bar ? ', NaN with points lc palette notitle' : '').(images ? '' : ', '.spots('point')).over('point')

# --- the key
if (keys) {
    eval whole_page
    unset colorbox
    set key at screen 0.5,down(height - (keys > 2 ? 32 : 20)) center horizontal maxcols 3 Left reverse samplen 1.5 \
        width 2
    entry(there, looks, words) = there ? sprintf(", NaN with %s title '%s'", looks, words) : ''
    eval 'plot NaN notitle'.entry(grey_means ne '', 'points pt 7 ps 1 lc rgb grey', grey_means) \
        .entry(dark_means ne '', 'points pt 7 ps 1 lc rgb ink', dark_means) \
        .entry(stable, 'points pt 6 ps 0.9 lw 1.6 lc rgb black', 'stable periodic orbit') \
        .entry(unstable, 'points pt 2 ps 0.8 lw 1.6 lc rgb black', 'unstable periodic orbit') \
        .entry(curves, 'lines lw 1.4 lc rgb vermillion', 'leaves the unstable rotation') \
        .entry(curves, 'lines lw 1.4 dt (12,7) lc rgb blue', 'enters it')
}
