// Begins: reads the scene of the page and shows it, or says why not.

import 'uplot/dist/uPlot.min.css';
import { LiveViewer } from './live.js';
import { read_scene } from './scene/read_scene.js';
import { by_id } from './ui/element.js';
import { Loading } from './ui/loading.js';
import { Theme } from './ui/theme.js';
import { read_meshes } from './view/read_meshes.js';
import { Viewer } from './viewer.js';

function say(text) {
  by_id('message').textContent = text;
  by_id('message').hidden = false;
}

async function begin(loading) {
  await loading.say('Reading the scene');
  const scene = read_scene(by_id('kte-scene').textContent);
  if (scene === null) {
    loading.end();
    document.body.classList.add('no-scene');
    const theme = new Theme(() => {});
    by_id('theme').addEventListener('click', () => theme.toggle());
    by_id('help').addEventListener('click', () => by_id('help-dialog').showModal());
    say('There is no mechanism in this page. kte::write_page and "kte view" put one into a copy of it.');
    return;
  }
  await read_meshes(scene.meshes, (done, all) => loading.say(`${done} of ${all} meshes read`));
  await loading.say('Drawing', true);
  window.kte_page = new (by_id('kte-live') ? LiveViewer : Viewer)(scene, say, () => loading.end());
}

const loading = new Loading();
begin(loading).catch((error) => {
  loading.end();
  say(`kte: the scene of this page cannot be shown: ${error.message}`);
});
