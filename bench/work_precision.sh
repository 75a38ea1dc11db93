#!/bin/sh
# Measures error against CPU time of all integrators and writes docs/accuracy.md and docs/accuracy/*.svg: some ten
# minutes, half of them for the build. Needs cmake and gnuplot; MuJoCo is measured too if it is installed:
#   apt install gnuplot-nox libmujoco-dev
# Leave the machine alone meanwhile. BUILD=folder REVISION=text: a build that is made already, and of what.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
here=bench/work_precision
changes=$(git status --porcelain -- include bench)
: "${REVISION:=$(git rev-parse --short HEAD)${changes:+ and changes not committed}}"
for tool in cmake gnuplot awk; do
  command -v $tool >/dev/null || { echo "work_precision: $tool is missing: apt install cmake gnuplot-nox mawk" >&2; exit 1; }
done

if [ -z "${BUILD:-}" ]; then
  BUILD=build/bench
  cmake --preset bench -DKTE_BENCH_PEERS=ON
  cmake --build --preset bench --target work_precision
fi
programs=$BUILD/bench/work_precision
work=$BUILD/accuracy
mkdir -p "$work" docs/accuracy

rows=$work/rows
"$programs/kte_work_precision" >"$rows"
[ ! -x "$programs/mujoco/kte_work_precision_mujoco" ] || "$programs/mujoco/kte_work_precision_mujoco" >>"$rows"
"$programs/kte_work_precision" --long-time >"$work/long_time"
"$programs/kte_work_precision" --overhead >"$work/overhead"

rm -f docs/accuracy/*.svg
gnuplot -e "rows='$rows'; long_time='$work/long_time'; out='$work'" $here/plots.gp
for picture in "$work"/*.svg; do
  awk -f $here/slim.awk "$picture" >docs/accuracy/"${picture##*/}"
done

ask() {
  script=$1
  shift
  awk "$@" -f $here/rows.awk -f "$here/$script.awk" "$rows" "$work/long_time" "$work/overhead"
}
version() { dpkg-query -W -f '${Version}' "$1" 2>/dev/null | sed 's/[-+].*//' || true; }
cache() { sed -n "s/^$1:[^=]*=//p" "$BUILD/CMakeCache.txt"; }
cpu() { lscpu | sed -n "s/^$1: *//p"; }
compiler=$(cache CMAKE_CXX_COMPILER)
problems=$(awk '!seen[$1]++ { printf "%s ", $1 }' "$rows")

{
  cat $here/introduction.md
  cat <<END

| | |
|-|-|
| machine | $(cpu 'Model name'), family $(cpu 'CPU family'), model $(cpu Model), $(nproc) cores, one used |
| compiler | $("$compiler" --version | head -n 1), -O3 -march=native -fno-math-errno |
| revision | $REVISION, $(date -u +%F) |
| libraries | Eigen $(version libeigen3-dev), MuJoCo $(version libmujoco-dev) |
| command | \`sh bench/work_precision.sh\` |

## Targets

END
  ask targets
  printf '\n## Which integrator\n\n'
  ask fill -v text=$here/choosing.md
  printf '\nThe fastest integrator, ms, and the one with the fewest evaluations, if different:\n\n'
  ask winners -v all="$problems"
  printf '\n## Energy over a long time\n\n'
  cat $here/long_time.md
  awk -f $here/long_time.awk "$work/long_time"
  printf '\n## Problems\n\n'
  cat $here/tables.md
  for name in $problems; do
    printf '\n### %s\n\n![%s](accuracy/%s.svg)\n\n' "$name" "$name" "$name"
    ask table -v problem="$name"
    if awk -v name="$name" '$1 == name && $12 != "-" { found = 1 } END { exit !found }' "$rows"; then
      echo
      ask kept -v problem="$name"
    fi
  done
} >docs/accuracy.md
echo "docs/accuracy.md"
