# tradeoff.png: error against rays for each pass, and against time for whole runs.
#   gnuplot tradeoff.gp > tradeoff.png
# reads tradeoff.csv in the current folder. The program sets these variables before it loads this file:
if (!exists("table")) table = 'tradeoff.csv'
if (!exists("asked")) asked = NaN        # the error that a bound is recommended for,
if (!exists("seconds")) seconds = NaN    # the time of a run with that bound,
if (!exists("expected")) expected = NaN  # and the error that is expected of it
if (!exists("grid")) grid = NaN          # the grid to be marked, m

folder = ''
do for [i = strlen(ARG0):1:-1] { if (folder eq '' && ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder . 'style.gp'
load folder . 'table.gp'
if (!exists("title")) title = table_title

array quantity[4] = ['canopy', 'layer', 'organ', 'triangle']
array kind[3] = ['grid', 'packets', 'error']
array light[3] = ['direct', 'indirect', 'absorbed']
array panel[3] = ["Sun’s direct light: grids", 'All other light: packets', 'Whole runs: --error']

# The settings in the order of the table, two words each: kind and value.
settings = ''; last = ''
stats table using (last = strcol(1) eq last ? last : (settings = settings . ' ' . strcol(1), strcol(1)), 0) nooutput
n = words(settings) / 2
array time[n + 1]; array rays[n + 1]; array percent[4 * n + 4]
of_kind(i, p) = word(settings, 2 * i - 1) eq kind[p] || (p == 3 && word(settings, 2 * i - 1) eq 'mesh')
# The root mean square over the seeds, without the reference's own error; NaN where that is most of it.
add(here, error) = here ? (count = count + 1, squares = squares + error ** 2) : 0
without(own, square) = (rest = square - (own == own ? own ** 2 : 0), rest > 0 && rest >= 0.5 * square ? 100 * sqrt(rest) : NaN)
do for [i = 1:n] {
  setting = word(settings, 2 * i - 1) . ' ' . word(settings, 2 * i)
  stats table using (strcol(1) eq setting ? $3 : NaN) name 'TIME' nooutput
  stats table using (strcol(1) eq setting ? $4 : NaN) name 'RAYS' nooutput
  time[i] = TIME_median; rays[i] = RAYS_mean
  used = of_kind(i, 1) ? light[1] : of_kind(i, 2) ? light[2] : light[3]
  do for [q = 1:4] {
    count = 0; squares = 0.0
    stats table using (add(strcol(1) eq setting && strcol(5) eq quantity[q], $6), 0) nooutput
    own = number(past(', ' . quantity[q] . ' ', after('reference of ' . used . ' light')))
    percent[4 * i + q] = count > 0 ? without(own, squares / count) : NaN
  }
}

# The law error = factor * rays ** slope that the program fitted to each pass and quantity, and the half-width of the slope.
array slope[8]; array factor[8]; array half_width[8]
do for [p = 1:2] {
  do for [q = 1:4] {
    law = past(' ' . quantity[q] . ' ', past('of the slope:', after('error of ' . light[p] . ' light')))
    factor[4 * p - 4 + q] = 100 * number(law)
    slope[4 * p - 4 + q] = number(word(law . ' - -', 2))
    half_width[4 * p - 4 + q] = number(word(law . ' - - -', 3))
  }
}
set datafile separator whitespace
set datafile missing 'NaN'
unset datafile columnheaders

# All panels share the axis of errors.
lowest = 1e300; highest = 0.0
widen(x) = x > 0 ? (lowest = x < lowest ? x : lowest, highest = x > highest ? x : highest) : 0
do for [i = 1:n] { do for [q = 1:4] { dummy = widen(percent[4 * i + q]) } }
dummy = widen(100 * asked)
if (highest == 0) { lowest = 0.1; highest = 10 }

width = 1600.0; height = 900.0
set terminal pngcairo noenhanced size width,height font font . ',20' linewidth 2 background '#ffffff'
set multiplot
set logscale xy
set format '%g'
set mxtics 10
set mytics 10
set bmargin at screen 125 / height
set tmargin at screen 680 / height
set yrange [lowest / 2.5:highest * 10]
do for [q = 1:4] {
  open = shape[q] - 1
  set style line q linecolor rgb colour[q] linewidth 1.3 pointtype shape[q] pointsize 1.5
  set style line (q + 4) linecolor rgb colour[q] linewidth 1.4 pointtype open pointsize 1.7
}
set style line 9 linecolor rgb '#000000' linewidth 1 dashtype 2
set style line 10 linecolor rgb '#000000' linewidth 1.4 pointtype 6 pointsize 2.6
# Names a setting next to its highest point.
centimetres(m) = m < 0.01 ? sprintf('%.3g mm', 1000 * m) : sprintf('%.3g cm', 100 * m)
name(kind, value) = kind eq 'grid' ? centimetres(value) : kind eq 'mesh' ? sprintf('mesh %.3g', value) : kind eq 'error' ? sprintf('%.3g', value) \
  : value >= 1024 ? sprintf('%.0f k', value / 1024) : sprintf('%.0f', value)
# Where the names placed so far in a panel are, in pixels, and whether they would hide one at this height.
array text_from[n + 1]; array text_width[n + 1]; array text_height[n + 1]
overlap(i, j) = text_from[i] < text_from[j] + text_width[j] && text_from[j] < text_from[i] + text_width[i]
hidden(i, height_of_text) = (sum [j = 1:i - 1] (overlap(i, j) && abs(height_of_text - text_height[j]) < 21)) > 0
across(i, p) = p < 3 ? rays[i] : time[i]
array across_title[3] = ['Rays', 'Packets', 'Time of a run (s)']
signed(x) = x == x ? (x < 0 ? '−' : '') . sprintf('%.2f', abs(x)) : ''
with_error(x, half) = signed(x) . (x == x && half == half ? sprintf(' ± %.2f', half) : '')

array end_place[4]; array end_error[4]
do for [p = 1:3] {
  # Columns: rays or time, the errors of the four quantities, their fitted laws, whether the mesh is coarser.
  first = p == 3 && seconds > 0 ? seconds : 1e300; last = p == 3 && seconds > 0 ? seconds : 0.0
  do for [i = 1:n] {
    if (of_kind(i, p) && across(i, p) > 0) {
      first = across(i, p) < first ? across(i, p) : first
      last = across(i, p) > last ? across(i, p) : last
    }
  }
  nothing = last == 0
  if (nothing) { first = 1.0; last = 1.0 }
  least = first / 2.2
  room = (last / least) ** (p < 3 ? 0.6 : 0.3) # a slope with its error takes three eighths of the width
  most = last * (room > 7 ? room : 7)
  named = 0
  unset label; unset arrow
  set print $points
  print 'NaN NaN NaN NaN NaN NaN NaN NaN NaN 0'
  do for [i = 1:n] {
    if (of_kind(i, p) && across(i, p) > 0) {
      top = 0.0; row = sprintf('%.9g', across(i, p))
      do for [q = 1:4] {
        top = percent[4 * i + q] > top ? percent[4 * i + q] : top
        row = row . sprintf(' %.9g', percent[4 * i + q])
      }
      do for [q = 1:4] {
        fitted = p < 3 ? (slope[4 * p - 4 + q] == slope[4 * p - 4 + q] ? factor[4 * p - 4 + q] * rays[i] ** slope[4 * p - 4 + q] : NaN) : word(settings, 2 * i - 1) eq 'mesh' ? NaN : percent[4 * i + q]
        row = row . sprintf(' %.9g', percent[4 * i + q] > 0 ? fitted : NaN)
      }
      print row . (word(settings, 2 * i - 1) eq 'mesh' ? ' 1' : ' 0')
      if (top > 0) {
        its_name = name(word(settings, 2 * i - 1), real_of(word(settings, 2 * i)))
        named = named + 1; up = 18
        text_from[named] = 8 + 440 * log(across(i, p) / least) / log(most / least)
        text_width[named] = 14 * strlen(its_name) + 8
        text_height[named] = 555 * log(top / lowest * 2.5) / log(highest / lowest * 25)
        while (up < 45 && hidden(named, text_height[named] + up)) { up = up + 3 }
        # A name for which there is no room is left out.
        if (up < 45) {
          text_height[named] = text_height[named] + up
          set label its_name at across(i, p),top left offset screen 8 / width,up / height font ',16' textcolor '#404040' front
        } else { named = named - 1 }
      }
    }
  }
  unset print
  # Places the slopes next to the ends of their curves, from the lowest to the highest, each at least a line above the previous one.
  line = p < 3 ? (highest * 25 / lowest) ** (25 / 555.0) : 1
  do for [q = 1:4] { end_place[q] = NaN; end_error[q] = NaN }
  do for [i = 1:n] {
    do for [q = 1:4] { if (p < 3 && of_kind(i, p) && percent[4 * i + q] > 0) { end_place[q] = across(i, p); end_error[q] = percent[4 * i + q] } }
  }
  free = 0.0
  do for [rank = 1:4] {
    next = 0
    do for [q = 1:4] { if (end_error[q] > 0 && (next == 0 || end_error[q] < end_error[next > 0 ? next : 1])) { next = q } }
    if (next > 0) {
      at_error = end_error[next] > free ? end_error[next] : free
      free = at_error * line
      set label with_error(slope[4 * p - 4 + next], half_width[4 * p - 4 + next]) at end_place[next],at_error left offset screen 14 / width,0 font ',15' textcolor rgb colour[next]
      end_error[next] = NaN
    }
  }
  if (p == 3 && seconds > 0) {
    set arrow from graph 0,first 100 * asked to graph 1,first 100 * asked nohead back linestyle 9
    set arrow from seconds,graph 0 to seconds,first 100 * asked nohead back linestyle 9
    set label '' at seconds,100 * expected point linestyle 10 front
    advice = after('for ')
    set label up_to(':', advice) . ':' at graph 0.96,0.95 right font ',17' front
    set label past(': ', up_to(' on this', advice)) at graph 0.96,0.895 right font ',17' front
  }
  if (nothing) { set label 'nothing measured' at graph 0.5,0.5 center }
  if (p == 1) {
    set label cut(title, 84) at screen 0.5,(1 - 40 / height) center font ',25' textcolor '#101010'
    set label 'Points: measured. Lines and numbers of the two passes: fitted powers of the number of rays' \
      at screen 0.5,(1 - 82 / height) center font ',18' textcolor '#101010'
    set label 'Relative error (%), root mean square' at screen 30 / width,402 / height center rotate by 90
    do for [i = 1:n] {
      if (of_kind(i, 1) && abs(real_of(word(settings, 2 * i)) / grid - 1) < 1e-6) {
        set arrow from across(i, p),graph 0 to across(i, p),graph 1 nohead back linestyle 9
        set label sprintf('%.3g cm grid', 100 * grid) at across(i, p),graph 0.95 right offset -0.8,0 font ',17' front
      }
    }
  }
  left = 150 + 490 * (p - 1)
  set lmargin at screen left / width
  set rmargin at screen (left + 440) / width
  set xrange [least:most]
  if (most / least > 1e5) { set xtics 1,100 } else { set xtics autofreq }
  set title panel[p] offset 0,-0.3
  set xlabel across_title[p] offset 0,0.2
  set format x p < 3 ? '%.0s %c' : '%g'
  if (p > 1) { unset key } else { set key at screen 150 / width,(1 - 104 / height) left top vertical maxrows 1 Left reverse samplen 2 font ',19' }
  plot for [q = 1:4] $points using 1:(column(5 + q)) with lines linestyle q notitle, \
    for [q = 1:4] $points using (column(10) > 0 ? NaN : column(1)):(column(1 + q)) with points linestyle q notitle, \
    for [q = 1:4] $points using (column(10) > 0 ? column(1) : NaN):(column(1 + q)) with points linestyle q + 4 notitle, \
    for [q = 1:4] keyentry with linespoints linestyle q title quantity[q]
  set format y ''
}
unset multiplot
