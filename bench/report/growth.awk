# Serial chains by the number of bodies: awk -v column=4 -f growth.awk numbers. Column 4 is the time, 5 the error.
$3 ~ /^serial/ {
  n = substr($3, 7)
  all[$1, $2, n] = $column
  if (!(($1, $2) in known)) {
    known[$1, $2] = 1
    order[++rows] = $1 " " $2
  }
}
END {
  head = "| operation | how |"
  line = "|-|-|"
  for (n = 1; n <= 1024; n *= 2) {
    head = head " " n " |"
    line = line "-|"
  }
  print head
  print line
  for (i = 1; i <= rows; ++i) {
    split(order[i], at, " ")
    text = "| " (at[1] == before ? "" : at[1]) " | " at[2] " |"
    before = at[1]
    for (n = 1; n <= 1024; n *= 2) {
      x = (at[1], at[2], n) in all ? all[at[1], at[2], n] : ""
      if (x != "") x = sprintf(column == 5 ? "%.1e" : x < 1000 ? "%.3g" : "%.0f", x)
      text = text " " x " |"
    }
    print text
  }
}
