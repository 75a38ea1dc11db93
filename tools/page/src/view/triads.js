// Axes of frames: x red, y green, z blue.

import { Group, MeshBasicMaterial } from 'three';
import { axes } from './palette.js';
import { align, part } from './part.js';
import { cone, rod } from './solids.js';

const materials = axes.map((color) => new MeshBasicMaterial({ color }));

export function triad(unit, frame) {
  const group = new Group();
  const of = { kind: 'frame', index: frame, frame };
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, i) => {
    group.add(align(part(rod(), materials[i], of, [0.09 * unit, 0.09 * unit, 1.9 * unit]), axis));
    const tip = align(part(cone(), materials[i], of, [0.22 * unit, 0.22 * unit, 0.6 * unit]), axis);
    tip.position.set(...axis).multiplyScalar(1.8 * unit);
    group.add(tip);
  });
  for (const object of group.children) object.castShadow = false;
  return group;
}

export function add_triads(mechanism) {
  mechanism.scene.frames.forEach((_, i) => mechanism.add_to_frame('frames', i, triad(mechanism.unit, i)));
}
