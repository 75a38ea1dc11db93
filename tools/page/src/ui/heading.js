// Title, numbers and notes of a scene.

import { counted, number, shown } from '../text.js';
import { by_id, element } from './element.js';

export function fill_heading(scene) {
  const title = shown(scene.title ?? '', 200);
  document.title = `${title} \u2013 kte`;
  by_id('title').textContent = title;
  by_id('title').title = title;
  const mass = scene.bodies.reduce((sum, body) => sum + (body.mass ?? 0), 0);
  const facts = [];
  if (scene.joints.length) facts.push(counted(scene.joints.length, 'joint'));
  if (scene.bodies.length) facts.push(counted(scene.bodies.length, 'body', 'bodies'), `${number(mass)} kg`);
  if (scene.frames.length) facts.push(counted(scene.frames.length, 'frame'));
  by_id('summary').textContent = facts.join(' \u00b7 ');
  const view = scene.planar ? 'View of the plane' : '3D view';
  by_id('canvas').setAttribute('aria-label', `${view} of ${title}. W, A, S, D ${scene.planar ? 'move' : 'turn'} it, plus and minus zoom, F shows all.`);
}

// What is not drawn.
export function fill_notes(notes) {
  const said = notes.length ? notes : ['All that the scene has is drawn.'];
  by_id('notes').replaceChildren(...said.map((note) => element('li', { class: 'name', text: shown(note, 1000) })));
  if (notes.length) by_id('tab-notes').textContent = `Notes (${notes.length})`;
}
