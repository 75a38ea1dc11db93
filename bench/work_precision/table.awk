# The table of a problem, fastest to 1e-6 first: awk -v problem=NAME -f rows.awk -f table.awk rows
function key_of_sort(key, i, c) {
  for (i = 2; i >= 1; --i)
    if ((c = cost_to(key, errors[i], "time")) != "") return (2 - i) * 1e6 + c
  return 2e6 + floor_of(key)
}
function bold(text, best) { return best ? "**" text "**" : text }
# Time and evaluations to an error e; in bold where they are the least.
function cell(key, e, t, n) {
  t = cost_to(key, e, "time")
  if (t == "") return ""
  n = cost_to(key, e, "evaluations")
  return bold(milliseconds(t), t <= fastest[e]) " / " bold(short(n), n <= fewest[e])
}
END {
  split("1e-3 1e-6 1e-9 1e-12", errors)
  names = split(methods[problem], name)
  for (m = 1; m <= names; ++m) {
    place[m] = name[m]
    rank[name[m]] = key_of_sort(problem " " name[m])
    for (i = 1; i <= 4; ++i) {
      t = cost_to(problem " " name[m], errors[i], "time")
      n = cost_to(problem " " name[m], errors[i], "evaluations")
      if (t != "" && (!(errors[i] in fastest) || t < fastest[errors[i]])) fastest[errors[i]] = t
      if (n != "" && (!(errors[i] in fewest) || n < fewest[errors[i]])) fewest[errors[i]] = n
    }
  }
  for (m = 2; m <= names; ++m)
    for (i = m; i > 1 && rank[place[i]] < rank[place[i - 1]]; --i) {
      swapped = place[i]
      place[i] = place[i - 1]
      place[i - 1] = swapped
    }
  print "| | to 1e-3 | 1e-6 | 1e-9 | 1e-12 | order | least error |"
  print "|-|-|-|-|-|-|-|"
  for (m = 1; m <= names; ++m) {
    key = problem " " place[m]
    printf "| `%s` |", place[m]
    for (i = 1; i <= 4; ++i) printf " %s |", cell(key, errors[i])
    least = floor_of(key)
    order = fixed(place[m]) ? order_of(key) : ""
    if (order != "") order = sprintf("%.2f", order)
    least = (least > 1e98) ? "none" : sprintf("%.1e%s", least, reached ? "" : " \\*")
    printf " %s | %s |\n", order, least
  }
  for (m = 1; m <= names; ++m) {
    key = problem " " place[m]
    for (i = 1; i <= count[key]; ++i)
      if (failed[key, i]) {
        if (!some++) printf "\nStopped:\n\n"
        for (j = i; j < count[key] && failed[key, j + 1];) ++j
        printf "* `%s`, %s: `%s`\n", place[m], setting[key, i] (j > i ? " to " setting[key, j] : ""), reason[key, i]
        i = j
      }
  }
}
