#!/bin/sh
# kte_live.sh PROGRAM: how `kte live` begins and ends; what its pages do is tested in tests/view and tests/page.
kte=$(realpath "$1")
. "$(dirname "$0")/common.sh"
cat >arm.urdf <<'END'
<robot name="arm">
  <link name="base"/>
  <link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
    <inertia ixx="0.01" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="q" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="10" velocity="1"/></joint>
</robot>
END
address='^http://127\.0\.0\.1:[0-9]*/[0-9a-f]\{32\}/$'

gives 2 '--port is a number up to 65535, not 70000' "$kte" live arm.urdf --port 70000
gives 2 '--port is a number up to 65535, not 80.5' "$kte" live arm.urdf --port 80.5
gives 2 '--speed is between 0.001 and 1000, not 0' "$kte" live arm.urdf --speed 0
gives 2 '--time must be greater than 0, not 0' "$kte" live arm.urdf --time 0
gives 1 "arm.urdf has no configuration 'up'" "$kte" live arm.urdf --configuration up
gives 1 "kte: cannot open 'nothing.urdf'" "$kte" live nothing.urdf
gives 0 'Ctrl-C ends' "$kte" live arm.urdf --time 0.05
if ! grep -q "$address" out; then wrong 'kte live does not print its address'; fi
for solver in adams rodas runge_kutta4; do
  gives 0 'Ctrl-C ends' "$kte" live arm.urdf --time 0.05 --solver $solver --tolerance 1e-5 --step 0.002
done
gives 0 "cannot run 'xdg-open': No such file or directory; install it (Debian: xdg-utils)" \
  env PATH=/nowhere "$kte" live arm.urdf --time 0.05 --open
prints 'http://127.0.0.1:'

# Sliders of motors: range and unit of the command; servos begin where they stand.
cat >arm.mjcf <<'END'
<mujoco><compiler angle="radian"/>
  <worldbody><body name="upper"><joint name="shoulder" type="hinge" axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03" mass="1"/>
    <body name="lower" pos="0.5 0 0"><joint name="elbow" type="hinge" axis="0 1 0" range="-2.5 2.5" limited="true"/>
      <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.03" mass="0.5"/></body></body></worldbody>
  <actuator><motor name="geared" joint="shoulder" gear="40" ctrlrange="-1 2" ctrllimited="true"/>
    <position name="servo" joint="elbow" kp="60"/></actuator>
  <keyframe><key name="up" qpos="0.5 -0.75"/></keyframe>
</mujoco>
END
if command -v python3 >/dev/null; then
  : >out  # of the program before
  "$kte" live arm.mjcf --configuration up --speed 0.001 >out 2>errors &
  program=$!
  python3 - out >sliders <<'END' || wrong 'no event of the page'
import base64, json, struct, sys, time, urllib.request
for _ in range(100):
    url = open(sys.argv[1]).read().strip()
    if url: break
    time.sleep(0.1)
seen = {}
with urllib.request.urlopen(url + 'events', timeout=10) as events:
    for _ in range(1000):
        if {'sliders', 'numbers'} <= seen.keys(): break
        line = events.readline().decode()
        if line.startswith('data: '): seen.update(json.loads(line[6:]))
for s in seen['sliders']: print(s['name'], s['lower'], s['upper'], s['value'], s['unit'])
numbers = base64.b64decode(seen['numbers'])
numbers = struct.unpack(f'<{len(numbers) // 4}f', numbers)
print(*(round(x, 3) for x in numbers[-4::2]))  # the columns q and v of each coordinate are the last
END
  kill "$program" && wait "$program"
  printf '%s\n' 'geared -1 2 0 × 40 N m' 'servo -2.5 2.5 -0.75 rad' 'damping 0 10 0 1/s' '0.5 -0.75' >expected
  if ! cmp -s sliders expected; then wrong "sliders of motors: $(cat sliders)"; fi
else
  echo 'skipped: python3'
fi

# It waits for a page, and signals end it.
for signal in INT TERM; do
  : >out
  "$kte" live arm.urdf >out 2>errors &
  program=$!
  for _ in 1 2 3 4 5 6 7 8 9 10; do
    if grep -q "$address" out; then break; fi
    sleep 1
  done
  if ! grep -q "$address" out; then wrong 'kte live does not print its address'; fi
  port=$(sed 's|http://127.0.0.1:||; s|/.*||' out)
  cp out address
  gives 1 "cannot listen at port $port of 127.0.0.1" "$kte" live arm.urdf --time 1 --port "$port"
  kill -s "$signal" "$program"
  got=0
  wait "$program" || got=$?
  if [ "$got" -ne 0 ]; then wrong "exit code $got after $signal"; fi
done

# --open: the address is in a file that only its user can read, not on a command line.
mkdir bin
cat >bin/xdg-open <<'END'
#!/bin/sh
echo "$1" >opened
ls -ld "$(dirname "$1")" "$1" >>opened
cat "$1" >>opened
END
chmod +x bin/xdg-open
PATH=$PWD/bin:$PATH gives 0 'Ctrl-C ends' "$kte" live arm.urdf --time 0.05 --open
if ! grep -q "$(cat out)" opened || ! grep -q '^drwx------' opened; then
  wrong "what is opened is not private: $(cat opened)"
fi
if [ -e "$(head -n 1 opened)" ]; then wrong 'the way to the page is still there'; fi

[ "$failures" -eq 0 ]
