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
viridis_dots = "set palette defined (0 '#440154', 1 '#472977', 2 '#3D4B88', 3 '#30698D', 4 '#25868D', 5 '#25A186', \
6 '#43BB71', 7 '#7ED14D', 8 '#C8E02D')"
exponents = "set palette defined (0 '#F7E3B0', 0.5 '#E8AA00', 1 '#8B1A00')" # pale_yellow, orange, dark_red

# --- the page
min(a, b) = a < b ? a : b
max(a, b) = a > b ? a : b
nearest(x) = floor(x + 0.5) # gnuplot 6 has a function called round itself
page = 'scale = in_print ? 178 / 25.4 * per_inch / 900 : given_width > 0 ? \
min(1.0 * given_width / width, 1.0 * given_height / height) : per_pixel; \
narrow = in_print && panels == 1 && given_width == 0; \
if (given_width > 0) { width = nearest(1.0 * given_width / scale); height = nearest(1.0 * given_height / scale) }; \
if (narrow) { height = height * 435.0 / width + 90; width = 435; title = narrow_title }; \
letter = in_print ? per_inch / 9.0 : 13 * scale; \
size_x = given_width > 0 ? given_width : width * 1.0 * scale; size_y = given_width > 0 ? given_height : height * scale; \
if (unit eq "") { size_x = nearest(size_x); size_y = nearest(size_y) }; \
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

# a number of a data block, number(word($block[2], 3)): gnuplot 5.4 takes no text such as 5e-05 without a dot
number(w) = real(strstrt(w, 'e') && !strstrt(w, '.') ? w[1:strstrt(w, 'e') - 1].'.0'.w[strstrt(w, 'e'):*] : w)

# --- numbers at an axis. gnuplot's own ticks of long times overlap ("200000400000600000"), and those of late times are
# all alike. Here what they have in common goes into the name of the axis: "t / 10⁶", "t − 1000000". Set tick_name, what
# the numbers are, then `eval ticks('x', low, high, most)`: range and about `most` ticks of this axis; tick_text becomes
# what they mean, such as "×10⁶" if tick_name is ''. `eval named('x', ...)` sets the label of the axis, too.
raised(n) = n < 0 ? '⁻'.raised(-n) : (n > 9 ? raised(n / 10) : '').substr('⁰¹²³⁴⁵⁶⁷⁸⁹', n % 10 + 1, n % 10 + 1)
# i steps as text, from tick_base and over 10^tick_power
tick_number(i) = (i < tick_base ? '−' : '').sprintf(sprintf('%%.%df', max(0, tick_power - tick_place)), \
    abs(i - tick_base) * tick_step / 10.0**tick_power)
# name, name / 10⁶, name − 1000, (name − 1000) / 10⁻⁴
tick_shift(name) = tick_base == 0 ? name : \
    name.(tick_base < 0 ? ' + ' : ' − ').sprintf('%.15g', abs(tick_base * tick_step))
tick_over(name) = tick_power == 0 ? name : name eq '' ? '×10'.raised(tick_power) : \
    (tick_base == 0 ? name : '('.name.')').' / 10'.raised(tick_power)
ticks(axis, low, high, most) = sprintf("tick_axis = '%s'; tick_low = 1.0*%.17g; tick_high = 1.0*%.17g; \
tick_most = %d; ", axis, low, high, most).choose_ticks
choose_ticks = 'tick_size = max(abs(tick_low), abs(tick_high)); tick_base = 0; tick_power = 0; \
if (tick_size >= 1e300) { \
    eval "set ".tick_axis."range [*:*]; set ".tick_axis."tics autofreq" \
} else { \
    tick_room = tick_high - tick_low > max(1e-12 * tick_size, 1e-292) ? 0 : tick_size > 1e-290 ? tick_size / 2 : 0.5; \
    tick_low = tick_low - tick_room; tick_high = tick_high + tick_room; \
    tick_step = (tick_high - tick_low) / tick_most; tick_place = floor(log10(tick_step)); \
    tick_part = tick_step / 10.0**tick_place; \
    tick_digit = tick_part > 5.00001 ? 1 : tick_part > 2.00001 ? 5 : tick_part > 1.00001 ? 2 : 1; \
    if (tick_part > 5.00001) { tick_place = tick_place + 1 }; \
    tick_step = tick_digit * 10.0**tick_place; \
    tick_first = ceil(tick_low / tick_step - 1e-6); tick_last = floor(tick_high / tick_step + 1e-6); \
    if (max(abs(tick_first), abs(tick_last)) > 2000) { tick_base = tick_first }; \
    tick_most = max(abs(tick_first - tick_base), abs(tick_last - tick_base)) * tick_step; \
    tick_power = tick_most > 0 ? floor(log10(tick_most) + 1e-9) : 0; \
    if (tick_power < 5 && tick_power >= -2) { tick_power = 0 }; \
    tick_list = ""; \
    do for [tick_i=0:tick_last - tick_first] { \
        tick_list = tick_list.sprintf("%s\047%s\047 %.17g", tick_i ? ", " : "", tick_number(tick_first + tick_i), \
            (tick_first + tick_i) * tick_step) \
    }; \
    eval sprintf("set %srange [%.17g:%.17g]; set %stics nomirror out scale 0.6 norotate (%s)", tick_axis, tick_low, \
        tick_high, tick_axis, tick_list) \
}; \
tick_text = tick_over(tick_shift(tick_name eq "" && tick_base != 0 ? "number" : tick_name))'
named(axis, low, high, most) = ticks(axis, low, high, most). \
    "; eval 'set '.tick_axis.'label tick_text noenhanced offset '.(tick_axis eq 'x' ? '0,0.3' : '0.5,0')"

# --- a sphere, seen as in lib/picture/sphere.c: its place to the right and upward, and > 0 on the near side;
# meridians and parallels, 30 degrees apart, of the near side (side 1) or the far one (-1): globe_x(side, i, a), i
# from 0 to 10, a from 0 to 2 pi. gnuplot drops the first place as if it were a line of names: begin before 0.
X(x, y, z) = -0.42261826174069944 * x + 0.90630778703664996 * y
Y(x, y, z) = -0.36862823570066146 * x - 0.17189417172037236 * y + 0.91354545764260087 * z
D(x, y, z) = 0.8279521875606311 * x + 0.3860804504512761 * y + 0.40673664307580021 * z
set samples 146
globe_angle(i) = (i < 6 ? i : i - 8) * pi / 6
globe_n1(i, a) = i < 6 ? cos(a) * cos(globe_angle(i)) : cos(globe_angle(i)) * cos(a)
globe_n2(i, a) = i < 6 ? cos(a) * sin(globe_angle(i)) : cos(globe_angle(i)) * sin(a)
globe_n3(i, a) = i < 6 ? sin(a) : sin(globe_angle(i))
globe_x(side, i, a) = side * D(globe_n1(i, a), globe_n2(i, a), globe_n3(i, a)) < -0.03 ? NaN : \
    X(globe_n1(i, a), globe_n2(i, a), globe_n3(i, a))
globe_y(i, a) = Y(globe_n1(i, a), globe_n2(i, a), globe_n3(i, a))
# a colour as a number; a mixture of two of these, part from 0 to 1; viridis at z from 0 to 1
code(colour) = int('0x'.colour[2:7])
mixed(a, b, part) = mixed_byte(a, b, part, 16) * 65536 + mixed_byte(a, b, part, 8) * 256 + mixed_byte(a, b, part, 0)
mixed_byte(a, b, part, place) = nearest((1 - part) * (a >> place & 255) + part * (b >> place & 255))
array viridis_at[9] = [0x440154, 0x472C7A, 0x3B518B, 0x2C718E, 0x21908D, \
    0x27AD81, 0x5CC863, 0xAADC32, 0xFDE725]
viridis_colour(z) = mixed(viridis_at[viridis_piece(z) + 1], viridis_at[viridis_piece(z) + 2], z * 8 - viridis_piece(z))
viridis_piece(z) = min(7, floor(z * 8))
