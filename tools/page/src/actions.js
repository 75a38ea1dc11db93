// What keys, buttons and the pointer do.

import { by_id, element } from './ui/element.js';
import { listen_to_keys } from './ui/keys.js';
import { Pointer } from './ui/pointer.js';

export function listen(viewer) {
  const { picture, tabs, theme, transport, player } = viewer;
  const camera = (act) => (...args) => {
    if (picture) act(picture.stage.camera, ...args);
    viewer.request();
  };
  const fit = () => {
    picture?.fit();
    viewer.request();
  };
  const help = () => by_id('help-dialog').showModal();
  const search = () => {
    if (tabs.narrow.matches) tabs.open('tree');
    else if (document.body.classList.contains('no-tree')) by_id('toggle-frames').click();
    by_id('search').focus();
  };
  by_id('fit').addEventListener('click', fit);
  by_id('theme').addEventListener('click', () => theme.toggle());
  by_id('help').addEventListener('click', help);
  for (const [id, name] of [['toggle-frames', 'no-tree'], ['toggle-side', 'no-side']]) {
    by_id(id).addEventListener('click', () => by_id(id).setAttribute('aria-pressed', String(!document.body.classList.toggle(name))));
  }
  listen_to_keys({
    play: () => viewer.play(), loop: () => transport.toggle_loop(), faster: (n) => transport.change_speed(n),
    step: (n) => viewer.scrub(viewer.sources.step(player.time, n)), share: (x) => viewer.scrub(player.time + x * player.length),
    first: () => viewer.scrub(player.start), last: () => viewer.scrub(player.end),
    orbit: camera((c, left, up) => c.orbit(left, up)), zoom: camera((c, factor) => c.zoom(factor)),
    fit, help, search, theme: () => theme.toggle(), forces: () => viewer.acting.show(!viewer.acting.on),
  });
  if (!picture) return;
  listen_to_pointer(viewer);
  fill_views(viewer);
}

// From the front, the side, above; and a file of what is drawn.
function fill_views(viewer) {
  const { picture, scene } = viewer;
  const sides = scene.planar ? [['All']] : [['All'], ['Front', [0, 1, 0]], ['Side', [1, 0, 0]], ['Top', [0, 1e-4, 1]]];
  const box = by_id('views').querySelector('.buttons');
  for (const [text, from] of sides) {
    box.append(element('button', { type: 'button', text, onclick: () => { picture.fit(from); viewer.request(); } }));
  }
  box.append(element('button', { type: 'button', text: 'Save picture', title: 'A PNG file of what is drawn', onclick: () => picture.save(String(scene.title ?? '')) }));
}

// Rows of the tree are frames, joints and bodies; all else belongs to its frame.
const row_of = ({ kind, index, frame }) => (kind === 'joint' || kind === 'body' ? { kind, index } : { kind: 'frame', index: frame });

function listen_to_pointer(viewer) {
  const { picture, tree, simulating, acting } = viewer;
  const load_of = (hit) => (hit?.object.userData.kind === 'load' ? acting.item_of(hit.object.userData.index) : null);
  // arrows are over all else
  const pick = (event) => (acting.on && picture.stage.pick(event, acting.arrows.root)) || picture.pick(event);
  viewer.pointer = new Pointer(by_id('canvas'), pick, {
    hover(hit) {
      const load = load_of(hit);
      if (acting.pointed !== load) acting.point(load);
      const of = hit && !load ? { ...hit.object.userData } : null;
      tree.point(of && row_of(of));
      viewer.point_at(of);
    },
    choose(hit) {
      const load = load_of(hit);
      if (acting.pointed !== load) acting.point(load);
      if (hit && !load) tree.choose_item(row_of(hit.object.userData));
    },
    follow: (hit) => viewer.follow(hit ? hit.object.userData.frame : -1),
    pulls: () => simulating.running,
    body: (event) => picture.pick(event),
    grab: (hit) => simulating.attempt(() => simulating.pull.grab(hit)) ?? false,
    move: (event) => simulating.attempt(() => simulating.pull.move(event)),
    release: () => simulating.attempt(() => simulating.pull.release()),
  });
}
