// Where a joint of one axis stands, from the poses of its two frames alone.

import { to_local } from '../scene/pose.js';

// Angle of `after` about the axis of `before`, -pi to pi.
export function angle_about(w, before, after, axis) {
  const a = 7 * before + 3, b = 7 * after + 3;
  // vector and scalar part of conj(q_before) q_after
  const aw = w[a], ax = -w[a + 1], ay = -w[a + 2], az = -w[a + 3];
  const bw = w[b], bx = w[b + 1], by = w[b + 2], bz = w[b + 3];
  const scalar = aw * bw - ax * bx - ay * by - az * bz;
  const x = aw * bx + ax * bw + ay * bz - az * by;
  const y = aw * by - ax * bz + ay * bw + az * bx;
  const z = aw * bz + ax * by - ay * bx + az * bw;
  const angle = 2 * Math.atan2(x * axis[0] + y * axis[1] + z * axis[2], scalar);
  return angle > Math.PI ? angle - 2 * Math.PI : angle < -Math.PI ? angle + 2 * Math.PI : angle;
}

// An angle by whole turns as near to the range as it gets.
export function near_range(angle, lower, upper) {
  const middle = (lower + upper) / 2;
  return angle + 2 * Math.PI * Math.round((middle - angle) / (2 * Math.PI));
}

const local = new Float64Array(3);

// Distance of `after` along the axis of `before`.
export function distance_along(w, before, after, axis) {
  const p = 7 * after;
  local[0] = w[p];
  local[1] = w[p + 1];
  local[2] = w[p + 2];
  to_local(local, w, 7 * before, local);
  return local[0] * axis[0] + local[1] * axis[1] + local[2] * axis[2];
}
