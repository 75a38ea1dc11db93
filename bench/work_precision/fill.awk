# A text with numbers from the rows in it: awk -v text=FILE -f rows.awk -f fill.awk rows. In the text,
#   @time PROBLEM METHOD ERROR@ and @evaluations PROBLEM METHOD ERROR@   what METHOD takes to ERROR
#   @ratio PROBLEM OTHER METHOD ERROR@                                   how many times as long as METHOD the OTHER takes
#   @floor PROBLEM METHOD@                                               its least error
#   @overhead METHOD@                                                    percent
NF == 5 && FILENAME ~ /overhead/ { overhead[$1] = $5 }
function value(words, part, a, b) {
  split(words, part)
  if (part[1] == "overhead") return sprintf("%.0f", overhead[part[2]])
  if (part[1] == "floor") return sprintf("%.0e", floor_of(part[2] " " part[3]))
  a = cost_to(part[2] " " part[3], part[1] == "ratio" ? part[5] : part[4], part[1] == "evaluations" ? "evaluations" : "time")
  if (part[1] == "ratio") b = cost_to(part[2] " " part[4], part[5], "time")
  if (a == "" || (part[1] == "ratio" && b == "")) return "(not reached)"
  return part[1] == "time" ? milliseconds(a) " ms" : part[1] == "evaluations" ? short(a) : sprintf("%.2g", a / b)
}
END {
  while ((getline line < text) > 0) {
    while (match(line, /@[^@]+@/))
      line = substr(line, 1, RSTART - 1) value(substr(line, RSTART + 1, RLENGTH - 2)) substr(line, RSTART + RLENGTH)
    print line
  }
}
