// Geometries of unit size that symbols share; all along z.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, CatmullRomCurve3, ConeGeometry, Curve, CylinderGeometry, OctahedronGeometry, RingGeometry,
  SphereGeometry, TorusGeometry, TubeGeometry, Vector3,
} from 'three';

const kept = new Map();
function once(name, make) {
  if (!kept.has(name)) kept.set(name, make());
  return kept.get(name);
}

export const sphere = () => once('sphere', () => new SphereGeometry(1, 32, 20));
export const box = () => once('box', () => new BoxGeometry(1, 1, 1));
export const octahedron = () => once('octahedron', () => new OctahedronGeometry(1));
// From z = -1 to 0.
export const slab = () => once('slab', () => new BoxGeometry(1, 1, 1).translate(0, 0, -0.5));
// Radius 1, from z = -1/2 to 1/2.
export const cylinder = () => once('cylinder', () => new CylinderGeometry(1, 1, 1, 28).rotateX(Math.PI / 2));
// Radius 1, from z = 0 to 1.
export const rod = () => once('rod', () => new CylinderGeometry(1, 1, 1, 14).rotateX(Math.PI / 2).translate(0, 0, 0.5));
export const cone = () => once('cone', () => new ConeGeometry(1, 1, 20).rotateX(Math.PI / 2).translate(0, 0, 0.5));
export const torus = () => once('torus', () => new TorusGeometry(1, 0.16, 10, 40));
// Three quarters of a turn about z from x, radius 1.
export const arc = () => once('arc', () => new TorusGeometry(1, 0.06, 8, 40, 1.5 * Math.PI));
export const disc = () => once('disc', () => new CylinderGeometry(1, 1, 0.06, 32).rotateX(Math.PI / 2));

// A flat ring from angle `from` to `to` about z, angles from x.
export function sector(inner, outer, from, to) {
  const segments = Math.max(3, Math.ceil((40 * (to - from)) / Math.PI));
  return new RingGeometry(inner, outer, segments, 1, from, to - from);
}

class Helix extends Curve {
  constructor(turns, lead, length) {
    super();
    this.turns = turns;
    this.lead = lead;  // share of the length that is straight at each end
    this.length = length;
  }

  getPoint(s, target = new Vector3()) {
    const u = Math.min(1, Math.max(0, (s - this.lead) / (1 - 2 * this.lead)));
    const radius = Math.min(1, s / this.lead, (1 - s) / this.lead);
    const angle = 2 * Math.PI * this.turns * u;
    return target.set(radius * Math.cos(angle), radius * Math.sin(angle), s * this.length);
  }
}

// A coil of radius 1 from z = 0 to 1 whose wire is round where its length is `slender` radii.
export const coil = (slender) => {
  const length = Math.min(60, Math.max(2, Math.round(slender)));
  const turns = Math.min(14, Math.max(4, Math.round(0.55 * length)));
  return once(`coil ${length}`, () => new TubeGeometry(new Helix(turns, 0.1, length), 36 * turns, 0.12, 7).scale(1, 1, 1 / length));
};
export const screw = () => once('screw', () => new TubeGeometry(new Helix(3, 0.02, 4), 120, 0.12, 6).scale(1, 1, 0.25).translate(0, 0, -0.5));

// A flat spiral of radius 1.
export const spiral = () => once('spiral', () => {
  const points = [];
  for (let i = 0; i <= 60; ++i) {
    const angle = (i / 60) * 5 * Math.PI, radius = 0.2 + (0.8 * i) / 60;
    points.push(new Vector3(radius * Math.cos(angle), radius * Math.sin(angle), 0));
  }
  return new TubeGeometry(new CatmullRomCurve3(points), 160, 0.06, 6);
});

// Triangles of a mesh: float32 positions and uint32 indices. Without normals: files' meshes have sharp edges.
export function triangles(positions, indices) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  return geometry;
}
