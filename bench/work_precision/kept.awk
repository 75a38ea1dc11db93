# What methods keep, at the setting of each whose error is nearest to 1e-6: awk -v problem=NAME -f rows.awk -f kept.awk rows
function distance(e) { return e <= 0 || e > 1e98 ? 1e9 : (log(e / 1e-6) < 0 ? -log(e / 1e-6) : log(e / 1e-6)) }
function exponent(x) { return x == "-" ? "" : sprintf("%.1e", x) }
END {
  print "| at an error of about 1e-6 | setting | error | energy, J | momentum | norm |"
  print "|-|-|-|-|-|-|"
  names = split(methods[problem], name)
  for (m = 1; m <= names; ++m) {
    key = problem " " name[m]
    nearest = 1
    for (i = 2; i <= count[key]; ++i)
      if (distance(error[key, i]) < distance(error[key, nearest])) nearest = i
    if (distance(error[key, nearest]) > 4) continue  # further than by a factor of e^4
    printf "| `%s` | %s | %.1e | %s | %s | %s |\n", name[m], setting[key, nearest], error[key, nearest], exponent(energy[key, nearest]), exponent(momentum[key, nearest]), exponent(norm[key, nearest])
  }
}
