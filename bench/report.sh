#!/bin/sh
# Runs all benchmarks and writes docs/performance.md and docs/performance/*.svg: half an hour, most of it for the build.
# Needs what the benchmarks need (docs/build.md) and gnuplot; other libraries are timed if they are installed:
#   apt install gnuplot-nox liborocos-kdl-dev libmujoco-dev libdart-dev libbullet-dev
# and clang, with which the headers of Pinocchio from the Python package index are compiled, if that is reached.
# Leave the machine alone meanwhile. BUILD=folder REVISION=text: a build that is made already, and of what.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
here=bench/report
: "${REPETITIONS:=5}" "${MIN_TIME:=0.05}"
changes=$(git status --porcelain -- include bench)
: "${REVISION:=$(git rev-parse --short HEAD)${changes:+ and changes not committed}}"
for tool in cmake gnuplot awk; do
  command -v $tool >/dev/null || { echo "report: $tool is missing: apt install cmake gnuplot-nox mawk" >&2; exit 1; }
done

if [ -z "${BUILD:-}" ]; then
  BUILD=build/bench
  headers=
  if python3 -m pip install --quiet --upgrade --target $BUILD/pinocchio pin==4.1.0 >/dev/null 2>&1; then
    headers=-DKTE_BENCH_pinocchio_INCLUDE=$PWD/$BUILD/pinocchio/cmeel.prefix/include
  else
    echo "report: no pin 4.1.0 from the Python package index, so Pinocchio is timed only if its headers are installed" >&2
  fi
  # shellcheck disable=SC2086
  cmake --preset bench -DKTE_BENCH_PEERS=ON $headers
  cmake --build --preset bench
fi
work=$BUILD/report
mkdir -p "$work" docs/performance

options="--benchmark_repetitions=$REPETITIONS --benchmark_min_time=$MIN_TIME --benchmark_enable_random_interleaving=true
  --benchmark_report_aggregates_only=true --benchmark_out_format=json"
rm -f "$work"/*.json
for program in kte_bench kte_bench_libm peers/kte_bench_peers peers/kte_bench_pinocchio; do
  [ -x "$BUILD/bench/$program" ] || continue
  out=$work/${program##*/}
  # shellcheck disable=SC2086
  "$BUILD/bench/$program" $options --benchmark_out="$out.json" >"$out.log"
done
cat "$work"/*.json | awk -f $here/numbers.awk | sort -k1,1 -k2,2 -k3.1,3.6 -k3.7n >"$work/numbers"
gnuplot -e "numbers='$work/numbers'; here='$here'; out='docs/performance'" $here/plots.gp

version() { dpkg-query -W -f '${Version}' "$1" 2>/dev/null | sed 's/[-+].*//' || true; }
model() {
  printf '\n### %s\n\n' "$1"
  sort -k4,4g "$work/numbers" | awk -v model="$1" -f $here/model.awk
}
cache() { sed -n "s/^$1:[^=]*=//p" "$BUILD/CMakeCache.txt"; }
cpu() { lscpu | sed -n "s/^$1: *//p"; }
compiler=$(cache CMAKE_CXX_COMPILER)
flags="$(cache CMAKE_CXX_FLAGS_RELEASE) $(cache CMAKE_CXX_FLAGS)"
others="Orocos KDL $(version liborocos-kdl-dev), MuJoCo $(version libmujoco-dev), DART $(version libdart-dev)"
others="$others, Bullet $(version libbullet-dev)"
pinocchio=$(sed -n 's/^# *define PINOCCHIO_VERSION "\(.*\)"/\1/p' "$(cache KTE_BENCH_pinocchio_INCLUDE)/pinocchio/config.hpp" 2>/dev/null || true)

{
  cat $here/introduction.md
  cat <<END

| | |
|-|-|
| machine | $(cpu 'Model name'), family $(cpu 'CPU family'), model $(cpu Model), $(nproc) cores, one used |
| compiler | $("$compiler" --version | head -n 1), $flags |
| revision | $REVISION, $(date -u +%F) |
| libraries | Eigen $(version libeigen3-dev), xsimd $(version libxsimd-dev), Google Benchmark $(version libbenchmark-dev) |
| others | $others |
| command | \`sh bench/report.sh\`: $REPETITIONS repetitions of $MIN_TIME s or more, interleaved at random |

## Targets

Targets are ratios of two times, and errors.
Straight-line forward dynamics factorizes the mass matrix; \`straightline_aba\` uses the articulated body algorithm, as kte does.

END
  awk -f $here/targets.awk "$work/numbers" $here/targets.txt
  cat $here/notes.md
  if [ -n "$pinocchio" ]; then
    cat <<END

## Pinocchio

Times of Pinocchio $pinocchio divided by those of kte in the same run, followed by the errors of kte.
The last column has Pinocchio's time and error.
Its headers, from the Python package \`pin\`, were compiled by $("$(cache KTE_BENCH_CLANG)" --version | head -n 1), with the flags of the table above.
kte was compiled as in the table.
Pinocchio writes the upper triangle of M only; of the inverse it was copied to the lower one, which kte writes too.

END
    awk -f $here/pinocchio.awk "$work/numbers" "$work/numbers"
  fi
  printf '\n## Models\n\n![time against error](performance/error.svg)\n\n![ways to evaluate](performance/ways.svg)\n'
  for name in iiwa14 ur5 3R3R panda solo12 hyq pendulum; do model $name; done
  printf '\n## Growth with the number of bodies\n\n![growth](performance/growth.svg)\n\nNanoseconds by number of bodies:\n\n'
  awk -v column=4 -f $here/growth.awk "$work/numbers"
  printf '\nErrors by number of bodies:\n\n'
  awk -v column=5 -f $here/growth.awk "$work/numbers"
  printf '\n## Compile time\n\nCompile time of one file with inverse dynamics, mass matrix and forward dynamics, measured by `sh bench/compile/measure.sh`:\n\n```\n'
  sh bench/compile/measure.sh
  printf '```\n'
} >docs/performance.md
echo "docs/performance.md"
