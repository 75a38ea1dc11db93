#!/bin/sh
# kte_header.sh PROGRAM: what `kte-header` does with arguments, files and standard output.
program=$(realpath "$1")
. "$(dirname "$0")/common.sh"

gives 2 usage: "$program"
gives 2 usage: "$program" --no
gives 0 '' "$program" --help
prints 'usage: kte-header'
full "$program" --help
full "$program" pendulum.json

gives 0 '' "$program" pendulum.json
prints 'inline constexpr auto pendulum = pendulum_names::assembled();'
cp out expected
for file in pendulum.kte pendulum.xml pendulum.JSON 'a model; touch called' marked commented; do
  gives 0 '' "$program" "$file" --name pendulum
  if ! cmp -s out expected; then wrong "$file gives another header"; fi
done
gives 0 '' "$program" pendulum.json -o 'a header.hpp'
if [ -s out ] || ! cmp -s 'a header.hpp' expected; then wrong 'the file is another header'; fi
gives 0 "kte-header: arm.urdf:3: link 'arm': the inertia is not physically realizable" "$program" arm.urdf --name class
prints 'inline constexpr auto class_ = class_names::assembled();'
prints 'inline constexpr auto class_limits = '
printf '[' >cut.JSON
gives 1 'cut.JSON:1:1: ' "$program" cut.JSON
gives 1 "cannot open 'no.urdf'" "$program" no.urdf
cp pendulum.json robot.json
gives 1 "the header './robot.json' would replace the robot" "$program" robot.json -o ./robot.json
if ! cmp -s robot.json pendulum.json; then wrong 'the robot is gone'; fi
echo '<robot name="r"><link name="a"><visual><geometry><mesh filename="part.stl"/></geometry></visual></link></robot>' >mesh.urdf
echo 'solid part' >part.stl
gives 1 "the header 'part.stl' would replace 'part.stl', a file of the robot" "$program" mesh.urdf -o part.stl
if ! grep -qx 'solid part' part.stl; then wrong 'a mesh of the robot is gone'; fi
gives 1 "cannot write 'no/a.hpp'" "$program" pendulum.json -o no/a.hpp
if [ -c /dev/full ]; then gives 1 'No space left' "$program" pendulum.json -o /dev/full; fi
if [ -c /dev/zero ]; then gives 1 'has more than 268435456 bytes' "$program" /dev/zero; fi
[ "$failures" -eq 0 ]
