#!/bin/sh
# check.sh xml|json PROJECT: its schema takes good files and refuses each bad one. 77 where the tool is missing.
format=$1
cd "$2" || exit 1

if [ "$format" = xml ]; then
  command -v xmllint >/dev/null || { echo "skipped: there is no xmllint (on Debian libxml2-utils)"; exit 77; }
  valid() { xmllint --noout --nonet --schema docs/schema/kte_model.xsd "$1"; }
  good="tests/data/tutorial.xml tests/fuzz/corpus/model_xml/chain.xml tests/fuzz/corpus/model_xml/robot.xml
    tests/fuzz/corpus/model_xml/archive.xml tests/fuzz/corpus/model_xml/state.xml"
else
  python3 -c 'import jsonschema' 2>/dev/null || { echo "skipped: Python has no jsonschema (on Debian python3-jsonschema)"; exit 77; }
  valid() { python3 -W ignore -m jsonschema -i "$1" docs/schema/kte_model.schema.json; }
  good="tests/data/pendulum.json tests/data/tutorial.json tests/fuzz/corpus/model_json/*.json"
fi

failed=0
for file in $good; do
  valid "$file" || { echo "$file is refused"; failed=1; }
done
for file in tests/schema/bad/*."$format"; do
  if valid "$file" >/dev/null 2>&1; then echo "$file is taken"; failed=1; fi
done
exit $failed
