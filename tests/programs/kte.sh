#!/bin/sh
# kte.sh PROGRAM: what the commands of `kte` do with arguments, files and standard output, but for `kte eval`.
kte=$(realpath "$1")
sources=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/common.sh"
printf 'q_0,v_0\n0.1,0\n' >start.csv
json() { if ! python3 -m json.tool out >/dev/null 2>&1; then wrong "not JSON: $*"; fi; }
if ! command -v python3 >/dev/null; then json() { :; }; fi

# The command line.
gives 2 'kte: A subcommand is required (see kte help)' "$kte"
gives 2 "kte: there is no command 'simulat', did you mean 'simulate'? (see kte help)" "$kte" simulat x.urdf
gives 0 '' "$kte" --version
prints 'kte '
gives 0 '' "$kte" --help
gives 0 '' "$kte" help
full "$kte" help
gives 2 "there is no command 'nothing'" "$kte" help nothing
for command in $("$kte" help --list); do
  gives 0 '' "$kte" help "$command"
  prints "usage: kte $command"
  cp out expected
  gives 0 '' "$kte" "$command" --help
  if ! cmp -s out expected; then wrong "help $command and $command --help differ"; fi
  if [ "$command" != help ]; then gives 2 "(see kte help $command)" "$kte" "$command" --nothing; fi
done
gives 0 '' "$kte" help --man
if ! cmp -s out "$sources/share/man/man1/kte.1"; then wrong 'share/man/man1/kte.1 is not what kte help --man prints'; fi
for command in $("$kte" help --list); do
  for option in $("$kte" help "$command" --list); do
    if ! sed 's/\\-/-/g' "$sources/share/man/man1/kte.1" | grep -qw -- "$option"; then wrong "$command $option is not in the man page"; fi
  done
done
if command -v bash >/dev/null; then
  mkdir bin && ln -s "$kte" bin/kte
  complete() { PATH=$PWD/bin:$PATH bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); compopt() { :; }; _kte; echo "${COMPREPLY[*]}"' \
    "$sources/share/bash-completion/completions/kte" "$@" >out 2>errors; }
  complete kte si && prints simulate
  complete kte help b && prints bench
  complete kte view --op && prints --open
  complete kte view arm.ur && prints arm.urdf
fi

# check
gives 0 '' "$kte" check arm.urdf
prints "arm.urdf:3: link 'arm': the inertia is not physically realizable"
prints 'arm.urdf (URDF): 1 degree of freedom (1 revolute), 1 body of 1 kg, 2 frames, 0.5 m large'
gives 0 '' "$kte" check arm.urdf --json
json check
prints '"is_mechanism":true'
got=0
"$kte" check arm.urdf --strict >out 2>errors || got=$?
if [ "$got" -ne 1 ]; then wrong 'check --strict is content with what is odd'; fi
gives 0 '' "$kte" check pendulum.kte --strict
prints 'pendulum.kte: nothing odd is found'
sed 's/parent link="base"/parent link="nothing"/' arm.urdf >bad.urdf
got=0
"$kte" check bad.urdf >out 2>errors || got=$?
if [ "$got" -ne 1 ]; then wrong 'a file that is no mechanism has exit code 0'; fi
prints "bad.urdf:7: joint 'q': "
sed 's|<axis |<limit lower="-180" upper="180" effort="1" velocity="1"/>&|; s/"continuous"/"revolute"/' arm.urdf >degrees.urdf
gives 0 '' "$kte" check degrees.urdf
prints "coordinate 'q': its range ends at -180 rad: is that in degrees?"
sed 's/0 0 -0.5/0 0 -500/' arm.urdf >millimetres.urdf
gives 0 '' "$kte" check millimetres.urdf
prints 'it is 500 m large: are lengths in mm?'
# Motors that exert a force without a command: said, unless they are added.
cat >motor.xml <<'X'
<mujoco><worldbody><body><joint name="q" axis="0 1 0"/><inertial pos="1 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
<actuator><position name="p" joint="q" kp="20"/></actuator></mujoco>
X
servo="by motors alone, as of kte live and kte simulate --motors: 'p'"
gives 0 '' "$kte" check motor.xml
prints "motor.xml:2: position 'p': the chain has its force, and that of any <position>, $servo"
gives 0 "$servo" "$kte" simulate motor.xml --time 0.1
gives 0 '' "$kte" simulate motor.xml --time 0.1 --motors

# Findings of one kind are grouped, and numbers of coordinates are those of tables.
{
  echo '<robot name="many"><link name="base"/>'
  for i in 1 2 3 4 5 6 7; do
    echo "<link name=\"l$i\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"3.$i\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
    echo "<joint name=\"j$i\" type=\"continuous\"><parent link=\"base\"/><child link=\"l$i\"/></joint>"
  done
  echo '</robot>'
} >many.urdf
gives 0 '' "$kte" check many.urdf
prints "link 'l3': the inertia is not physically realizable"
prints 'and 4 more of this kind (all: --json)'
if grep -q "'l4'" out; then wrong 'findings of one kind are not grouped'; fi
gives 0 '' "$kte" check many.urdf --json
prints "link 'l7': the inertia is not physically realizable"
mass='<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
cat >order.urdf <<END
<robot name="order"><link name="a"/>
  <joint name="second" type="continuous"><parent link="b"/><child link="c"/></joint>
  <joint name="first" type="continuous"><parent link="a"/><child link="b"/></joint>
  <link name="b">$mass</link><link name="c">$mass</link></robot>
END
gives 0 '' "$kte" info order.urdf
prints 'q[0], v[0]; in tables q_1, v_1'
prints 'q[1], v[1]; in tables q_0, v_0'
gives 0 '' "$kte" info pendulum.json
if grep -q 'in tables' out; then wrong 'info shows columns that are those of q'; fi

# Closed loops in every format.
for file in four_bar.urdf four_bar.xml four_bar.sdf; do
  gives 0 '' "$kte" check "$data/robots/$file"
  prints 'rank 2, mobility 1; these rows follow from others:'
  gives 0 '' "$kte" info "$data/robots/$file"
  prints 'closed loops: '
  gives 0 '' "$kte" simulate "$data/robots/$file" --time 1
done
sed 's/0 0 0.8/0 0 0.7/' "$data/robots/four_bar.urdf" >open.urdf
gives 0 "open.urdf: the start is assembled: the closure 'pin' was open by 0.1" "$kte" simulate open.urdf --time 0.1
sed 's/0 0 0.8/0 0 8/' "$data/robots/four_bar.urdf" >short.urdf
gives 1 "kte: the loops do not close: 'pin' stays open by " "$kte" simulate short.urdf
gives 0 '' "$kte" simulate "$data/robots/four_bar.urdf" --time 0.1 --solver bdf
printf 'q_0\n0.1\n' >one.csv  # joints without a target move freely
gives 0 '' "$kte" simulate "$data/robots/four_bar.urdf" --time 0.1 --pd one.csv
prints "; no target for '"
gives 0 '' "$kte" simulate "$data/robots/four_bar.urdf" --time 0.1 --solver adams
gives 0 '' "$kte" convert "$data/robots/four_bar.sdf" four_bar.kte
gives 0 '' "$kte" check four_bar.kte
prints 'rank 2, mobility 1'

# info
gives 0 '' "$kte" info pendulum.json
prints "joint: revolute z 'q'"
prints 'tip [1 kg]: fixed'
gives 0 '' "$kte" info pendulum.json --json
json info
prints '"name":"tip","planar":true,"parent":"joint"'
gives 0 '' "$kte" info pendulum.json --dot
prints 'digraph kte {'
gives 2 '--json and --dot' "$kte" info pendulum.json --dot --json

mass='<inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
echo '<robot name="box"><link name="box">'"$mass"'<visual><geometry><box size="1 2 2"/></geometry></visual></link></robot>' >box.urdf
for options in '' --floating-base; do
  gives 0 '' "$kte" info box.urdf $options
  prints '3 m large'
done
gives 0 '' "$kte" check box.urdf --floating-base
prints '3 m large'
# A cylinder along x, 2 by 1 by 1, moves, and a floor of 100 m does not.
shape='<visual><origin rpy="0 1.5707963267948966 0"/><geometry><cylinder radius="0.5" length="2"/></geometry></visual>'
floor='<link name="base"><visual><geometry><box size="100 100 1"/></geometry></visual></link>'
sed "s|<link name=\"base\"/>|$floor|; s|<link name=\"arm\">|&$shape|" arm.urdf >rod.urdf
gives 0 'not physically realizable' "$kte" info rod.urdf
prints '2.4495 m large'
sed 's|<geometry>.*</geometry>|<geometry><mesh filename="a.stl"/></geometry>|' box.urdf >unknown.urdf
gives 0 '' "$kte" info unknown.urdf
prints 'of unknown size'

# simulate
gives 0 '' "$kte" simulate pendulum.json --time 1 --start start.csv --record swing.csv
prints 'pendulum.json: 1 s by dormand_prince45'
prints '101 rows in swing.csv'
cp out expected
for solver in prince_dormand87 adams bdf rodas kennedy_carpenter34; do
  gives 0 '' "$kte" simulate pendulum.json --time 1 --start start.csv --tolerance 1e-8 --solver $solver
done
for solver in runge_kutta4 semi_implicit_euler implicit_midpoint moreau_jean; do
  gives 0 '' "$kte" simulate pendulum.json --time 1 --start start.csv --solver $solver
done
cat >ball.json <<END
{"kte_model": {"version": 1, "gravity": "0 -9.81 0", "elements": [
  {"type": "prismatic_joint_2D", "version": 1, "ports": {"coordinate": "x", "base": "ground", "end": "slide"}, "parameters": {"axis": "1 0 0"}},
  {"type": "prismatic_joint_2D", "version": 1, "ports": {"coordinate": "y", "base": "slide", "end": "lift"}, "parameters": {"axis": "0 1 0"}},
  {"type": "revolute_joint_2D", "version": 1, "ports": {"coordinate": "turn", "base": "lift", "end": "ball"}, "parameters": {"axis": "0 0 1"}},
  {"type": "inertia_2D", "version": 1, "ports": {"frame": "ball"}, "parameters": {"mass": "1", "com": "0 0 0", "inertia": "0 0 0 0 0 0.004"}},
  {"type": "sphere_contact_2D", "version": 1, "ports": {"frame1": "ground", "frame2": "ball", "contact": "floor"},
   "parameters": {"surface_axis": "0 1 0", "surface_radius": "0", "radius": "0.1", "friction": "0.2"}}]}}
END
printf 'q_0,q_1,q_2,v_0,v_1,v_2\n0,0.1,0,1,0,0\n' >rolls.csv
gives 0 '' "$kte" simulate ball.json --time 2 --start rolls.csv --solver moreau_jean --step 1e-4 --record rolling.csv --column floor/force
prints 'x: q 1.4493'
if ! tail -n 1 rolling.csv | grep -q ',9\.8[01]'; then wrong 'the force of a contact is not recorded'; fi
# A run that fails at the start leaves the earlier recording, and nothing else.
cp rolling.csv earlier.csv
printf 'tau_0\n1e308\n' >huge.csv
gives 1 'integration stopped at t = 0: ' "$kte" simulate pendulum.json --input huge.csv --record rolling.csv
if ! cmp -s rolling.csv earlier.csv; then wrong 'a run that fails at the start changes the earlier recording'; fi
gives 1 'integration stopped at t = 0: ' "$kte" simulate pendulum.json --input huge.csv --record new.csv
gives 1 "contact 'floor' is 0.1" "$kte" simulate ball.json --solver moreau_jean --record new.csv
for part in ./*.part new.csv; do
  if [ -e "$part" ]; then wrong "$part remains"; fi
done
# One that fails later leaves the rows until then.
printf 't,tau_0\n0,0\n0.5,0\n0.6,1e308\n' >late.csv
gives 1 'integration stopped at t = 0.4999' "$kte" simulate pendulum.json --input late.csv --record late_rows.csv
tail -n 1 late_rows.csv >out
prints '0.49,'
# One that is killed leaves the rows that were flushed, every second.
timeout -s KILL 4 "$kte" simulate pendulum.json --time 5e4 --every 0.001 --start start.csv --record rolling.csv >out 2>errors || true
if cmp -s rolling.csv earlier.csv || [ "$(wc -l <rolling.csv)" -lt 100 ]; then wrong 'a killed run leaves no rows'; fi
for part in ./*.part; do
  if [ -e "$part" ]; then wrong "$part remains"; fi
done
mkfifo pipe.csv && { timeout 60 cat pipe.csv >piped & }
gives 0 '' "$kte" simulate pendulum.json --time 1 --start start.csv --record pipe.csv
wait
if ! cmp -s piped swing.csv; then wrong 'a pipe gets other rows'; fi
# Rows are those asked for; events are rows on demand.
sed 's/"friction": "0.2"/"friction": "0.2", "restitution": "0.5"/' ball.json >bouncing.json
printf 'q_0,q_1,q_2,v_0,v_1,v_2\n0,1,0,0,0,0\n' >falls.csv
gives 0 '' "$kte" simulate bouncing.json --time 1 --every 0.25 --start falls.csv --record bouncing.csv
prints '5 rows in bouncing.csv'
cut -d, -f1 bouncing.csv | tr '\n' ' ' >out
prints 't 0.0 0.25 0.5 0.75 1.0 '
gives 0 '' "$kte" simulate bouncing.json --time 1 --every 0.25 --start falls.csv --record events.csv --event-rows
prints '2 events'
prints '9 rows in events.csv'
cut -d, -f1 events.csv | uniq -d >out
if [ "$(wc -l <out)" -ne 2 ]; then wrong 'events have no rows before and after'; fi
gives 0 'wrote events.html' "$kte" view bouncing.json events.csv -o events.html
gives 0 '' "$kte" simulate bouncing.json --time 1 --start falls.csv --events
prints "  0.42835"
prints "'floor': impact"
gives 0 '' "$kte" simulate bouncing.json --time 1 --start falls.csv --events --json
json simulate
prints '"event_list":[{"time":0.42835'
gives 2 '--column, --frames and --event-rows need --record' "$kte" simulate bouncing.json --event-rows
gives 0 '' "$kte" simulate pendulum.json --time 1 --start start.csv --record again.csv --column energy/total --column t
if ! cmp -s again.csv swing.csv; then wrong 'columns that are recorded anyway are there twice'; fi
for file in swing.npy swing.mcap swing.tsv; do
  gives 0 '' "$kte" simulate pendulum.json --time 1 --start start.csv --record $file --frames --column tip/velocity
  if [ ! -s $file ]; then wrong "$file is empty"; fi
done
if ! grep -qa foxglove.FrameTransforms swing.mcap; then wrong 'MCAP has nothing to see in space'; fi
head -1 swing.csv >out
prints 't,q,q/v,q/a,q/f,energy/kinetic,energy/potential,energy/total'
gives 0 '' "$kte" simulate pendulum.json --time 1 --start swing.csv --json  # its first row
json simulate
prints '"rejected":'
printf 't,q_0\n0,0\n1,1\n' >target.csv
gives 0 '' "$kte" simulate pendulum.json --time 3 --pd target.csv
prints "PD control: 'q' 25 and 5"
gives 0 '' "$kte" simulate pendulum.json --time 5 --pd target.csv --compensate --json
reached() { sed 's/.*"q":\[\([^]]*\)\].*/\1/' out | awk -v from="$1" -v to="$2" '{ exit !($1 > from && $1 < to) }' || wrong "q is not between $1 and $2"; }
reached 0.999999 1.000001
gives 0 '' "$kte" simulate pendulum.json --time 5 --pd target.csv --kp 1000 --kd 100 --json  # 4.905 cos(q) / 1000 below
reached 0.99725 0.99745
printf 't,q\n1,1\n0,1\n' >backwards.csv
gives 1 'backwards.csv:3: t must grow from row to row' "$kte" simulate pendulum.json --pd backwards.csv
printf 'q_0\n1\n' >one_target.csv
gives 1 "PD control of 'q': its force, or the square of that, is not finite: kp 1e+308 times 1, kd" "$kte" simulate pendulum.json --pd one_target.csv --kp 1e308
gives 1 "PD control of 'q': its force, or the square of that, is not finite" "$kte" simulate pendulum.json --pd one_target.csv --kd 1e308
printf 'q_0\n1e308\n' >one_target.csv
gives 1 "is not finite: kp 25 times 1e+308, kd 5 times 0" "$kte" simulate pendulum.json --pd one_target.csv
gives 2 'simulate: --tolerance must be at most 0.1, a tenth of each number, not 10' "$kte" simulate pendulum.json --tolerance 10
gives 2 'bench: --seconds must be greater than 0 and at most 3600, not 1e+300' "$kte" bench pendulum.json --seconds 1e300
gives 0 "arm.urdf: --model 'x' is not used: the file is no SDF, and has one robot, 'arm'" "$kte" info arm.urdf --model x
gives 2 'simulate: --kp must not be negative, not -5' "$kte" simulate pendulum.json --pd target.csv --kp -5
gives 2 'simulate: --kd must not be negative, not -1' "$kte" simulate pendulum.json --pd target.csv --kd -1
printf 'tau_0\n4.905\n' >torque.csv
gives 0 '' "$kte" simulate pendulum.json --time 1 --input torque.csv
prints 'change of energy: 0 J'
printf 'motor\n1\n' >torque.csv
gives 1 "torque.csv:1: 'motor' is no input; there are tau_0 to tau_0" "$kte" simulate pendulum.json --input torque.csv
gives 1 "has no extension of a table" "$kte" simulate pendulum.json --record swing.txt2
gives 1 "cannot write 'none/a.csv'" "$kte" simulate pendulum.json --record none/a.csv
gives 2 'a recording has 1e+08 rows at most' "$kte" simulate pendulum.json --every 1e-12 --record swing.csv
gives 2 '--time must be greater than 0' "$kte" simulate pendulum.json --time -1
gives 2 '--step: '"'0x'"' is not a number' "$kte" simulate pendulum.json --step 0x
for angle in -1 1e+300; do
  gives 2 "--quarter-turns is between 0 and 0.1, not $angle" "$kte" check arm.urdf --quarter-turns $angle
done
gives 2 '--record is empty' "$kte" simulate pendulum.json --record ''
gives 2 '--output is empty' "$kte" view pendulum.json -o ''
gives 2 '--column is empty' "$kte" simulate pendulum.json --record none.csv --column q --column ''
for command in simulate view live; do
  gives 1 "has no configuration 'home'" "$kte" $command arm.urdf --configuration home
  gives 1 "cannot open 'none.csv'" "$kte" $command pendulum.json --start none.csv
done
for command in simulate live; do
  gives 2 "there is no solver 'rk4', but dormand_prince45" "$kte" $command pendulum.json --solver rk4
  gives 2 '--tolerance must be greater than 0' "$kte" $command pendulum.json --tolerance 0
  gives 2 '--tolerance must be at least 8.8818e-16, 4 rounding errors, not 1e-300' "$kte" $command pendulum.json --tolerance 1e-300
  gives 2 '--step must be greater than 0' "$kte" $command pendulum.json --step -1
done
gives 1 'there is no column q_0 or v_0' "$kte" simulate pendulum.json --start backwards.csv --pd torque.csv
printf 'q_0\nnan\n' >nan.csv
gives 1 "nan.csv:2:1: 'nan' is not finite" "$kte" simulate pendulum.json --start nan.csv
printf 'q_0,v_0\n' >no_rows.csv
gives 1 'no_rows.csv: has no row of numbers' "$kte" simulate pendulum.json --start no_rows.csv

# view and plot
gives 0 'kte: wrote pendulum.html' "$kte" view pendulum.json
gives 0 'kte: wrote a page.html' "$kte" view arm.urdf -o 'a page.html'
if ! grep -q '"format": *"kte-scene-1"' 'a page.html'; then wrong 'the page has no scene'; fi
for file in swing.csv swing.npy swing.mcap swing.tsv; do
  gives 0 'kte: wrote swing.html' "$kte" view pendulum.json $file -o swing.html
done
gives 0 'kte: wrote both.html' "$kte" view pendulum.json swing.csv swing.npy --output both.html --title Both
gives 0 'kte: wrote pendulum.html' "$kte" view pendulum.json --start start.csv
if ! grep -q '"q":\[0.1\]' pendulum.html; then wrong 'the page does not begin at --start'; fi
gives 2 '--start and --configuration are for pages without a recording' "$kte" view pendulum.json swing.csv --start start.csv
gives 0 'kte: wrote swing.html' "$kte" view pendulum.json swing.csv -o swing.html --column energy/total --column tip/position --column tip/velocity
grep -o '"plotted":\[[^]]*\]' swing.html >out
prints '"plotted":["energy/total","tip/position/x","tip/position/y","tip/velocity/x","tip/velocity/y"]'
gives 2 '--column is for pages with a recording' "$kte" view pendulum.json --column q
gives 1 "the recording has no column 'tip/force': kte simulate --record writes it with --column tip/force" "$kte" view pendulum.json swing.csv --column tip/force
gives 1 "swing.csv: " "$kte" view pendulum.json swing.csv --column tib/position
printf 't,q\n0,0\n1,1\n' >slow.csv
gives 1 "the recording has no column 'tip/velocity', and none of the velocities, which determine it" "$kte" view pendulum.json slow.csv --column tip/velocity
gives 0 'kte: wrote slow.html' "$kte" view pendulum.json slow.csv --column tip/position/x -o slow.html
gives 2 '--recording-size is between 0 and 1024, not -1' "$kte" view pendulum.json swing.csv --recording-size -1
gives 0 '' "$kte" simulate pendulum.json --time 10 --every 0.001 --record long.csv
gives 0 'wrote long.html' "$kte" view pendulum.json long.csv -o long.html --recording-size 0.1
if ! grep -q 'rows of the recording' long.html; then wrong 'a long recording is not thinned out'; fi
gives 0 'wrote long.html' "$kte" view pendulum.json long.csv -o long.html
if grep -q 'rows of the recording' long.html; then wrong 'a recording is thinned out'; fi
printf 't,x\n0,1\n' >none.csv
gives 1 "none.csv: the table has no columns of coordinates by which the mechanism moves: 'q'" "$kte" view pendulum.json none.csv
gives 1 "cannot run 'xdg-open'" env PATH=/nowhere "$kte" view pendulum.json --open
mkdir browser && printf '#!/bin/sh\nprintf "%%s\\n" "$@" >>"$0.log"\n' >browser/xdg-open && chmod +x browser/xdg-open
gives 0 'kte: wrote -a; touch called.html' env PATH="$PWD/browser:$PATH" "$kte" view pendulum.json --open -o '-a; touch called.html'
if ! grep -qxF "$PWD/-a; touch called.html" browser/xdg-open.log; then wrong 'xdg-open gets another name'; fi
gives 0 'kte: wrote swing.svg' "$kte" plot swing.csv q energy/total
if ! grep -q '<svg' swing.svg; then wrong 'no SVG'; fi
gives 0 'kte: wrote other.svg' "$kte" plot swing.npy -o other.svg
gives 1 "swing.csv: cannot plot 'nothing': there is no such column" "$kte" plot swing.csv nothing
gives 2 "'swing.pdf' is not the name of a picture: these end in .svg or .png" "$kte" plot swing.csv q -o swing.pdf
gives 0 'kte: wrote units.svg' "$kte" plot swing.csv q q/v --of pendulum.json -o units.svg
for text in 'q (rad)' 'q/v (rad/s)'; do
  if ! grep -qF "$text" units.svg; then wrong "the axis has no unit: $text"; fi
done
gives 2 '--dpi is of PNG' "$kte" plot swing.csv q --dpi 100
gives 2 '--dpi is between 10 and 2400, not 3' "$kte" plot swing.csv q --dpi 3 -o swing.png
gives 1 "cannot run 'rsvg-convert': No such file or directory; it makes PNG (Debian: librsvg2-bin), SVG is written without it" \
  env PATH=/nowhere "$kte" plot swing.csv q -o swing.png
mkdir converter temporary && printf '#!/bin/sh\nexit 3\n' >converter/rsvg-convert && chmod +x converter/rsvg-convert
gives 1 "cannot write 'swing.png': rsvg-convert ended with exit code 3" \
  env TMPDIR="$PWD/temporary" PATH="$PWD/converter:$PATH" "$kte" plot swing.csv q -o swing.png
if [ -e swing.png ]; then wrong 'a picture that failed is there'; fi
if command -v rsvg-convert >/dev/null; then
  gives 0 'kte: wrote $(touch called).PNG' env TMPDIR="$PWD/temporary" "$kte" plot swing.csv q --width 85 --dpi 100 -o '$(touch called).PNG'
  size() { od -An -tu1 -j16 -N8 "$1" | awk '{ print 256 * $3 + $4 }'; }  # its width
  if [ "$(head -c 4 '$(touch called).PNG' | tail -c 3)" != PNG ]; then wrong 'no PNG'; fi
  if [ "$(size '$(touch called).PNG')" -ne 335 ]; then wrong "85 mm at 100 dpi are not 335 points: $(size '$(touch called).PNG')"; fi
else
  echo 'skipped: rsvg-convert (Debian: librsvg2-bin)'
fi
if [ -n "$(ls temporary)" ]; then wrong "kte plot leaves files: $(ls temporary)"; fi

# ik
sed 's/"continuous"/"prismatic"/; s/axis xyz="0 1 0"/axis xyz="1 0 0"/' arm.urdf >slide.urdf
printf 'x,y,z\n0.25,0,0\n' >poses.csv
gives 0 "slide.urdf:3: link 'arm': the inertia is not physically realizable" "$kte" ik slide.urdf --frame arm --poses poses.csv
prints 'pose,status,q_0,position_error,rotation_error'
prints '0,reached,0.2'
gives 0 "not physically realizable" "$kte" ik slide.urdf --frame arm --poses poses.csv --json
json ik
prints '"status":"reached"'
printf 'x,y,z\n0.25,1,0\n' >far.csv
got=0
"$kte" ik slide.urdf --frame arm --poses far.csv >out 2>errors || got=$?
if [ "$got" -ne 1 ] || ! grep -q '1 of 1 poses are not reached' errors; then wrong 'a pose out of reach is reached'; fi
gives 2 '--frame is required' "$kte" ik slide.urdf --poses poses.csv
gives 2 '--poses is required' "$kte" ik slide.urdf --frame arm
gives 1 "'no'" "$kte" ik slide.urdf --frame no --poses poses.csv
printf 'x,y,z,qw\n' >poses.csv
gives 1 'poses.csv:1: missing columns: qx, qy, qz' "$kte" ik slide.urdf --frame arm --poses poses.csv

printf 'x,y,z\n1e308,1,0\n' >far.csv
gives 1 'kte: far.csv:2: a desired position must be finite, as must its square, got (1e+308, 1, 0)' "$kte" ik slide.urdf --frame arm --poses far.csv
printf 'x,y,z,qw,qx,qy,qz\n1e308,0.1,0.6,0,1,0,0\n' >far.csv
gives 1 'far.csv:2: inverse kinematics: the position, or its square, is not finite' "$kte" ik "$data/robots/iiwa14.urdf" --frame tool --poses far.csv --all
printf 'x,y,z,qw,qx,qy,qz\n0.5,0.1,0.6,1,1,0,0\n' >turned.csv
"$kte" ik "$data/robots/iiwa14.urdf" --frame tool --poses turned.csv >expected 2>errors
for size in 1e308 1e-200; do
  sed "2s/1,1,0,0/$size,$size,0,0/" turned.csv >far.csv
  gives 0 '' "$kte" ik "$data/robots/iiwa14.urdf" --frame tool --poses far.csv
  if ! cmp -s out expected; then wrong "a quaternion of length $size is another rotation"; fi
done

# An output that is also an input is refused, by whatever path, and stays.
cp pendulum.json robot.json && ln -s robot.json link.json && ln robot.json hard.json && ln -s . here
cp swing.csv t.csv && cp start.csv s.csv && cp robot.json robot.svg && cp swing.csv picture.svg
refused() {
  gives 2 'which it would replace' "$kte" "$@"
  if ! cmp -s robot.json pendulum.json || ! cmp -s t.csv swing.csv || ! cmp -s s.csv start.csv; then wrong "an input is gone" "$@"; fi
}
for out in robot.json ./robot.json here/robot.json link.json hard.json "$PWD/robot.json"; do
  refused view robot.json -o "$out"
  refused convert robot.json "$out"
done
refused view robot.json t.csv -o t.csv
refused view robot.json swing.csv t.csv -o ./t.csv
refused view robot.json --start s.csv -o s.csv
refused simulate robot.json --pd t.csv --record t.csv
refused simulate robot.json --input t.csv --record here/t.csv
refused simulate robot.json --start s.csv --record s.csv
refused plot picture.svg -o ./picture.svg
refused plot t.csv --of robot.svg -o robot.svg
cp robot.json robot.csv
refused simulate robot.csv --record robot.csv

# convert
for file in a.json a.xml a.kte a.hpp; do
  gives 0 '' "$kte" convert pendulum.json $file
  if [ ! -s $file ]; then wrong "$file is empty"; fi
done
cmp -s a.kte pendulum.kte || wrong 'pendulum.kte is another'
gives 0 '' "$kte" convert pendulum.xml - --to json
cmp -s out a.json || wrong 'JSON from XML is another'
gives 0 '' "$kte" convert pendulum.json - --to hpp --name swing
prints 'inline constexpr auto swing = swing_names::assembled();'
gives 0 "arm.urdf:8: joint 'q': <calibration>: not read" "$kte" convert arm.urdf again.urdf
gives 0 '' "$kte" check again.urdf
gives 1 'moments' "$kte" convert arm.urdf arm.mjcf
if [ -e arm.mjcf ]; then wrong 'there is half a file'; fi
gives 0 'moments' "$kte" convert arm.urdf arm.mjcf --lossy
gives 0 '' "$kte" check arm.mjcf
gives 1 'SDF is read, but not written' "$kte" convert arm.urdf arm.sdf
gives 2 "there is no format 'png'" "$kte" convert arm.urdf arm.png
gives 2 'says no format' "$kte" convert arm.urdf arm
gives 1 'revolute_joint_2D' "$kte" convert pendulum.json a.urdf

# bench
gives 0 '' "$kte" bench pendulum.json --seconds 0.001
prints 'forward dynamics'
gives 0 '' "$kte" bench pendulum.json --seconds 0.001 --json
json bench
prints '"errors_against":"50 digits"'

# Files that are none, or have odd names.
mkdir folder && : >empty && head -c 1000 /dev/urandom >binary
name='x "$(touch called)'"'; touch called
.urdf"
cp arm.urdf "$name"
escape=$(printf '\033[31m.urdf')
for command in check info simulate view bench; do
  gives 1 "cannot read 'folder': Is a directory" "$kte" $command folder
  gives 1 'kte: empty' "$kte" $command empty
  gives 1 'kte: binary' "$kte" $command binary
  gives 1 "cannot open 'none.urdf'" "$kte" $command none.urdf
  gives 1 '\x1B[31m.urdf' "$kte" $command "$escape"
done
"$kte" info "$name" >out 2>errors || wrong 'a name with quotes and a newline is refused'
prints '\x0A.urdf'
if [ "$(wc -l <errors)" -ne 1 ]; then wrong 'a warning is more than a line'; fi
"$kte" convert "$name" "$name.json" 2>errors || wrong 'such a name is not written'
"$kte" simulate "$name.json" --record "$name.csv" --time 0.1 >out 2>errors || wrong 'such a name is not recorded'
"$kte" view "$name.json" "$name.csv" -o "$name.html" 2>errors || wrong 'such a name is not shown'
turned=$(printf 'arm\342\200\256.urdf')
gives 1 "cannot open 'arm\xE2\x80\xAE.urdf'" "$kte" check "$turned"

# Pages: what is not drawn is said, once a file, and long recordings are thinned out.
mesh() { printf '<visual><geometry><mesh filename="%s"/></geometry></visual>' "$1"; }
printf 'solid x\nfacet\n' >bad.stl
printf '<robot name="r"><link name="a">%s%s%s</link></robot>' "$(mesh bad.stl)" "$(mesh bad.stl)" "$(mesh "$PWD/none.stl")" >meshes.urdf
gives 0 "kte: meshes.urdf: mesh 'bad.stl' is not drawn: bad.stl:3: the file ends in facet 0, where normal must stand (link 'a')" "$kte" view meshes.urdf
if [ "$(grep -c 'is not drawn' errors)" -ne 2 ]; then wrong 'meshes that are not drawn are not one line each'; fi
gives 0 '' "$kte" check meshes.urdf
prints "meshes.urdf: mesh 'bad.stl' is not drawn: bad.stl:3: "
prints "meshes.urdf: mesh 'none.stl' is not drawn: it is not found, neither in the folders around the robot's file nor in those of --search (link 'a')"
gives 0 '' "$kte" info meshes.urdf
prints "  mesh 'bad.stl' is not drawn: bad.stl:3: "
prints "  mesh 'none.stl' is not drawn: it is not found, neither in the folders around the robot's file nor in those of --search (link 'a')"
gives 0 '' "$kte" info meshes.urdf --json
prints '"meshes_not_drawn":["mesh '
sed 's/bad\.stl/bad.dae/g' meshes.urdf >other.urdf
gives 0 '' "$kte" check other.urdf
prints "  mesh 'bad.dae' is not drawn: only .stl, .obj and .msh are read (link 'a')"
if grep -q "$PWD" meshes.html; then wrong 'a page has a folder of this machine'; fi

# Files that a robot's file refers to are inputs, too.
cp bad.stl kept.stl
gives 2 "'bad.stl' of -o is also the input of FILE, which it would replace" "$kte" view meshes.urdf -o bad.stl
gives 2 "'./bad.stl' of OUT is also the input of FILE" "$kte" convert meshes.urdf ./bad.stl --to json
cmp -s bad.stl kept.stl || wrong 'a mesh is replaced'
echo '<mujoco><worldbody><body><joint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody></mujoco>' >part.csv
echo '<mujoco><include file="part.csv"/></mujoco>' >whole.xml
gives 2 "'part.csv' of -o is also the input of FILE" "$kte" view whole.xml -o part.csv
gives 2 "'part.csv' of --record is also the input of FILE" "$kte" simulate whole.xml --record part.csv
echo '<sdf version="1.9"><model name="part"><link name="a"/></model></sdf>' >part.sdf
echo '<sdf version="1.9"><model name="whole"><include><uri>part.sdf</uri></include></model></sdf>' >whole.sdf
gives 2 "'part.sdf' of -o is also the input of FILE" "$kte" view whole.sdf -o part.sdf
"$kte" simulate arm.urdf --record long.csv --time 1 --every 0.0005 >out 2>errors || wrong 'no long recording'
gives 0 "rows of 'long.csv' one in" "$kte" view arm.urdf long.csv --recording-size 0.01
if ! grep -q "of the 2001 rows of 'long.csv' one in" arm.html; then wrong 'the page does not say that rows are left out'; fi
truncate -s 1025M huge.csv
gives 1 'kte: huge.csv: the recording has 1025 MiB, above 1024 MiB' "$kte" view arm.urdf huge.csv
rm huge.csv
gives 0 '' "$kte" check -- pendulum.json
for command in check info; do full "$kte" $command pendulum.json; done

# Options by the names that they have here.
{ echo '<sdf version="1.9">' && for name in a b; do
  echo "<model name='$name'><link name='base'/><link name='arm'/><joint name='q' type='revolute'><parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis></joint></model>"
done && echo '</sdf>'; } >two.sdf
gives 1 "choose one, as by --model \"a\", of 'a', 'b'" "$kte" info two.sdf
gives 1 "has no model 'c' (--model)" "$kte" info two.sdf --model c
printf '<sdf version="1.9"><model name="a"><include><uri>model://nowhere</uri></include></model></sdf>' >include.sdf
gives 1 "nor in those of --search" "$kte" info include.sdf
sed 's|<axis |<origin rpy="1.5707 0 0"/>&|' arm.urdf >near.urdf
gives 0 'a larger --quarter-turns makes it exact' "$kte" simulate near.urdf --time 0.1
gives 0 '' "$kte" check near.urdf --json
prints 'a larger --quarter-turns makes it exact'
sed 's/"base"/"world"/g' arm.urdf >world.urdf
gives 1 "has a link or joint 'world': --floating-base needs this name" "$kte" info world.urdf --floating-base
gives 1 '(--lossy: ' "$kte" convert arm.urdf arm.mjcf
sed 's|<link name="arm">|&<visual><geometry><mesh filename="package://nowhere/arm.stl"/></geometry></visual>|' arm.urdf >mesh.urdf
gives 0 'wrote mesh.html' "$kte" view mesh.urdf
if ! grep -q 'nor in those of --search' mesh.html; then wrong 'the page does not say --search'; fi
for page in ./*.html; do
  if grep '^<script type="application/json"' "$page" | grep -q '_options::'; then wrong "$page has names of options in C++"; fi
done
sed '3s/"version": *1,/&"x_note":"ours",/' pendulum.json >note.json
gives 0 "note.json:3: unknown field 'x_note' is left out" "$kte" simulate note.json --time 0.1
gives 0 '' "$kte" check note.json
prints "unknown field 'x_note' is left out"

# Names of links and joints that tables do not take.
sed 's/"arm"/"upper, arm"/; s/link="arm"/link="upper, arm"/; s/name="q"/name="shoulder \&quot;1\&quot;"/' arm.urdf >names.urdf
gives 0 'not physically realizable' "$kte" simulate names.urdf --time 0.1 --record names.csv --frames
head -1 names.csv >out
prints 't,shoulder__1_,'
prints 'upper__arm/position/x'
gives 0 'wrote names.html' "$kte" view names.urdf names.csv
gives 0 'names.mcap has numbers only' "$kte" simulate names.urdf --time 0.1 --record names.mcap
gives 0 'wrote names.html' "$kte" view names.urdf names.mcap

# Contacts of collision shapes.
cat >foot.urdf <<'END'
<robot name="foot"><link name="leg"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision name="toe"><origin xyz="0 0 -0.4"/><geometry><sphere radius="0.02"/></geometry></collision></link></robot>
END
gives 0 '' "$kte" simulate foot.urdf --floating-base --ground world --contact-stiffness 1e6 --contact-dissipation 1 --solver rodas --time 0.5
prints 'floating_base: q'
gives 1 "no link or frame 'floor' for the ground (--ground): its base is 'leg', or 'world' with --floating-base" "$kte" simulate foot.urdf --ground floor
gives 2 '--contact-dissipation need --ground' "$kte" simulate foot.urdf --friction 1
gives 0 "foot.urdf:2: shape 'toe' of 'leg' is left out" "$kte" convert foot.urdf foot.json --floating-base --ground world --friction 0.5
printf 'q_0,q_1,q_2,q_3,q_4,q_5,q_6\n0,0,0.42,0,0,0,1\n' >stands.csv
gives 0 '' "$kte" simulate foot.json --start stands.csv --time 0.1
gives 0 "foot.urdf:2: shape 'toe' of 'leg' is left out" "$kte" convert foot.urdf foot.hpp --floating-base --ground world
if ! grep -q '::kte::sphere_contact_3D(toe_, world_, leg_, ' foot.hpp; then wrong 'foot.hpp has no contact'; fi
printf 'q_0,q_1,q_2,q_3,q_4,q_5,q_6,v_0,v_1,v_2,v_3,v_4,v_5,tau_0,tau_1,tau_2,tau_3,tau_4,tau_5\n0,0,1,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0\n' >flies.csv
gives 1 "--static does not support rigid contacts; this chain has 'toe'" env HOME="$PWD" "$kte" eval foot.json flies.csv --ops fd --static
gives 2 '--ground is for model files and C++ headers' "$kte" convert foot.urdf again.urdf --ground world
gives 2 '--contact-dissipation need --ground' "$kte" convert foot.urdf foot.json --friction 1
cat >hill.sdf <<'END'
<sdf version="1.9"><model name="m"><link name="leg">
<collision name="hill"><geometry><heightmap><uri>a.png</uri></heightmap></geometry></collision></link></model></sdf>
END
gives 0 '' "$kte" check hill.sdf --floating-base --ground world
prints "hill.sdf:2: collision 'hill': <heightmap>: not read: the ground does not have this surface, but a plane"
gives 2 '--contact-dissipation need --ground' "$kte" check hill.sdf --friction 1

# Files and folders that may not be read or written, for a user who is not root.
nobody() { if [ "$(id -u)" -ne 0 ]; then "$@"; else setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; fi; }
chmod 755 .
if nobody "$kte" --version >/dev/null 2>&1; then
  mkdir locked kept && cp arm.urdf pendulum.json meshes.urdf locked
  for file in arm.urdf pendulum.json target.csv bad.stl start.csv; do cp $file locked.${file##*.} && chmod 000 locked.${file##*.}; done
  cp include.sdf meshes.urdf arm.urdf kept && cp bad.stl kept && chmod 000 kept/bad.stl locked
  for command in info check bench 'simulate --time 0.1'; do
    gives 1 "cannot open 'locked.urdf': Permission denied" nobody "$kte" $command locked.urdf
    gives 1 "cannot open 'locked.json': Permission denied" nobody "$kte" $command locked.json
    gives 1 "Permission denied" nobody "$kte" $command locked/arm.urdf
  done
  printf '<mujoco>\n<include file="locked.urdf"/></mujoco>\n' >including.xml
  gives 1 "including.xml:2: <include>: cannot open 'locked.urdf': Permission denied" nobody "$kte" info including.xml
  gives 1 "cannot open 'locked.csv': Permission denied" nobody "$kte" simulate pendulum.json --start locked.csv
  gives 1 "cannot open 'locked.csv': Permission denied" nobody "$kte" simulate pendulum.json --pd locked.csv
  gives 1 "cannot open 'locked.csv': Permission denied" nobody "$kte" simulate pendulum.json --input locked.csv
  gives 1 "cannot open 'locked.csv': Permission denied" nobody "$kte" plot locked.csv -o /dev/null.svg
  gives 1 "cannot open 'locked.csv': Permission denied" nobody "$kte" view pendulum.json locked.csv -o locked.html
  gives 1 "Permission denied" nobody "$kte" simulate pendulum.json --time 0.1 --record locked/a.csv
  gives 1 "Permission denied" nobody "$kte" convert pendulum.json locked/a.json
  gives 1 "Permission denied" nobody "$kte" view pendulum.json -o locked/a.html
  gives 0 '' nobody "$kte" check kept/meshes.urdf
  prints "mesh 'bad.stl' is not drawn: "
  prints 'Permission denied'
  chmod 755 locked
else
  echo 'skipped: files without permissions, as there is no other user than root'
fi

if [ -n "$(find . -name called)" ]; then wrong "a shell has read a file's name"; fi
[ "$failures" -eq 0 ]
