#!/bin/sh
# sh mpi.sh SWEEP_MPI MPIEXEC: a sweep in one process and in four gives the same bytes; so does one of which a process
# is killed on the way, and that goes on.
set -e
program=$1 mpiexec=$2
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export ASAN_OPTIONS=detect_leaks=0 # of MPI itself
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "$1" >&2
  exit 1
}
"$program" one.npy 0
"$mpiexec" -n 4 "$program" four.npy 0
cmp one.npy four.npy || fail "one process and four differ"
cmp one.npy.failures.csv four.npy.failures.csv || fail "failures of one process and of four differ"

"$mpiexec" -n 4 "$program" killed.npy 20000 >killed.log 2>&1 &
all=$!
tries=0
while [ "$(ls killed.npy.parts 2>/dev/null | grep -c 'shard$')" -lt 4 ]; do
  sleep 0.05
  tries=$((tries + 1))
  [ $tries -lt 600 ] || fail "no shards after 30 s"
done
kill -9 "$(ps -o pid= --ppid $all | head -n 1)"
wait $all && fail "the job survived its process"
[ ! -e killed.npy ] || fail "there is a result of a job that was killed"
kept=$(ls killed.npy.parts | grep -c 'shard$')
[ "$kept" -lt 40 ] || fail "the job was done before it was killed"
"$mpiexec" -n 4 "$program" killed.npy 0
cmp one.npy killed.npy || fail "the job that was killed gives other bytes"

mkdir nowhere.npy.parts && echo other >nowhere.npy.parts/sweep
"$mpiexec" -n 2 "$program" nowhere.npy 0 >refused.log 2>&1
grep -q "rank 0: kte: 'nowhere.npy.parts' has shards of another sweep" refused.log || fail "no message of rank 0"
grep -q "rank 1: kte: the sweep failed in another rank" refused.log || fail "no message of rank 1"
echo "sweeps by MPI: the same bytes by 1 and 4 processes, and after one is killed ($kept shards were kept)"
