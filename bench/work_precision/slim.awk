# A picture by gnuplot in half the bytes: empty groups and defaults left out, tenths of a pixel, marks (all of one size)
# by short references.
NR > 1 {
  sub(/^\t+/, "")
  gsub(/ class="gridline"| stroke-linecap="butt" stroke-linejoin="miter"|<\/?tspan[^>]*>/, "")
  gsub(/ font-family="sans-serif" font-size="11.00"/, "")
  sub(/<g id="gnuplot_canvas"/, "& font-family=\"sans-serif\" font-size=\"11\"")
}
/<\/defs>/ {
  for (i = 0; i < 15; ++i) printf "<g id='p%d'><use xlink:href='#gpPt%d' transform='scale(2)'/></g>\n", i, i
}
{
  while (match($0, /rgb\( *[0-9]+, *[0-9]+, *[0-9]+\)/)) {
    split(substr($0, RSTART + 4, RLENGTH - 5), part, ",")
    $0 = substr($0, 1, RSTART - 1) sprintf("#%02x%02x%02x", part[1], part[2], part[3]) substr($0, RSTART + RLENGTH)
  }
  line = ""
  while (NR > 1 && match($0, /[0-9]+\.[0-9][0-9]+/)) {
    line = line substr($0, 1, RSTART - 1) sprintf("%.1f", substr($0, RSTART, RLENGTH))
    $0 = substr($0, RSTART + RLENGTH)
  }
  line = line $0
  if (match(line, /#gpPt[0-9]+' transform='translate\([^)]*\) scale\([0-9.]*\)'/)) {
    split(substr(line, RSTART + 5, RLENGTH - 5), part, /'|\(|\)|,/)
    line = substr(line, 1, RSTART) "p" part[1] sprintf("' x='%.0f' y='%.0f'", part[4], part[5]) substr(line, RSTART + RLENGTH)
  }
  if (line ~ /^<g fill="none"[^>]*>$/) {
    group = line
    next
  }
  if (group != "" && line != "</g>") print group
  if (line != "" && (group == "" || line != "</g>")) print line
  group = ""
}
