# Sourced by the tests of programs: a folder of their own, and checks that count what fails.
data=$(cd "$(dirname "$0")/../data" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failures=0

# gives CODE TEXT COMMAND...: the exit code, and a line of the errors that has TEXT in it; "" for no errors at all. Standard output is in
# the file `out`, which must be empty where the code is not 0.
gives() {
  code=$1 text=$2
  shift 2
  got=0
  "$@" >out 2>errors || got=$?
  if [ "$got" -ne "$code" ]; then
    wrong "exit code $got, not $code" "$@"
  elif [ "$code" -ne 0 ] && [ -s out ]; then
    wrong "standard output is not empty" "$@"
  elif [ -z "$text" ] && [ -s errors ]; then
    wrong "there are errors" "$@"
  elif [ -n "$text" ] && ! grep -qF -- "$text" errors; then
    wrong "no '$text' among the errors" "$@"
  fi
}
wrong() {
  failures=$((failures + 1))
  echo "FAILED: $*"
  sed 's/^/  /' errors
}
# full COMMAND...: fails on a full device, and where standard output is closed, in words.
full() {
  : >out
  got=0
  "$@" >&- 2>errors || got=$?
  if [ "$got" -ne 1 ] || ! grep -q 'cannot write to standard output: ' errors; then wrong "closed output is not noticed" "$@"; fi
  if ! [ -c /dev/full ]; then return 0; fi
  got=0
  "$@" >/dev/full 2>errors || got=$?
  if [ "$got" -ne 1 ] || ! grep -q 'cannot write to standard output: ' errors; then wrong "a full device is not noticed" "$@"; fi
}
prints() { if ! grep -qF -- "$1" out; then wrong "'$1' is not printed"; fi; }

cat >arm.urdf <<'END'
<robot name="arm">
  <link name="base"/>
  <link name="arm">
    <inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
      <inertia ixx="0.1" iyy="0.1" izz="0.3" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="q" type="continuous">
    <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/><safety_controller k_velocity="1"/><calibration rising="0"/>
  </joint>
</robot>
END
cp "$data"/pendulum.* .
cp pendulum.json pendulum.JSON
cp pendulum.xml 'a model; touch called'
{ printf '\357\273\277' && cat pendulum.json; } >marked
sed 's/^<cereal>/<!-- a <comment> -->\n\n&/' pendulum.xml >commented
