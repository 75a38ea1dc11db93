# Lines "FOLDER INCLUDED HEADER" to a layered picture as SVG: a folder is above all that it includes. Fails if folders
# include each other. tools/folders.sh calls it.
function node(name) { if (!(name in number)) { number[name] = ++nodes; label[nodes] = name } return number[name] }
{ uses[node($1), node($2)] = 1; header[number[$1], number[$2]] = $3 }

# The longest path down from i; layer[i] is 0 for what includes nothing.
function depth(i,    j, d) {
  if (i in layer) return layer[i]
  if (i in open) { cycle(i); exit failed = 1 }
  open[i] = 1; stack[++height] = i
  for (j = 1; j <= nodes; ++j)
    if ((i, j) in uses && depth(j) >= d) d = layer[j] + 1
  delete open[i]; --height
  return layer[i] = d + 0
}
function cycle(i,    k) {
  for (k = height; stack[k] != i; --k) ;
  for (stack[height + 1] = i; k <= height; ++k)
    print "kte: " label[stack[k]] " includes " label[stack[k + 1]] ", by " header[stack[k], stack[k + 1]] >"/dev/stderr"
  print "kte: folders must not include each other" >"/dev/stderr"
}
# Whether a path of two steps or more leads from i to j.
function implied(i, j,    k) {
  for (k = 1; k <= nodes; ++k)
    if (k != j && (i, k) in uses && reach[k, j]) return 1
  return 0
}
# An item of a layer: a folder, or a place where a long arrow passes.
function add(k, i) { item[k, ++count[k]] = i; at[i] = count[k] }
function connect(a, b) { lower[a] = lower[a] " " b; upper[b] = upper[b] " " a }
# Sorts a layer by the mean place of what its items are connected to.
function sort_layer(k, connected,    n, i, j, m, list, key, moving, x) {
  for (n = 1; n <= count[k]; ++n) {
    i = item[k, n]; m = split(connected[i], list, " "); key[i] = m ? 0 : at[i]
    for (j = 1; j <= m; ++j) key[i] += place(list[j]) / m
  }
  for (n = 2; n <= count[k]; ++n) {
    moving = item[k, n]
    for (j = n - 1; j >= 1 && key[item[k, j]] > key[moving]; --j) item[k, j + 1] = item[k, j]
    item[k, j + 1] = moving
  }
  for (n = 1; n <= count[k]; ++n) at[item[k, n]] = n
  spread(k)
}
function width_of(i) { return i <= nodes ? 118 : 22 }
function place(i) { return x_of[i] }
# Puts the items of a layer beside each other, in the middle.
function spread(k,    n, x) {
  for (n = 1; n <= count[k]; ++n) x += width_of(item[k, n]) + 14
  x = -x / 2
  for (n = 1; n <= count[k]; ++n) { x_of[item[k, n]] = x + width_of(item[k, n]) / 2 + 7; x += width_of(item[k, n]) + 14 }
  if (-x / 2 < 0 && x > half) half = x
}

END {
  if (failed) exit 1
  for (i = 1; i <= nodes; ++i) { depth(i); if (failed) exit 1; if (layer[i] > top) top = layer[i] }
  for (i = 1; i <= nodes; ++i) reach[i, i] = 1
  for (k = 0; k <= top; ++k)
    for (i = 1; i <= nodes; ++i)
      if (layer[i] == k)
        for (j = 1; j <= nodes; ++j)
          if ((i, j) in uses)
            for (m = 1; m <= nodes; ++m) if (reach[j, m]) reach[i, m] = 1
  for (i = 1; i <= nodes; ++i) add(layer[i], i)
  items = nodes
  for (i = 1; i <= nodes; ++i)
    for (j = 1; j <= nodes; ++j)
      if ((i, j) in uses && !implied(i, j)) {
        path = i
        for (k = layer[i] - 1; k > layer[j]; --k) { add(k, ++items); connect(before == "" ? i : before, items); before = items; path = path " " items }
        connect(before == "" ? i : before, j); before = ""
        arrow[++arrows] = path " " j
      }
  for (k = 0; k <= top; ++k) spread(k)
  for (sweep = 1; sweep <= 24; ++sweep) {
    for (k = top - 1; k >= 0; --k) sort_layer(k, upper)
    for (k = 1; k <= top; ++k) sort_layer(k, lower)
  }
  half = 0
  for (i = 1; i <= items; ++i) if ((x_of[i] < 0 ? -x_of[i] : x_of[i]) + 70 > half) half = (x_of[i] < 0 ? -x_of[i] : x_of[i]) + 70
  step = 64
  printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"%d 0 %d %d\" font-family=\"sans-serif\" font-size=\"13\">\n", 2 * half, (top + 1) * step, -half, 2 * half, (top + 1) * step
  print "<title>The folders of include/kte</title>"
  print "<desc>Each folder, and below it the folders that it includes:"
  for (n = 1; n <= arrows; ++n) { m = split(arrow[n], list, " "); print label[list[1]] " includes " label[list[m]] (n < arrows ? "," : ".</desc>") }
  printf "<rect x=\"%d\" width=\"%d\" height=\"%d\" fill=\"white\"/>\n", -half, 2 * half, (top + 1) * step
  print "<g fill=\"none\" stroke=\"#777777\">"
  for (n = 1; n <= arrows; ++n) {
    m = split(arrow[n], list, " "); k = layer[list[1]]
    d = sprintf("M%.0f %.0f", x_of[list[1]], (top - k) * step + 46)
    for (j = 2; j <= m; ++j) {
      y = (top - k + j - 1) * step + 18
      d = d sprintf(" C%.0f %.0f %.0f %.0f %.0f %.0f", x_of[list[j - 1]], y - 18, x_of[list[j]], y - 18, x_of[list[j]], y)
      if (j < m) d = d sprintf(" V%.0f", y + 28)
    }
    print "<path d=\"" d "\"/>"
  }
  print "</g>\n<g fill=\"#eef3fa\" stroke=\"#446688\">"
  for (i = 1; i <= nodes; ++i) printf "<rect x=\"%.0f\" y=\"%d\" width=\"118\" height=\"28\" rx=\"4\"/>\n", x_of[i] - 59, (top - layer[i]) * step + 18
  print "</g>\n<g text-anchor=\"middle\" fill=\"#222222\">"
  for (i = 1; i <= nodes; ++i) printf "<text x=\"%.0f\" y=\"%d\">%s</text>\n", x_of[i], (top - layer[i]) * step + 37, label[i]
  print "</g>\n</svg>"
}
