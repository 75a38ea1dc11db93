// What is drawn and what is not.

import { palettes } from '../view/palette.js';
import { by_id, element } from './element.js';

const all = [
  ['visual', 'Shapes of the file', (scene) => scene.shapes.some((s) => s.role !== 'collision')],
  ['collision', 'Collision shapes', (scene) => scene.shapes.some((s) => s.role === 'collision')],
  ['links', 'Links', (scene) => scene.links.length > 0],
  ['joints', 'Joints', (scene) => scene.joints.length > 0],
  ['ranges', 'Ranges and positions of joints', (scene) => scene.joints.length > 0],
  ['bodies', 'Bodies by their inertia', (scene) => scene.bodies.length > 0],
  ['forces', 'Springs, dampers, beams, contacts', (scene) => scene.forces.length > 0],
  ['frames', 'Axes of all frames', (scene) => scene.frames.length > 0],
  ['labels', 'Names of frames', (scene) => scene.frames.length > 0],
];

// Shown at first: inertias are in the way of the shapes that stand for the same bodies.
export function shown_at_first(scene) {
  const shaped = new Set(scene.shapes.filter((s) => s.role !== 'collision' && s.type !== 'plane').map((s) => s.frame));
  const hides = scene.bodies.length > 0 && scene.bodies.filter((b) => shaped.has(b.frame)).length > scene.bodies.length / 2;
  return { visual: true, collision: false, links: true, joints: true, ranges: true, bodies: !hides, forces: true, frames: false, labels: false };
}

export function fill_layers(scene, shown, change) {
  for (const [name, text, exists] of all) {
    if (!exists(scene)) continue;
    const box = element('input', { type: 'checkbox', id: `layer-${name}`, checked: shown[name] });
    box.addEventListener('change', () => change(name, box.checked));
    by_id('layers').append(element('label', { class: 'check' }, box, element('span', { text })));
  }
}

const kinds = [
  ['joint', 'joint', 'joints'], ['needle', 'position of a joint', 'joints'], ['link', 'link', 'links'], ['body', 'inertia of a body', 'bodies'],
  ['mass', 'point mass, centre of mass', 'bodies'], ['spring', 'spring'], ['torsion', 'torsion spring', null, 'torsion_spring'], ['damper', 'damper'], ['beam', 'beam'],
  ['bushing', 'bushing'], ['motor', 'motor'], ['limit', 'limit'], ['friction', 'friction'], ['loop', 'loop'], ['contact', 'contact'], ['other', 'other force'],
];

const css = (colour) => `#${colour.toString(16).padStart(6, '0')}`;

export function fill_legend(scene, theme) {
  const legend = by_id('legend');
  const rows = kinds
    .filter(([role, , list, kind = role]) => (list ? scene[list].length > 0 : scene.forces.some((force) => force.kind === kind)))
    .map(([role, text]) => {
      const swatch = element('span', { class: 'swatch' });
      swatch.style.background = css(palettes[theme][role]);
      return element('div', { class: 'check' }, swatch, element('span', { text }));
    });
  legend.replaceChildren(legend.firstElementChild, ...rows);
  legend.hidden = rows.length === 0;
}
