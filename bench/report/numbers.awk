# From what Google Benchmark writes as JSON to lines "operation how model ns error": medians of times in yardsticks
# (bench/yardstick.hpp), times the median of what a yardstick took in all.
function value(line) {
  sub(/^[^:]*: */, "", line)
  gsub(/[",]/, "", line)
  return line
}
function median(all, n, i, j, x) {
  for (i = 2; i <= n; ++i) {
    x = all[i]
    for (j = i - 1; j > 0 && all[j] > x; --j) all[j + 1] = all[j]
    all[j + 1] = x
  }
  return all[int((n + 1) / 2)]
}
/"run_name":/ { name = value($0) }
/"aggregate_name":/ { aggregate = value($0) }
/"error":/ { error = value($0) }
/"yardstick":/ { ns = value($0) }
/"yardsticks":/ {
  if (aggregate == "median") {
    ++n
    yardstick[n] = ns + 0
    split(name, part, "/")
    what[n] = part[1] " " part[2] " " part[3]
    time[n] = value($0) + 0
    errors[n] = error + 0
  }
}
END {
  for (i = 1; i <= n; ++i) sorted[i] = yardstick[i]
  one = median(sorted, n)
  for (i = 1; i <= n; ++i) print what[i], time[i] * one, errors[i]
}
