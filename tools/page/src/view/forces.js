// Force elements as what they are: between frames, at a frame, or on the joint whose coordinate they act on.

import { Group } from 'three';
import { add_beam } from './beams.js';
import { joint_axis } from './joints.js';
import { joint_seat } from './joint_seat.js';
import { align, part, span } from './part.js';
import { box, coil, cone, cylinder, disc, octahedron, rod, sphere, spiral, torus } from './solids.js';

const between = new Set(['spring', 'damper', 'loop', 'other']);

function distance(w, [a, b]) {
  return Math.hypot(w[7 * a] - w[7 * b], w[7 * a + 1] - w[7 * b + 1], w[7 * a + 2] - w[7 * b + 2]);
}

// Draws what acts between two frames, `side` beside the line between them so that a spring and a damper are both seen.
function add_between(mechanism, force, of, side) {
  const { materials, unit } = mechanism;
  const [a, b] = force.frames.map((f) => 7 * f);
  const make = (geometry, role) => {
    const mesh = part(geometry, materials.of(role), of);
    mechanism.add_loose('forces', mesh);
    return mesh;
  };
  const draw = {
    spring() {
      const radius = 0.55 * unit, mesh = make(coil(distance(mechanism.initial, force.frames) / radius), 'spring');
      return (...ends) => span(mesh, ...ends, radius);
    },
    damper() {
      const body = make(cylinder(), 'damper'), shaft = make(rod(), 'damper_rod');
      return (ax, ay, az, bx, by, bz) => {
        span(shaft, ax, ay, az, bx, by, bz, 0.14 * unit);
        const length = shaft.scale.z;
        span(body, ax, ay, az, bx, by, bz, 0.42 * unit);
        body.position.set(0.65 * ax + 0.35 * bx, 0.65 * ay + 0.35 * by, 0.65 * az + 0.35 * bz);
        body.scale.z = 0.42 * length;
      };
    },
    line(role) {
      const mesh = make(rod(), role), ends = [make(sphere(), role), make(sphere(), role)];
      return (ax, ay, az, bx, by, bz) => {
        span(mesh, ax, ay, az, bx, by, bz, 0.1 * unit);
        ends[0].position.set(ax, ay, az);
        ends[1].position.set(bx, by, bz);
        for (const end of ends) end.scale.setScalar(0.4 * unit);
      };
    },
  };
  const place = force.kind === 'spring' ? draw.spring() : force.kind === 'damper' ? draw.damper() : draw.line(force.kind);
  mechanism.on_update((w) => {
    const dx = w[b] - w[a], dy = w[b + 1] - w[a + 1], dz = w[b + 2] - w[a + 2];
    let ox = 0, oy = 0;
    if (side !== 0) {
      // at right angles to the line, in the x-y plane unless the line is along z
      const flat = Math.hypot(dx, dy);
      if (flat > 1e-3 * Math.abs(dz)) {
        ox = (-side * unit * dy) / flat;
        oy = (side * unit * dx) / flat;
      } else {
        ox = side * unit;
      }
    }
    place(w[a] + ox, w[a + 1] + oy, w[a + 2], w[b] + ox, w[b + 1] + oy, w[b + 2]);
  });
}

// Symbols at one frame, along z of the group.
const at_frame = {
  torsion_spring: (m, of) => [part(spiral(), m.materials.of('torsion'), of, 1.25 * m.unit)],
  bushing: (m, of) => [part(torus(), m.materials.of('bushing'), of, [1.0 * m.unit, 1.0 * m.unit, 1.8 * m.unit])],
  motor: (m, of) => {
    const can = part(cylinder(), m.materials.of('motor'), of, [0.75 * m.unit, 0.75 * m.unit, 0.9 * m.unit]);
    can.position.z = -1.1 * m.unit;
    return [can];
  },
  limit: (m, of) => [part(box(), m.materials.of('limit'), of, [0.25 * m.unit, 1.6 * m.unit, 0.5 * m.unit])],
  friction: (m, of) => [part(torus(), m.materials.of('friction'), of, 0.68 * m.unit)],
  damper: (m, of) => [part(disc(), m.materials.of('damper'), of, [0.95 * m.unit, 0.95 * m.unit, 3 * m.unit])],
  spring: (m, of) => [part(spiral(), m.materials.of('spring'), of, 1.25 * m.unit)],
  loop: (m, of) => [part(torus(), m.materials.of('loop'), of, 0.9 * m.unit)],
  contact: (m, of) => [part(cone(), m.materials.of('contact'), of, [0.6 * m.unit, 0.6 * m.unit, -0.9 * m.unit])],
  other: (m, of) => [part(octahedron(), m.materials.of('other'), of, 0.5 * m.unit)],
};

function add_at(mechanism, kind, frame, axis, of, place = [0, 0, 0]) {
  const group = new Group();
  group.position.set(...place);
  const make = Object.hasOwn(at_frame, kind) ? at_frame[kind] : at_frame.other;
  for (const mesh of make(mechanism, of)) group.add(mesh);
  mechanism.add_to_frame('forces', frame, align(group, axis));
}

export function add_forces(mechanism) {
  const { scene } = mechanism;
  const beside = new Map();  // how many are drawn between two frames already
  scene.forces.forEach((force, index) => {
    const frames = force.frames;
    const of = { kind: 'force', index, frame: frames.at(-1) ?? -1 };
    if (force.kind === 'beam' && frames.length >= 2) return add_beam(mechanism, force, of);
    if (frames.length === 2 && (between.has(force.kind) || (force.kind === 'bushing' && distance(mechanism.initial, frames) > 1e-6 * scene.size))) {
      const pair = [...frames].sort((x, y) => x - y).join();
      const n = beside.get(pair) ?? 0;
      beside.set(pair, n + 1);
      return add_between(mechanism, force, of, n === 0 ? 0 : (n % 2 ? 1 : -1) * 1.3 * Math.ceil(n / 2));
    }
    if (force.kind === 'contact' && scene.shapes.some((shape) => shape.role === 'contact' && frames.includes(shape.frame))) return undefined;
    if (frames.length > 0) {
      const up = force.kind === 'contact' ? scene.up : [0, 0, 1];
      return add_at(mechanism, force.kind, force.kind === 'contact' ? frames.at(-1) : frames[0], up, of);
    }
    // what acts on coordinates is drawn on their joints
    for (const joint of scene.joints.filter((j) => j.coordinates.some((k) => force.coordinates.includes(k)))) {
      const axis = joint_axis(joint);
      add_at(mechanism, force.kind, joint.before, axis, { ...of, frame: joint.after }, joint_seat(mechanism, joint, axis).place);
    }
    return undefined;
  });
}
