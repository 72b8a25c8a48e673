# page.gp - what all pictures share. It stands before each of them; the variables that it takes are set above it.
#
# A page is laid out in pixels, 900 wide. Set width, height and panels (1: a picture of one panel), then `eval page`.
# On the screen it grows with --size, its letters with it. In print letters are 8 pt high, whatever the size; a page
# of 900 is then 178 mm wide, two columns of a journal, and a picture of one panel takes 435: one column, 86 mm.

# --- colours: all of them. Colours of lines are near to Okabe and Ito's, for all kinds of sight; the scale is viridis,
# which grows lighter throughout. Two lines of one panel that are alike in grey have other dashes or signs.
blue = '#0072B2'; vermillion = '#D55E00'; green = '#009E73'; purple = '#8320E4'; sky = '#56B4E9'
orange = '#E8AA00'; dark_red = '#8B1A00'; black = '#000000'; white = '#FFFFFF'
# the same on the far side of a sphere, and areas
far_blue = '#A9CDE2'; far_vermillion = '#F0BE9B'; pale_blue = '#CFE3F2'; pale_yellow = '#F7E3B0'
pale_purple = '#D9A9C6'; pale_green = '#8FCBB4'
# greys from dark to light: words, axes, what only helps; chaos, and what has no value; grids, areas
ink = '#404040'; words = '#505050'; axes = '#606060'; help = '#707070'; outline = '#8A939B'; behind = '#909090'
grey = '#B0B0B0'; others = '#B4BABF'; near_grid = '#B9C0C7'; grid = '#DDE1E5'; band = '#E8ECEF'; sphere = '#F4F6F8'

# dash and colour of the i-th of several lines, `ls i` with i from 1: colour-blind readers tell no more than seven
# colours apart, so the last three repeat colours with other dashes
strokes = 10
set style line 1 dt 1 lc rgb blue
set style line 2 dt (8,3) lc rgb vermillion
set style line 3 dt (8,3,2,3) lc rgb green
set style line 4 dt (2,3) lc rgb black
set style line 5 dt (12,4) lc rgb purple
set style line 6 dt 1 lc rgb orange
set style line 7 dt (4,4) lc rgb sky
set style line 8 dt (2,2) lc rgb blue
set style line 9 dt (12,3,2,3,2,3) lc rgb green
set style line 10 dt (5,2) lc rgb orange
viridis = "set palette defined (0 '#440154', 1 '#472C7A', 2 '#3B518B', 3 '#2C718E', 4 '#21908D', 5 '#27AD81', \
6 '#5CC863', 7 '#AADC32', 8 '#FDE725')"
# the same without its lightest part, for dots: yellow ones are not seen on white
viridis_dots = "set palette defined (0 '#440154', 1 '#472C7A', 2 '#3B518B', 3 '#2C718E', 4 '#21908D', 5 '#27AD81', \
6 '#5CC863', 7 '#AADC32', 7.36 '#C8E02D')"
exponents = sprintf("set palette defined (0 '%s', 0.5 '%s', 1 '%s')", pale_yellow, orange, dark_red)
# of a colour above its number, for `lc rgb variable`
code(colour) = int('0x'.colour[2:])

# --- the page
min(a, b) = a < b ? a : b
max(a, b) = a > b ? a : b
round(x) = floor(x + 0.5)
page = 'scale = in_print ? 178 / 25.4 * per_inch / 900 : given_width > 0 ? \
min(1.0 * given_width / width, 1.0 * given_height / height) : per_pixel; \
narrow = in_print && panels == 1 && given_width == 0; \
if (given_width > 0) { width = round(1.0 * given_width / scale); height = round(1.0 * given_height / scale) }; \
if (narrow) { height = height * 435.0 / width + 90; width = 435; title = narrow_title }; \
letter = in_print ? per_inch / 9.0 : 13 * scale; \
size_x = given_width > 0 ? given_width : width * 1.0 * scale; size_y = given_width > 0 ? given_height : height * scale; \
if (unit eq "") { size_x = round(size_x); size_y = round(size_y) }; \
eval sprintf("set terminal %s fontscale %.4g linewidth %.4g size %.17g%s,%.17g%s", terminal, 1.0 * letter / per_letter, \
    1.0 * lines * scale / per_pixel, size_x, unit, size_y, unit) \
    .(points > 0 ? sprintf(" pointscale %.4g", 1.0 * points * scale / per_pixel) : "")'

# heights and places on the page in pixels from its upper left corner
across(x) = x * 1.0 / width
down(y) = 1 - y * 1.0 / height
# the axes of the next panel, in pixels: eval box(left, right, top, bottom)
box(l, r, t, b) = sprintf("set lmargin at screen %.6f; set rmargin at screen %.6f; set tmargin at screen %.6f; \
set bmargin at screen %.6f", across(l), across(r), down(t), down(b))

# axes on the left and below, with a grid; axes on all sides
axes_left = "set border 3 lc rgb axes; set tics nomirror out scale 0.6; set grid back lt 1 lw 0.8 lc rgb grid"
axes_all = "set border 15 lw 0.8 lc rgb axes; set tics out scale 0.6 nomirror; unset grid"
angles = "set xrange [-pi:pi]; set xtics ('−π' -pi, '−π/2' -pi/2, '0' 0, 'π/2' pi/2, 'π' pi)"
# a panel that is the whole page, without axes, for titles and keys
whole_page = "unset border; unset tics; unset label; unset arrow; unset object; unset title; unset logscale; \
unset grid; unset xlabel; unset ylabel; set size noratio; set xrange [0:1]; set yrange [0:1]; set lmargin at screen 0; \
set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0"
set encoding utf8
set datafile missing NaN
set datafile columnheaders
# a letter with an index. A sign that is not seen stands before a blank that follows it: some renderers of SVG drop a
# blank at the beginning of a piece of a text.
sub(letter, i) = sprintf("%s_%d\342\201\240", letter, i)
