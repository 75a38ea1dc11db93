# The table of targets: awk -f targets.awk numbers targets.txt
# The slope of the least-squares line through (log N, log time).
function slope(of, from, k, n, x, y, sx, sy, sxx, sxy) {
  for (k = from; k <= 1024; k *= 2) {
    if (!((of "/serial" k) in time)) continue
    x = log(k)
    y = log(time[of "/serial" k])
    ++n
    sx += x
    sy += y
    sxx += x * x
    sxy += x * y
  }
  return n < 2 ? "" : (n * sxy - sx * sy) / (n * sxx - sx * sx)
}
function row(what, measured, digits, most, errors, verdict) {
  if (measured == "") {
    printf "| %s | not measured | %s | | |\n", what, most
  } else {
    verdict = measured <= most + 0 ? "met" : sprintf("**missed**, by a factor of %.3f", measured / most)
    printf "| %s | " digits " | %s | %s | %s |\n", what, measured, most, verdict, errors
  }
}
FNR == NR {
  time[$1 "/" $2 "/" $3] = $4
  error[$1 "/" $2 "/" $3] = $5
  next
}
FNR == 1 {
  print "| | measured | at most | | error |"
  print "|-|-|-|-|-|"
}
/^#/ { next }
$1 == "time" {
  known = ($2 in time) && ($3 in time)
  errors = known ? sprintf("%.1e : %.1e", error[$2], error[$3]) : ""
  row("`" $2 "` : `" $3 "`", known ? time[$2] / time[$3] : "", "%.3f", $4, errors)
}
$1 == "slope" { row("`" $2 "`, growth exponent in N from " $4 " on", slope($2, $4), "%.2f", $3, "") }
$1 == "error" { row("`" $2 "`, error", $2 in error ? error[$2] : "", "%.1e", $3, "") }
