#!/bin/sh
# The documentation and the API reference as HTML with a search box, in build/docs/html: open index.html there. Offline; no
# arguments; any directory. Needs Debian's mkdocs-material. Fails for public names without a doc comment and for dead links.
set -e
cd "$(dirname "$0")/.."
if ! command -v mkdocs >/dev/null; then
  echo "kte: mkdocs is not installed: apt install mkdocs-material" >&2
  exit 1
fi
mkdir -p build/docs
python3 tools/reference/pages.py build/docs/pages ${1:+"$1"}
mkdocs build --quiet --clean --config-file build/docs/mkdocs.yml
# Pages that are opened as files cannot request the index.
{ printf 'const __search = {index: Promise.resolve('; cat build/docs/html/search/search_index.json; echo ')}'; } >build/docs/html/search/search_index.js
python3 tools/reference/check_links.py build/docs/html
