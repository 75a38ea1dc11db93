// What is drawn and what is not.

import { palettes } from '../view/palette.js';
import { layer_of } from '../view/shapes.js';
import { by_id, element } from './element.js';

const all = [
  ['visual', 'Shapes of the file', (scene) => scene.shapes.some((s) => layer_of(s) === 'visual')],
  ['collision', 'Collision shapes', (scene) => scene.shapes.some((s) => s.role === 'collision')],
  ['links', 'Links', (scene) => scene.links.length > 0],
  ['joints', 'Joints', (scene) => scene.joints.length > 0],
  ['ranges', 'Ranges and positions of joints', (scene) => scene.joints.length > 0],
  ['bodies', 'Bodies by their inertia', (scene) => scene.bodies.length > 0],
  ['shaped bodies', 'Inertia of bodies with shapes, and large ones', (scene) => scene.bodies.length > 0 && scene.shapes.some((s) => layer_of(s) === 'visual')],
  ['forces', 'Springs, dampers, beams, contacts', (scene) => scene.forces.length > 0],
  ['frames', 'Axes of all frames', (scene) => scene.frames.length > 0],
  ['labels', 'Names of frames', (scene) => scene.frames.length > 0],
];

// Shown at first.
export const shown_at_first = {
  visual: true, collision: false, links: true, joints: true, ranges: true, bodies: true, 'shaped bodies': false, forces: true, frames: false, labels: false,
};

export function fill_layers(scene, shown, change) {
  for (const [name, text, exists] of all) {
    if (!exists(scene)) continue;
    const box = element('input', { type: 'checkbox', id: `layer-${name.replace(' ', '-')}`, checked: shown[name] });
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
