// Puts the viewer, three.js, uPlot and the engine into one page: share/kte/page.html.

import { build } from 'esbuild';
import { createHash } from 'node:crypto';
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

const here = new URL('./', import.meta.url);
const share = new URL('../../share/kte/', here);
const read = (path) => readFileSync(new URL(path, here), 'utf8');

const bundled = await build({
  entryPoints: [new URL('src/main.js', here).pathname],
  outdir: 'out',
  bundle: true,
  write: false,
  minify: true,
  format: 'iife',
  target: ['chrome90', 'firefox113', 'safari16'],
  legalComments: 'none',
  logLevel: 'warning',
});
const output = (ending) => bundled.outputFiles.find((file) => file.path.endsWith(ending)).text;

const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString('base64');

const version = (name) => JSON.parse(read(`node_modules/${name}/package.json`)).version;
const licences = [
  `kte ${read('../../CMakeLists.txt').match(/project\(kte VERSION ([\d.]+)/)[1]}\n\n${read('../../LICENSE').trim()}\n`,
  ...['three', 'uplot'].map((name) => `${name} ${version(name)} (npm)\n\n${read(`node_modules/${name}/LICENSE`).trim()}\n`),
  read('licences/engine.txt'),
].join(`\n${'-'.repeat(80)}\n\n`);

const escaped = (text) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');
const style = (await build({ stdin: { contents: output('.css') + read('style.css'), loader: 'css' }, minify: true, write: false })).outputFiles[0].text;

// A sum of all that the page is made of, which tests/page compares.
const made_of = ['src', 'licences'].flatMap((folder) => readdirSync(new URL(folder, here), { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile()).map((entry) => `${entry.parentPath ?? entry.path}/${entry.name}`.slice(here.pathname.length)))
  .concat('page.html', 'style.css', 'bundle.mjs', 'package-lock.json', 'engine/engine.js', 'engine/kte.wasm').sort();
const sum = createHash('sha256');
for (const path of made_of) sum.update(`${path}\n`).update(readFileSync(new URL(path, here)));

const parts = {
  '<!--SOURCES-->': sum.digest('hex'),
  '/*STYLE*/': style.trim(),
  '<!--LICENCES-->': escaped(licences),
  '<!--CODE-->': packed(output('.js')),
  '<!--ENGINE-->': packed(readFileSync(new URL('engine/kte.wasm', here))),
};
let page = read('page.html');
for (const [place, text] of Object.entries(parts)) {
  if (page.split(place).length !== 2) throw new Error(`page.html: ${place} is not there once`);
  page = page.replace(place, () => text);
}

mkdirSync(share, { recursive: true });
writeFileSync(new URL('page.html', share), page);
writeFileSync(new URL('page.licences.txt', share), licences);
const kilobytes = (n) => `${Math.round(n / 1000)} kB`;
console.log(`share/kte/page.html: ${kilobytes(page.length)}, of which the engine ${kilobytes(parts['<!--ENGINE-->'].length)}`);
