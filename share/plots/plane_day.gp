# plane_H_day.png: the light that came down through each cell of a receiver over a day or a season, and the hours in which the sun's
# beam reached it. Without a beam only the first map is drawn. North is up, west is left.
# The table has x_m (south) and z_m (west), or x_m (east) and y_m (north).
#   gnuplot -e "table = 'plane_0.500_day.csv'" plane_day.gp > plane_0.500_day.png
# The program sets these variables before it loads this file:
if (!exists("table")) table = 'plane_0.000_day.csv'
if (!exists("band")) band = 'PAR'

folder = ''
do for [i = strlen(ARG0):1:-1] { if (folder eq '' && ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder . 'style.gp'
load folder . 'table.gp'
if (!exists("title")) title = table_title

kt = column_of(band . '_total_mj_m2'); km = column_of(band . '_total_mol_m2'); ks = column_of('sunlit_h')
if (kt == 0) { print no_column_of_this_band }
shown = km > 0 ? km : kt
place = remarks[strstrt(remarks, 'horizontal plane at ') + 20:*]
cells_1 = number(past(', ', place)); cells_2 = number(past(' x ', place))
dates = number(after('dates ')); steps = number(past('steps ', after('dates '))); hours = number(past('direct beam ', after('dates ')))
stats table using (last_1 = $1, last_2 = $2, column(shown)) name 'LIGHT' nooutput
size_1 = last_1 * cells_1 / (cells_1 - 0.5); size_2 = last_2 * cells_2 / (cells_2 - 0.5)
maps = hours > 0 ? 2 : 1
if (maps == 2) { stats table using (valid(ks) ? column(ks) : 0) name 'SUN' nooutput }

# Left to right (a) and bottom to top (b).
east = column_of('y_m') > 0
column_a = east ? 1 : 2; column_b = east ? 2 : 1
size_a = east ? size_1 : size_2; size_b = east ? size_2 : size_1
cells_a = east ? cells_1 : cells_2; cells_b = east ? cells_2 : cells_1

# The maps have the shape of the plot and stand side by side, each with its own colour bar; a single one stands in the middle.
width = 1600.0
widest = maps == 2 ? 480.0 : 1180.0; highest = 760.0
scale = widest / size_a < highest / size_b ? widest / size_a : highest / size_b
map_width = scale * size_a; map_height = scale * size_b
bar = map_height > 260 ? map_height : 260
base = 125
height = 0.0 + ceil(base + bar + 165)
bottom = base + 0.5 * (bar - map_height)
slot = 1500.0 / maps
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
set label 1 cut(title, 60) . ' – plane at ' . sprintf('%.3f m', number(place)) at screen 0.5,(1 - 40 / height) center \
  font ',24' textcolor '#101010'
set label 2 sprintf('%d date%s, %d step%s', dates, dates == 1 ? '' : 's', steps, steps == 1 ? '' : 's') \
  . (hours > 0 ? sprintf('   ·   %.1f hours with a direct beam', hours) : '   ·   no direct beam') \
  at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
set xlabel (east ? 'x (m), from west to east' : 'Z (m), from east to west') offset 0,0.2
# An image needs two cells along each side; single rows are drawn as boxes.
half_a = 0.5 * size_a / cells_a; half_b = 0.5 * size_b / cells_b
boxes = cells_a < 2 || cells_b < 2
cell(c) = valid(c) ? column(c) : NaN

do for [map = 1:maps] {
  k = map == 1 ? shown : ks
  left = 50 + slot * (map - 1) + 0.5 * (slot - map_width) - 20
  set lmargin at screen left / width
  set rmargin at screen (left + map_width) / width
  set title (map == 1 ? 'Total ' . band : 'Time in the sun') offset 0,-0.3
  set cbrange [0:(map == 1 ? positive(LIGHT_max, 1) : positive(SUN_max, 1))]
  if (map == 1) { set label 3 (east ? 'y (m), from south to north' : 'X (m), from north to south') at screen (left - 90) / width,(bottom + 0.5 * map_height) / height center rotate by 90 }
  set colorbox vertical user origin screen (left + map_width + 25) / width,base / height size screen 30 / width,bar / height bdefault
  set label 4 (map == 1 ? band . ' downwards (' . (km > 0 ? 'mol' : 'MJ') . ' m⁻²)' : 'hours') at screen (left + map_width + 170) / width,(bottom + 0.5 * map_height) / height \
    center rotate by 90
  if (boxes) {
    plot table using column_a:column_b:(half_a):(half_b):(cell(k)) with boxxyerror fillcolor palette fillstyle solid notitle
  } else {
    plot table using column_a:column_b:(cell(k)) with image notitle
  }
  unset label; set format y ''
}
unset multiplot
