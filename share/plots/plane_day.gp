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
dates = number(after('dates ')); steps = number(past('steps ', after('dates '))); hours = number(past('direct beam ', after('dates ')))
stats table using (column(shown)) name 'LIGHT' nooutput
maps = hours > 0 ? 2 : 1
if (maps == 2) { stats table using (valid(ks) ? column(ks) : 0) name 'SUN' nooutput }

# The maps stand side by side, each with its own colour bar; a single one stands in the middle.
widest = maps == 2 ? 480.0 : 1180.0
base = 125
load folder . 'map.gp'
slot = 1500.0 / maps
set label 1 cut(title, 60) . ' – plane at ' . sprintf('%.3f m', number(place)) at screen 0.5,(1 - 40 / height) center \
  font ',24' textcolor '#101010'
set label 2 sprintf('%d date%s, %d step%s', dates, dates == 1 ? '' : 's', steps, steps == 1 ? '' : 's') \
  . (hours > 0 ? sprintf('   ·   %.1f hours with a direct beam', hours) : '   ·   no direct beam') \
  at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
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
