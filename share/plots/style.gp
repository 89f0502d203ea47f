# The common look of sunfleck's plots; each script loads this file from its own folder.
set encoding utf8
font = 'DejaVu Sans'
set border linecolor '#404040' linewidth 0.75
set grid back linetype 1 linecolor '#d9d9d9' linewidth 0.5
set tics scale 0.6 textcolor '#202020'
set format '%g'
set errorbars small linewidth 0.9
unset key
# Colours that readers with any colour vision can tell apart (Okabe and Ito 2008, Color Universal Design), and one filled shape
# for each.
array colour[6] = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9']
array shape[6] = [7, 5, 9, 13, 11, 15]

# A text with at most that many characters.
cut(text, longest) = strlen(text) > longest ? text[1:longest] . '…' : text
# An end of an axis that is not empty: the first number if it is positive, otherwise the second.
positive(number, otherwise) = number > 0 ? number : otherwise
