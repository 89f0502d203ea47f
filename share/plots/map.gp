# Lays out the maps of a receiver in the shape of its plot. plane.gp and plane_day.gp load this after table.gp, with `maps` (1 or 2),
# `widest` (the room of one, pixels) and `base` (the room below, pixels), and after their own `stats`, which would heed the ranges.
place = remarks[strstrt(remarks, 'horizontal plane at ') + 20:*]
cells_1 = number(past(', ', place)); cells_2 = number(past(' x ', place))
stats table using (last_1 = $1, last_2 = $2, 0) nooutput
size_1 = last_1 * cells_1 / (cells_1 - 0.5); size_2 = last_2 * cells_2 / (cells_2 - 0.5)
# Left to right (a) and bottom to top (b).
east = column_of('y_m') > 0
column_a = east ? 1 : 2; column_b = east ? 2 : 1
size_a = east ? size_1 : size_2; size_b = east ? size_2 : size_1
cells_a = east ? cells_1 : cells_2; cells_b = east ? cells_2 : cells_1

width = 1600.0
highest = 760.0
scale = widest / size_a < highest / size_b ? widest / size_a : highest / size_b
map_width = scale * size_a; map_height = scale * size_b
bar = map_height > 260 ? map_height : 260
height = 0.0 + ceil(base + bar + 165)
bottom = base + 0.5 * (bar - map_height)
set terminal pngcairo noenhanced size width,height font font . ',20' linewidth 2 background '#ffffff'
set multiplot
# Viridis at nine positions (van der Walt and Smith 2015, matplotlib), perceptually uniform in colour and in grey.
set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', 5 '#28ae80', 6 '#5ec962', 7 '#addc30', \
  8 '#fde725')
set xrange [(east ? 0 : size_a):(east ? size_a : 0)]
set yrange [(east ? 0 : size_b):(east ? size_b : 0)]
step(length, room) = (finest = length * room, decade = 10 ** floor(log10(finest)), \
  decade * (finest <= decade ? 1 : finest <= 2 * decade ? 2 : finest <= 5 * decade ? 5 : 10))
set xtics step(size_a, 90 / map_width) out nomirror
set ytics step(size_b, 70 / map_height) out nomirror
set cbtics out
unset grid
set bmargin at screen bottom / height
set tmargin at screen (bottom + map_height) / height
set xlabel (east ? 'x (m), from west to east' : 'Z (m), from east to west') offset 0,0.2
# An image needs two cells along each side; single rows are drawn as boxes.
half_a = 0.5 * size_a / cells_a; half_b = 0.5 * size_b / cells_b
boxes = cells_a < 2 || cells_b < 2
