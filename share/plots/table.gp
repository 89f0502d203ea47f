# Reads the head of the file `table`, above its numbers: `table_title`, `header` (the column names) and `remarks` (all lines).
# Texts of a table are only data here: gnuplot never runs them.
set datafile separator "\001"
set datafile commentschars ''
unset datafile columnheaders
table_title = ''; header = ''; remarks = "\n"
stats table every ::0::24 using (table_title = table_title eq '' ? strcol(1) : table_title, \
  header = header eq '' && strcol(1)[1:1] ne '#' ? strcol(1) : header, \
  remarks = remarks . (header eq '' && $0 > 0 ? strcol(1) . "\n" : ''), 0) nooutput
# An error that stops all scripts, which `exit` in a file that is loaded does not.
if (header eq '') { print no_table_with_column_names }
table_title = strlen(table_title) > 2 ? table_title[3:*] : ''
set datafile separator ','
set datafile commentschars '#'
set datafile columnheaders

# The rest of the line that begins with `# ` and this text; empty if there is none.
after(text) = (at = strstrt(remarks, "\n# " . text)) == 0 ? '' : up_to("\n", remarks[at + 3 + strlen(text):*])
past(mark, text) = (at = strstrt(text, mark)) == 0 ? '' : text[at + strlen(mark):*]
up_to(end, text) = (at = strstrt(text, end)) == 0 ? text : text[1:at - 1]
# The number that a text is. gnuplot 5.4 reads 5.0e-05 but refuses 5e-05.
real_of(text) = (e = strstrt(text, 'e'), real(e > 0 && strstrt(text, '.') == 0 ? text[1:e - 1] . '.0' . text[e:*] : text))
# The number at the start of a text, NaN for any other text.
number(text) = (first = up_to(';', up_to(',', word(text . ' -', 1))), first eq '' || strstrt('-0123456789', first[1:1]) == 0 || first eq '-' ? NaN : real_of(first))
# The column of that name; 0 if there is none.
column_of(name) = (at = strstrt(',' . header . ',', ',' . name . ',')) == 0 ? 0 : (sum [k = 1:at] ((',' . header)[k:k] eq ','))
