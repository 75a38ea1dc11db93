# From what Google Benchmark writes as JSON to lines "operation how model ns error": the medians.
function value(line) {
  sub(/^[^:]*: */, "", line)
  gsub(/[",]/, "", line)
  return line
}
/"run_name":/ { name = value($0) }
/"aggregate_name":/ { aggregate = value($0) }
/"cpu_time":/ { time = value($0) }
/"error":/ {
  if (aggregate == "median") {
    split(name, part, "/")
    print part[1], part[2], part[3], time + 0, value($0) + 0
  }
}
