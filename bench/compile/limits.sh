# shellcheck shell=sh
# Sourced by gate.sh, runtime.sh, docs.sh and registers.sh, which compare what they count with a file of limits beside
# them; with the argument `record` they write that file anew.
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
record=${1:-}
CXX=g++  # by which the limits were counted
. "$root/bench/compile/chain.sh"

# The most that is recorded for a count: 5 % more.
allowed() { echo $(($1 * 21 / 20)); }

# limits_of FILE KEY NAME ...: begins, with the names of the columns.
limits_of() {
  limits=$root/bench/compile/$1 over=""
  grep '^#' "$limits" >"$work/limits"
  printf '%-32s' "$2"
  shift 2
  for name; do printf ' %20s' "$name (most)"; done
  echo
}
# compare KEY "COUNT ..." "MOST ...": one row.
compare() {
  key=$1 counts=$2 row="" new=""
  # shellcheck disable=SC2086
  set -- $3
  for count in $counts; do
    row="$row$(printf ' %20s' "$count (${1:-none})")"
    new="$new $(allowed "$count")"
    if [ "$count" -gt "${1:-0}" ]; then over="$over$key, "; fi
    shift $(($# > 0))
  done
  printf '%-32s%s\n' "$key" "$row"
  echo "$key$new" >>"$work/limits"
}
# not_compared "KEY MOST ..." WHY: a row that stays as it is.
not_compared() {
  echo "$1" >>"$work/limits"
  echo "${1%% *}: not counted, as $2"
}
finish() {
  if [ "$record" = record ]; then
    cp "$work/limits" "$limits"
  elif [ "$over" ]; then
    echo "$0: more than $limits allows, so slower to compile or to run: ${over%, }" >&2
    echo "Find the change that did it; if it is worth it: sh $0 record" >&2
    exit 1
  fi
}
