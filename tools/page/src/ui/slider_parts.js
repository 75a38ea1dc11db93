// The sliders of a coordinate: what each shows of q, and what it writes there.

import { Euler, Quaternion } from 'three';

const quaternion = new Quaternion(), euler = new Euler();

function range_of({ lower, upper }, half) {
  const low = Number.isFinite(lower), high = Number.isFinite(upper);
  if (low && high && lower < upper) return [lower, upper];
  if (low) return [lower, lower + 2 * half];
  if (high) return [upper - 2 * half, upper];
  return [-half, half];
}

const plain = (name, unit, at, range) => ({
  name, unit, range,
  read: (q) => q[at],
  write: (q, x) => { q[at] = x; },
});

// Turns about x, y, z of the quaternion w x y z at q[at].
function turns(name, at) {
  return ['x', 'y', 'z'].map((axis) => ({
    name: `${name}, turn about ${axis}`, unit: 'rad',
    range: axis === 'y' ? [-Math.PI / 2, Math.PI / 2] : [-Math.PI, Math.PI],
    read(q) {
      euler.setFromQuaternion(quaternion.set(q[at + 1], q[at + 2], q[at + 3], q[at]).normalize(), 'XYZ');
      return euler[axis];
    },
    write(q, x) {
      this.read(q);
      euler[axis] = x;
      quaternion.setFromEuler(euler);
      [q[at], q[at + 1], q[at + 2], q[at + 3]] = [quaternion.w, quaternion.x, quaternion.y, quaternion.z];
    },
  }));
}

export function slider_parts(coordinate, size) {
  const { name, kind, q, unit } = coordinate;
  const along = (axis, k) => plain(`${name}/${axis}`, 'm', q + k, [-2 * size, 2 * size]);
  if (kind === 'rotation' && coordinate.size === 4) return turns(name, q);
  if (kind === 'pose' && coordinate.size === 7) return [along('x', 0), along('y', 1), along('z', 2), ...turns(name, q + 3)];
  if (kind === 'pose_2D' && coordinate.size === 3) return [along('x', 0), along('y', 1), plain(`${name}/angle`, 'rad', q + 2, [-Math.PI, Math.PI])];
  const half = kind === 'angle' ? Math.PI : kind === 'length' ? size : 1;
  if (coordinate.size === 1) return [plain(name, unit, q, range_of(coordinate, half))];
  return Array.from({ length: coordinate.size }, (_, k) => plain(`${name}/${k}`, unit, q + k, [-half, half]));
}
