#!/bin/sh
# kte_eval.sh PROGRAM: what `kte eval` does with arguments, files, standard output and programs that it keeps.
kte=$(realpath "$1")
. "$(dirname "$0")/common.sh"
printf 'q_0,v_0,a_0,tau_0\n0.1,0.2,0,0\n' >states.csv

# Arguments and output.
gives 2 'kte: eval: FILE is required (see kte help eval)' "$kte" eval
gives 2 'kte: eval: STATES is required' "$kte" eval arm.urdf
gives 0 '' "$kte" eval --help
prints '--precision DIGITS'
full "$kte" eval --help
full "$kte" check arm.urdf
full "$kte" eval arm.urdf states.csv
full "$kte" eval arm.urdf states.csv --precision 50
for digits in 17.9 1e300 -17 16 17x 050; do
  gives 2 "--precision is 17 or 50, not '$digits'" "$kte" eval arm.urdf states.csv --precision "$digits"
done
gives 2 '--precision is empty' "$kte" eval arm.urdf states.csv --precision ''
gives 2 '--frame is empty' "$kte" eval arm.urdf states.csv --frame arm --frame ''
gives 2 "--gravity: 'nan' is not finite" "$kte" eval arm.urdf states.csv --gravity nan 0 0
gives 2 "--gravity: '1e999' is not a number" "$kte" eval arm.urdf states.csv --gravity 1e999 0 0

# Tables with zero bytes, and files that are not UTF-8.
printf 'q_0\n0.1\n0.\0002\n' >zero.csv
gives 1 'kte: zero.csv:3:3: here is a zero byte' "$kte" eval arm.urdf zero.csv --ops m
printf '\377\376q\000_\0000\000\n\000' >wide.csv
gives 1 'kte: wide.csv: this is UTF-16, and kte reads UTF-8: save the file as UTF-8' "$kte" eval arm.urdf wide.csv --ops m
printf '\000q\000_\0000\000\n' >wide.csv
gives 1 'kte: wide.csv: this is UTF-16' "$kte" eval arm.urdf wide.csv --ops m
printf '\377\376<\000r\000' >wide.urdf
gives 1 'kte: wide.urdf:1:1: this is UTF-16, and kte reads UTF-8: save the file as UTF-8' "$kte" eval wide.urdf states.csv

# Closed loops.
loop="$data/robots/four_bar.urdf"
printf 'q_0,q_1,q_2,v_0,v_1,v_2,a_0,a_1,a_2\n' >loop.csv
gives 0 'the robot has closed loops, so inverse dynamics is left out' "$kte" eval "$loop" loop.csv
gives 0 '' "$kte" eval "$loop" loop.csv --ops m,energy
for op in id g h did dfd; do
  gives 1 'the robot has closed loops: --ops fd, m, energy and com are evaluated with them' "$kte" eval "$loop" loop.csv --ops $op
done

# Model files are known by what is in them.
gives 0 '' "$kte" eval pendulum.json states.csv
cp out expected
for file in pendulum.kte pendulum.xml pendulum.JSON 'a model; touch called' marked commented; do
  gives 0 '' "$kte" eval "$file" states.csv
  if ! cmp -s out expected; then wrong "$file gives other numbers"; fi
done
head -c 40 pendulum.kte >cut.kte
printf '[' >cut.JSON
gives 1 'cut.kte, byte 40: ' "$kte" eval cut.kte states.csv
gives 1 'cut.JSON:1:1: ' "$kte" eval cut.JSON states.csv
gives 0 '' "$kte" check pendulum.kte
gives 1 'pendulum.kte is a model file, which is used unchanged' "$kte" eval pendulum.kte states.csv --floating-base

# What is odd is said once, before the table, and what is not read by --check.
gives 0 'kte: arm.urdf:3: link '"'arm': the inertia is not physically realizable" "$kte" eval arm.urdf states.csv
if [ "$(wc -l <errors)" -ne 1 ]; then wrong 'more than one warning'; fi
gives 0 '' "$kte" check arm.urdf
prints "arm.urdf:3: link 'arm': the inertia is not physically realizable"
prints 'not read (2):'
prints "  line 8: joint 'q': <calibration>: not read"
prints "  line 8: joint 'q': <safety_controller>: its k_velocity is not read"
sed 's/"continuous"/"floating"/; s|<axis |<dynamics friction="1"/>&|' arm.urdf >floating.urdf
gives 0 '' "$kte" check floating.urdf
prints "floating.urdf:7: joint 'q': left out, as it has several degrees of freedom: friction"
sed 's|<axis |<origin rpy="1.5708 1.5708 0"/>&|' arm.urdf >turned.urdf
gives 0 "turned.urdf:8: joint 'q': <origin>: the angle 1.5708" "$kte" eval turned.urdf states.csv
if [ "$(grep -c 'the angle' errors)" -ne 1 ]; then wrong 'a warning comes twice'; fi
gives 0 '' "$kte" check turned.urdf
if [ "$(grep -c 'the angle' out)" -ne 1 ]; then wrong 'a warning comes twice'; fi
sed -i 's/izz="0.3"/izz="0.1"/' arm.urdf
gives 0 '' "$kte" check arm.urdf
prints 'arm.urdf: nothing odd is found'
prints 'not read (2):'

# Robots that do not load, and files without an end.
sed 's/parent link="base"/parent link="nothing"/' arm.urdf >bad.urdf
gives 1 "'nothing'" "$kte" eval bad.urdf no_states.csv
gives 1 "cannot open 'no_states.csv'" "$kte" eval arm.urdf no_states.csv
if [ -c /dev/zero ]; then
  gives 1 'kte: /dev/zero: has more than 268435456 bytes' "$kte" eval arm.urdf /dev/zero
  gives 1 'kte: /dev/zero:1: the file has more than 268435456 bytes' "$kte" eval /dev/zero states.csv
  if (ulimit -v 200000 && "$kte" eval --help) >out 2>errors; then
    : >out
    gives 1 'kte: not enough memory' sh -c 'ulimit -v 200000 && exec "$0" "$@"' "$kte" eval arm.urdf /dev/zero
  fi
fi

# Programs for one robot. This compiler makes a script; `works` is what the script does.
cat >compiler <<'END'
#!/bin/sh
echo compiled >>"$log"
echo 'no part of the table'
for word; do case $last in -o) printf '#!/bin/sh\n%s\nexit 0\n' "$works" >"$word" && chmod +x "$word" ;; esac; last=$word; done
END
chmod +x compiler
mkdir 'home "$(touch called)'"'; touch called; '"
export CXX="$folder/compiler -DWORD" HOME="$folder/home \"\$(touch called)'; touch called; '" log="$folder/log"
unset XDG_CACHE_HOME
export works='echo table "$2" ops "$3" "$4"; printf ! >&3'
static() { gives "$1" "$2" "$kte" eval arm.urdf states.csv --static; }
compiled() { # compiled TIMES, since the last time
  if [ "$(cat log 2>/dev/null | wc -l)" -ne "$1" ]; then wrong "not compiled $1 times"; fi
  rm -f log
}
kept=$HOME/.cache/kte
static 0 'compiling'
prints 'table states.csv ops  0'
if grep -q 'no part' out; then wrong 'what the compiler says is in the table'; fi
static 0 ''
prints 'table states.csv ops  0'
compiled 1
if [ "$(stat -c %a "$kept")" != 700 ] || [ "$(ls "$kept" | wc -l)" -ne 1 ]; then wrong "$(ls -la "$kept")"; fi
chmod 755 "$kept"
static 0 ''
if [ "$(stat -c %a "$kept")" != 700 ]; then wrong 'the folder is not private'; fi
program=$kept/$(ls "$kept")
for damage in 'truncate -s -1' 'truncate -s 0' 'truncate -s 10' 'cp /bin/true' 'sed -i s/table/tablE/'; do
  $damage "$program"
  static 0 'compiling'
  prints 'table states.csv'
  compiled 1
done

rm -f log
gives 0 'compiling' "$kte" eval arm.urdf states.csv --static --precision 50
gives 0 '' "$kte" eval arm.urdf states.csv --static --ops id,m --derivatives
prints 'table states.csv ops id,m 1'
compiled 1

# A program that others may have put there is not run; damaged ones are made anew.
chmod 770 "$program"
static 1 'as it may be written by others'
chmod 700 "$program"
cp -p "$program" aside && rm "$program" && ln -s "$folder/aside" "$program"
static 1 'as it is a link'
rm "$program" && mkdir "$program"
static 1 'as it is not a file'
rmdir "$program" && mkfifo "$program"
static 1 'as it is not a file'
rm "$program"
if [ "$(id -u)" -eq 0 ]; then
  cp -p aside "$program" && chown 12345 "$program"
  static 1 'as it belongs to another user'
  rm "$program"
fi
(umask 000 && static 0 'compiling' && [ "$(stat -c %a "$program")" = 700 ]) || wrong 'a kept program may be written by others'
rm -f log

# A program that does not say that it has done all; others fail as they should.
for works in 'true' 'echo half a table' 'exit 0' 'exit 5' 'kill -9 $$'; do
  rm -rf "$kept"
  got=0
  "$kte" eval arm.urdf states.csv --static >out 2>errors || got=$?
  if [ "$got" -ne 1 ] || ! grep -q 'failed: it ended' errors; then wrong "'$works' is taken for a table"; fi
done
rm -rf "$kept"
works='printf ! >&3; echo kte: it fails >&2; exit 1'
static 1 'kte: it fails'
rm -rf "$kept"
rm -f log
works='echo table; printf ! >&3'

# What no program can have is said before it is compiled.
gives 1 "'nowhere'" "$kte" eval arm.urdf states.csv --static --frame nowhere
gives 1 "'joint' is a frame in the plane" "$kte" eval pendulum.json states.csv --static --frame joint
compiled 0

# Compilers that fail leave nothing.
CXX=false static 1 "'false' does not compile the program for this robot: it ended with exit code 1"
CXX=/nowhere/g++ static 1 "cannot run '/nowhere/g++'"
if [ -n "$(ls "$kept")" ]; then wrong 'there is something left'; fi

# Folders that others may write to.
unsafe() {
  static 1 "$1"
  compiled 0
  rm -rf "$kept"
}
chmod 770 "$kept"
unsafe 'as it may be written by others'
mkdir planted && ln -s "$folder/planted" "$kept"
unsafe 'as it is a link'
echo >"$kept"
unsafe 'as it is not a folder'
if [ "$(id -u)" -eq 0 ]; then
  mkdir -m 700 "$kept" && chown 12345 "$kept"
  unsafe 'as it belongs to another user'
fi

# Folders above it that others may write to, unless they are sticky, as /tmp is.
chmod 777 "$HOME/.cache"
unsafe 'as it may be written by others'
chmod 1777 "$HOME/.cache"
static 0 'compiling'
rm -rf "$kept" log
chmod 700 "$HOME/.cache"

# Where the cache is.
XDG_CACHE_HOME=relative static 0 'compiling'
if [ -e relative ] || [ ! -d "$kept" ]; then wrong 'a relative XDG_CACHE_HOME is used'; fi
XDG_CACHE_HOME=$folder/xdg static 0 'compiling'
if [ ! -d xdg/kte ] || [ "$(stat -c %a xdg)" != 700 ]; then wrong 'XDG_CACHE_HOME is not used, or not private'; fi
rm -f log
for HOME in '' relative; do
  static 1 'set one of them to an absolute path'
  XDG_CACHE_HOME=relative static 1 'set one of them to an absolute path'
done
HOME=$folder/states.csv static 1 "cannot make '$folder/states.csv/.cache': Not a directory"
unset HOME
static 1 'set one of them to an absolute path'
compiled 0
if [ -e relative ]; then wrong 'a relative HOME is used'; fi

# No name is read by a shell.
if [ -n "$(find . -name called)" ]; then wrong "a shell has read a file's name"; fi
[ "$failures" -eq 0 ]
