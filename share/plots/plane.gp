# PLANE.png: the facula maps of a receiver, for the beam and for all light, and the sizes of its sunflecks. What does not exist, such
# as all of the beam under an overcast sky, leaves its room to the rest. North is up, west is left.
# The table has x_m (south) and z_m (west), or x_m (east) and y_m (north).
#   gnuplot -e "table = 'plane_0.500.csv'; flecks = 'plane_0.500_flecks.csv'" plane.gp > plane.png
# The program sets these variables before it loads this file:
if (!exists("table")) table = 'plane_0.000.csv'
if (!exists("flecks")) flecks = ''  # the table of fleck sizes; empty without a beam
if (!exists("band")) band = 'PAR'
if (!exists("beam")) beam = NaN     # horizontal irradiance of the beam in that band, W m-2

folder = ''
do for [i = strlen(ARG0):1:-1] { if (folder eq '' && ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder . 'style.gp'
load folder . 'table.gp'
if (!exists("title")) title = table_title

# The beam: the sunlit share of each cell times the irradiance of the beam. The landings in the table fluctuate with the number
# of rays that happened to cross each cell, which would show as grain in full sun.
ks = column_of('sunfleck'); kd = column_of(band . '_direct'); kt = column_of(band . '_total')
direct(x) = beam == beam && valid(ks) ? beam * column(ks) : column(kd)
total(x) = column(kt) - column(kd) + direct(x)

# The colours reach at least to the full beam, and beyond it to all but the brightest cells, whose excess is noise: four standard
# deviations above the mean.
stats table using (total(0)) name 'TOTAL' nooutput
bright = TOTAL_mean + 4 * TOTAL_stddev
bright = bright > TOTAL_max ? TOTAL_max : bright
bright = positive(beam > bright ? beam : bright, 1)

# The share and the number of flecks, under the title.
ratio = number(after('sunfleck ratio ')); error = number(past('error ', after('sunfleck ratio ')))
count = number(past(': ', after('flecks ')))
few = after('no sizes of flecks: ')
sizes = flecks ne '' && count > 0
if (sizes) {
  stats flecks using 1:4 name 'SIZE' nooutput
  stats flecks using 2 name 'UPPER' nooutput
}
note = ratio == ratio ? sprintf('Sunfleck ratio %.4f', ratio) . (error == error ? sprintf(' ± %.2g', error) : '') \
  . (count == count ? sprintf('   ·   %d fleck%s', count, count == 1 ? '' : 's') : '') \
  . (few eq '' ? sprintf('   ·   %.1f beam rays a cell', number(past('; ', after('sunfleck ratio ')))) \
    : '   ·   no sizes of flecks: ' . up_to(';', few)) \
  : 'No direct beam'
maps = ratio == ratio ? 2 : 1

# The maps stand side by side above the sizes, and low ones beside a taller colour bar. A single one stands in the middle.
widest = maps == 2 ? 590.0 : 1180.0
base = sizes ? 500 : 125
load folder . 'map.gp'
slot = map_width > 340 ? map_width : 340
left1 = 150 + widest - 0.5 * (slot + map_width)
left2 = maps == 2 ? left1 + slot + 50 : 755 - 0.5 * map_width
set cbrange [0:bright]
unset colorbox
set label 1 cut(title, 70) . ' – plane at ' . sprintf('%.3f m', number(place)) at screen 0.5,(1 - 40 / height) center \
  font ',24' textcolor '#101010'
set label 2 note at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
set label 3 (east ? 'y (m), from south to north' : 'X (m), from north to south') at screen ((maps == 2 ? left1 : left2) - 100) / width,(bottom + 0.5 * map_height) / height center rotate by 90

do for [map = 3 - maps:2] {
  left = map == 1 ? left1 : left2
  set lmargin at screen left / width
  set rmargin at screen (left + map_width) / width
  set title (map == 1 ? 'Direct ' : 'Total ') . band offset 0,-0.3
  if (map == 2) {
    if (maps == 2) { unset label; set format y '' }
    set colorbox vertical user origin screen (left + map_width + 30) / width,base / height size screen 30 / width,bar / height bdefault
    set label 4 band . ' downwards (W m⁻²)' at screen (left + map_width + 185) / width,(bottom + 0.5 * map_height) / height \
      center rotate by 90
  }
  if (boxes) {
    plot table using column_a:column_b:(half_a):(half_b):(map == 1 ? direct(0) : total(0)) with boxxyerror fillcolor palette fillstyle solid notitle
  } else {
    plot table using column_a:column_b:(map == 1 ? direct(0) : total(0)) with image notitle
  }
}

if (sizes) {
  unset title; unset label; unset colorbox
  set format y '%g'
  set lmargin at screen 150 / width
  set rmargin at screen 1540 / width
  set bmargin at screen 120 / height
  set tmargin at screen 350 / height
  set xlabel 'Area of a fleck (cm²); above the columns: number of flecks' offset 0,0.2
  set label 3 'Share of plane (%)' at screen 50 / width,235 / height center rotate by 90
  set grid noxtics ytics back linetype 1 linecolor '#d9d9d9' linewidth 0.5
  set xtics autofreq
  most = 125 * SIZE_max_y
  set logscale x
  set xrange [10 ** floor(log10(SIZE_min_x) + 1e-9):10 ** ceil(log10(UPPER_max) - 1e-9)]
  set yrange [0:most]
  set ytics step(most, 50 / 230.0)
  plot flecks using (sqrt($1 * $2)):(100 * $4):1:2:(0):(100 * $4) with boxxyerror fillcolor rgb colour[1] fillstyle solid 0.8 \
      border linecolor '#ffffff' notitle, \
    flecks using (sqrt($1 * $2)):(100 * $4):(sprintf('%d', $3)) with labels offset 0,0.7 font ',17' notitle
}
unset multiplot
