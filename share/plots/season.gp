# season.png: what each kind of organs absorbed on each of several dates, in one band. Above, the energy of all kinds and what was
# reflected stand on one another, so that their top is what arrived unless light falls through the ground; below, each kind's share of what arrived, with its interval.
#   gnuplot season.gp > season.png
# reads season.csv and day_sums.csv in the current folder. The program sets these variables before it loads this file:
if (!exists("table")) table = 'season.csv'
if (!exists("sums")) sums = 'day_sums.csv'
if (!exists("band")) band = 'PAR'

folder = ''
do for [i = strlen(ARG0):1:-1] { if (folder eq '' && ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder . 'style.gp'
load folder . 'table.gp'
if (!exists("title")) title = table_title

# The table has a block of lines for each date, in which every kind has a line. Kinds beyond the six that colours can tell apart are
# drawn together.
absorbed = column_of(band . '_absorbed_ground_mj_m2'); share = column_of(band . '_absorbed_share')
if (absorbed == 0) { print no_column_of_this_band }
confidence = number(past('confidence ', after('seed ')))
stopped = after('incomplete: ')
midnight(date) = strptime('%Y-%m-%d', date)
first_date = ''; last_date = ''; kinds = 0; rows = 0
stats table using (first_date = first_date eq '' ? strcol(1) : first_date, last_date = strcol(1), \
  kinds = strcol(1) eq first_date ? kinds + 1 : kinds, rows = rows + 1, 0) nooutput
if (rows == 0) { print no_dates }
dates = rows / kinds
array name[kinds]; array role[kinds]; array whole[kinds]
do for [k = 1:kinds] { name[k] = ''; role[k] = ''; whole[k] = 0.0 }
row = 0
kind(i) = i % kinds + 1
stats table using (k = kind(row), row = row + 1, name[k] = strcol(2), role[k] = strcol(3), \
  whole[k] = whole[k] + (valid(absorbed) ? column(absorbed) : 0.0), 0) nooutput

# Leaves are green and soil is brown; other kinds take the remaining colours in turn.
array spare[4] = ['#56B4E9', '#E69F00', '#CC79A7', '#0072B2']
array paint[kinds + 1]
taken = 0; first_leaf = 0; drawn_kinds = 0
array place[kinds]  # of each kind among those drawn, from the bottom; 0 for one that absorbs nothing
do for [k = 1:kinds] {
  place[k] = 0
  if (whole[k] > 0) {
    drawn_kinds = drawn_kinds + 1
    place[k] = drawn_kinds
    if (role[k] eq 'soil') { paint[drawn_kinds] = '#A6611A' } else {
      if (role[k] eq 'leaf' && !first_leaf) { paint[drawn_kinds] = '#009E73'; first_leaf = k } else {
        if (taken < 4) { taken = taken + 1; paint[drawn_kinds] = spare[taken] } else { paint[drawn_kinds] = '#7F7F7F' }
      }
    }
  }
}
layers = drawn_kinds + 1  # and what was reflected
paint[layers] = '#BDBDBD'

# For each date the middle of its day, and for each layer of it the edge at its top, the half-width of its energy, and its share with
# that of the interval; the edge 0 of a date is the ground line.
array label[layers]
do for [k = 1:kinds] { if (place[k] > 0) { label[place[k]] = name[k] } }
label[layers] = 'reflected'
array day_of[dates]; array edge[dates * (layers + 1)]; array half[dates * layers]; array part[dates * layers]; array error[dates * layers]
do for [i = 1:dates * layers] { half[i] = 0.0; part[i] = NaN; error[i] = 0.0 }
do for [i = 1:dates * (layers + 1)] { edge[i] = 0.0 }
row = 0
cell(c) = c > 0 && valid(c) ? column(c) : NaN
known(x) = x == x ? x : 0.0
put(d, l, energy, its_half, its_share, its_error) = (edge[(d - 1) * (layers + 1) + l + 1] = edge[(d - 1) * (layers + 1) + l] + known(energy), \
  half[(d - 1) * layers + l] = known(its_half), part[(d - 1) * layers + l] = its_share, error[(d - 1) * layers + l] = known(its_error))
stats table using (k = kind(row), d = row / kinds + 1, row = row + 1, day_of[d] = midnight(strcol(1)) + 43200, \
  place[k] > 0 ? put(d, place[k], cell(absorbed), cell(absorbed + 1), cell(share), cell(share + 1)) : 0, 0) nooutput

table = sums
load folder . 'table.gp'
arrived = column_of(band . '_incident_mj_m2'); reflected = column_of(band . '_reflected_mj_m2'); mol = column_of(band . '_incident_mol_m2')
row = 0; most = 0.0; photons = NaN; incident = 0.0; sent_back = 0.0
stats table using (row = row + 1, incident = known(cell(arrived)), sent_back = known(cell(reflected)), \
  row <= dates ? put(row, layers, sent_back, cell(reflected + 1), incident > 0 ? sent_back / incident : NaN, \
    incident > 0 ? cell(reflected + 1) / incident : 0) : 0, \
  most = incident > most ? incident : most, incident > 0 && cell(mol) > 0 ? photons = column(mol) / incident : 0, 0) nooutput
do for [d = 1:dates] { top = edge[d * (layers + 1)]; if (top > most) { most = top } }
highest = 0.0
do for [i = 1:dates * layers] { if (part[i] == part[i] && part[i] + error[i] > highest) { highest = part[i] + error[i] } }
set datafile separator whitespace
unset datafile columnheaders
set print $points
do for [d = 1:dates] { print d }
unset print

begin = midnight(first_date); end = midnight(last_date) + 86400
span = (end - begin) / 86400
width = 1600.0; height = 1100.0
twofold = photons == photons
set terminal pngcairo noenhanced size width,height font font . ',20' linewidth 2 background '#ffffff'
set multiplot
set lmargin at screen 150 / width
set rmargin at screen (twofold ? 1440 : 1510) / width
set xdata time
set timefmt '%s'
set xrange [begin:end]
apart = ceil(0.13 * span)
set xtics (begin + 43200)
do for [d = 1:span - 1] {
  if (d % apart == 0) { set xtics add (begin + 86400 * d + 43200) } else { if (apart < 10) { set xtics add ('' begin + 86400 * d + 43200 1) } }
}

set label 1 cut(title, 84) at screen 0.5,(1 - 40 / height) center font ',25' textcolor '#101010'
set label 2 (stopped eq '' ? '' : 'Incomplete: ' . stopped . '   ·   ') \
  . sprintf('Bars and shaded: %g %% confidence intervals', 100 * confidence) \
  at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
bottom = 440; upper = 925
set bmargin at screen bottom / height
set tmargin at screen upper / height
middle = 0.5 * (bottom + upper)
set label 3 band . ' (MJ m⁻² d⁻¹ of ground)' at screen 50 / width,middle / height center rotate by 90
set format x ''
top = positive(1.1 * most, 1)
set yrange [0:top]
if (twofold) {
  set label 4 band . ' (mol m⁻² d⁻¹ of ground)' at screen 1560 / width,middle / height center rotate by 90
  set ytics nomirror
  set y2range [0:photons * top]
  set y2tics
}
set key at screen 150 / width,(1 - 104 / height) left top horizontal maxcols 6 Left reverse samplen 2 font ',19'
# A date's layers fill its day; thin white lines part the days where there is room for them.
side = 0.5 * 86400 * (span > 90 ? 1.02 : 0.86)
# Intervals that would be lower than the line are left out.
seen = 4.0 * top / (upper - bottom)
its(l) = half[($1 - 1) * layers + l]
low(l) = edge[($1 - 1) * (layers + 1) + l]; high(l) = edge[($1 - 1) * (layers + 1) + l + 1]
set style fill solid 1.0 noborder
plot for [l = 1:layers] $points using (day_of[$1]):(high(l)):(day_of[$1] - side):(day_of[$1] + side):(low(l)):(high(l)) \
    with boxxyerror linecolor rgb paint[l] notitle, \
  for [l = 1:layers] $points using (day_of[$1]):(its(l) > seen ? high(l) - its(l) : NaN):(0):(2 * its(l)) \
    with vectors nohead linecolor '#202020' linewidth 0.9 notitle, \
  for [l = 1:layers] keyentry with boxes linecolor rgb paint[l] title label[l]

unset key; unset label; unset y2tics
set bmargin at screen 125 / height
set tmargin at screen 390 / height
set format x '%Y-%m-%d'
set yrange [0:positive(1.08 * highest < 1 ? 1.08 * highest : 1.0, 1)]
set ytics autofreq mirror
set label 3 'Share of ' . band at screen 50 / width,257.5 / height center rotate by 90
set xlabel 'Local date' offset 0,0.2
set style fill transparent solid 0.3 noborder
of(l) = part[($1 - 1) * layers + l]; around(l) = error[($1 - 1) * layers + l]
size = dates > 60 ? 0.4 : 0.7
# Without a gap of dates the points are joined.
plot for [l = 1:layers] $points using (day_of[$1]):(of(l) - around(l)):(of(l) + around(l)) with filledcurves linecolor rgb paint[l] notitle, \
  for [l = 1:layers] $points using (day_of[$1]):(of(l)) with linespoints linecolor rgb paint[l] linewidth 1.4 pointtype 7 pointsize size notitle
unset multiplot
