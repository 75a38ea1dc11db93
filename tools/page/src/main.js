// Begins: reads the scene of the page and shows it, or says why not.

import 'uplot/dist/uPlot.min.css';
import { LiveViewer } from './live.js';
import { read_scene } from './scene/read_scene.js';
import { by_id } from './ui/element.js';
import { Theme } from './ui/theme.js';
import { Viewer } from './viewer.js';

function say(text) {
  by_id('message').textContent = text;
  by_id('message').hidden = false;
}

function begin() {
  const scene = read_scene(by_id('kte-scene').textContent);
  if (scene === null) {
    document.body.classList.add('no-scene');
    const theme = new Theme(() => {});
    by_id('theme').addEventListener('click', () => theme.toggle());
    by_id('help').addEventListener('click', () => by_id('help-dialog').showModal());
    say('There is no mechanism in this page. kte::write_page and "kte view" put one into a copy of it.');
    return;
  }
  window.kte_page = by_id('kte-live') ? new LiveViewer(scene, say) : new Viewer(scene, say);
}

try {
  begin();
} catch (error) {
  say(`kte: the scene of this page cannot be shown: ${error.message}`);
}
