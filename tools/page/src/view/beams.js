// Beams: a cubic through the two end frames, along the direction that each frame held the beam in at first.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage } from 'three';
import { to_local } from '../scene/pose.js';
import { part } from './part.js';

const stations = 20, sides = 8;

// A tube whose vertices follow the cubic.
function tube() {
  const geometry = new BufferGeometry();
  const vertices = (stations + 1) * sides;
  for (const name of ['position', 'normal']) {
    geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * vertices), 3).setUsage(DynamicDrawUsage));
  }
  const triangles = [];
  for (let i = 0; i < stations; ++i) {
    for (let k = 0; k < sides; ++k) {
      const a = i * sides + k, b = i * sides + ((k + 1) % sides);
      triangles.push(a, b, a + sides, b, b + sides, a + sides);
    }
  }
  geometry.setIndex(triangles);
  return geometry;
}

function rotate(out, w, i, v) {
  const q = 7 * i + 3, s = w[q], x = w[q + 1], y = w[q + 2], z = w[q + 3];
  const cx = y * v[2] - z * v[1], cy = z * v[0] - x * v[2], cz = x * v[1] - y * v[0];
  out[0] = v[0] + 2 * (s * cx + y * cz - z * cy);
  out[1] = v[1] + 2 * (s * cy + z * cx - x * cz);
  out[2] = v[2] + 2 * (s * cz + x * cy - y * cx);
}

export function add_beam(mechanism, force, of) {
  const first = force.frames[0], last = force.frames.at(-1), w0 = mechanism.initial;
  const direction = [0, 1, 2].map((n) => w0[7 * last + n] - w0[7 * first + n]);
  const inside = (i) => to_local(new Float64Array(3), w0, 7 * i, direction.map((x, n) => x + w0[7 * i + n]));
  const start = inside(first), end = inside(last);
  const mesh = part(tube(), mechanism.materials.of('beam'), of);
  mesh.frustumCulled = false;
  mechanism.add_loose('forces', mesh);

  const radius = 0.22 * mechanism.unit;
  const da = new Float64Array(3), db = new Float64Array(3), p = new Float64Array(3), d = new Float64Array(3);
  const u = new Float64Array(3), v = new Float64Array(3);
  const { position, normal } = mesh.geometry.attributes;
  mechanism.on_update((w) => {
    rotate(da, w, first, start);
    rotate(db, w, last, end);
    for (let i = 0; i <= stations; ++i) {
      const s = i / stations, s2 = s * s, s3 = s2 * s;
      for (let n = 0; n < 3; ++n) {
        const a = w[7 * first + n], b = w[7 * last + n];
        p[n] = (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * da[n] + (3 * s2 - 2 * s3) * b + (s3 - s2) * db[n];
        d[n] = 6 * (s2 - s) * (a - b) + (3 * s2 - 4 * s + 1) * da[n] + (3 * s2 - 2 * s) * db[n];
      }
      // u, v: at right angles to d
      const along_z = Math.abs(d[2]) > 0.9 * Math.hypot(d[0], d[1], d[2]);
      u[0] = along_z ? 0 : -d[1];
      u[1] = along_z ? -d[2] : d[0];
      u[2] = along_z ? d[1] : 0;
      const length = Math.hypot(u[0], u[1], u[2]) || 1;
      for (let n = 0; n < 3; ++n) u[n] /= length;
      v[0] = d[1] * u[2] - d[2] * u[1];
      v[1] = d[2] * u[0] - d[0] * u[2];
      v[2] = d[0] * u[1] - d[1] * u[0];
      const wide = Math.hypot(v[0], v[1], v[2]) || 1;
      for (let k = 0; k < sides; ++k) {
        const c = Math.cos((2 * Math.PI * k) / sides), e = Math.sin((2 * Math.PI * k) / sides) / wide;
        const x = c * u[0] + e * v[0], y = c * u[1] + e * v[1], z = c * u[2] + e * v[2];
        normal.setXYZ(i * sides + k, x, y, z);
        position.setXYZ(i * sides + k, p[0] + radius * x, p[1] + radius * y, p[2] + radius * z);
      }
    }
    position.needsUpdate = normal.needsUpdate = true;
    mesh.geometry.boundingSphere = null;
  });
}
