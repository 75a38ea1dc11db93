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
gives 1 "kte: cannot open 'nothing.urdf'" "$kte" live nothing.urdf
gives 0 'Ctrl-C ends' "$kte" live arm.urdf --time 0.05
if ! grep -q "$address" out; then wrong 'kte live does not print its address'; fi

# It waits for a page, and signals end it.
for signal in INT TERM; do
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
