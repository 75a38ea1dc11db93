// Joints by kind and axis, each on the frame before it.

import { Group } from 'three';
import { add_angle_range, add_length_range } from './joint_range.js';
import { joint_seat } from './joint_seat.js';
import { align, part } from './part.js';
import { box, cylinder, octahedron, screw, sphere, torus } from './solids.js';

const barrel = (m, of, axis, radius, length) =>
  align(part(cylinder(), m.materials.of('joint'), of, [radius * m.unit, radius * m.unit, length * m.unit]), axis);

// An axis at right angles to another.
export function perpendicular([x, y, z]) {
  const [a, b, c] = Math.abs(z) > 0.9 ? [1, 0, 0] : [0, 0, 1];
  const p = [y * c - z * b, z * a - x * c, x * b - y * a];
  const length = Math.hypot(...p);
  return p.map((v) => v / length);
}

const symbols = {
  revolute(m, of, axis, group) {
    group.add(barrel(m, of, axis, 0.55, 1.5));
    const pin = part(cylinder(), m.materials.of('joint_dark'), of, [0.24 * m.unit, 0.24 * m.unit, 1.9 * m.unit]);
    group.add(align(pin, axis));
  },
  prismatic(m, of, axis, group) {
    group.add(align(part(box(), m.materials.of('joint'), of, [1.0 * m.unit, 1.0 * m.unit, 1.5 * m.unit]), axis));
  },
  screw(m, of, axis, group) {
    group.add(barrel(m, of, axis, 0.4, 2.0));
    group.add(align(part(screw(), m.materials.of('joint_dark'), of, [0.48 * m.unit, 0.48 * m.unit, 2.0 * m.unit]), axis));
  },
  cylindrical(m, of, axis, group) {
    group.add(barrel(m, of, axis, 0.5, 1.3));
    group.add(barrel(m, of, axis, 0.22, 3.0));
  },
  universal(m, of, axis, group) {
    group.add(barrel(m, of, axis, 0.32, 1.9));
    group.add(barrel(m, of, perpendicular(axis), 0.32, 1.9));
  },
  spherical(m, of, axis, group) {
    group.add(part(sphere(), m.materials.of('joint'), of, 0.7 * m.unit));
    group.add(align(part(torus(), m.materials.of('joint_dark'), of, 0.72 * m.unit), axis));
  },
  planar(m, of, axis, group) {
    group.add(align(part(box(), m.materials.of('joint'), of, [2.4 * m.unit, 2.4 * m.unit, 0.12 * m.unit]), axis));
  },
  free(m, of, axis, group) {
    group.add(part(octahedron(), m.materials.of('joint'), of, 0.5 * m.unit));
  },
  fixed(m, of, axis, group) {
    group.add(part(box(), m.materials.of('fixed'), of, 0.6 * m.unit));
  },
  other(m, of, axis, group) {
    group.add(part(octahedron(), m.materials.of('joint'), of, 0.75 * m.unit));
  },
};

// The joint's axis, of length 1; z where it has none.
export function joint_axis({ axis }) {
  const length = axis ? Math.hypot(...axis) : 0;
  return length > 0 ? axis.map((v) => v / length) : [0, 0, 1];
}

export function add_joints(mechanism) {
  const { scene } = mechanism;
  scene.joints.forEach((joint, index) => {
    const of = { kind: 'joint', index, frame: joint.after };
    const axis = joint_axis(joint);
    const group = new Group();
    const kind = Object.hasOwn(symbols, joint.kind) ? joint.kind : 'other';
    symbols[kind](mechanism, of, axis, group);
    if (kind === 'free') return mechanism.add_to_frame('joints', joint.after, group);
    const seat = joint_seat(mechanism, joint, axis);
    group.position.set(...seat.place);
    mechanism.add_to_frame('joints', joint.before, group);
    if (kind === 'revolute' || kind === 'screw' || kind === 'cylindrical') add_angle_range(mechanism, joint, of, axis, seat);
    if (kind === 'prismatic' || kind === 'cylindrical') add_length_range(mechanism, joint, of, axis, seat);
    return undefined;
  });
}
