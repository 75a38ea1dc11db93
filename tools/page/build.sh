#!/bin/sh
# Makes share/kte/page.html and share/kte/page.licences.txt anew from this folder. Needs Node.js, npm and its registry.
set -e
cd "$(dirname "$0")"
npm ci --no-audit --no-fund --silent
node bundle.mjs
