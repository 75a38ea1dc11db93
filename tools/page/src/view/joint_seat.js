// Where a joint sits on the frame before it, and what its angle or distance counts from.

import { to_local } from '../scene/pose.js';
import { angle_about, distance_along } from './joint_angle.js';

// The first value of a coordinate of one number of this joint, of the given kind; null if there is none.
function first_value(scene, joint, kind) {
  const k = joint.coordinates.find((i) => scene.coordinates[i].kind === kind && scene.coordinates[i].size === 1);
  const q = k === undefined ? undefined : scene.state.q[scene.coordinates[k].q];
  return Number.isFinite(q) ? q : null;
}

// {place: in axes of `before`, for a distance of zero; angle_zero, distance_zero: what the poses show at q = 0}
export function joint_seat(scene, joint, axis, initial) {
  const { before, after } = joint;
  const place = to_local(new Float64Array(3), initial, 7 * before, initial.subarray(7 * after, 7 * after + 3));
  const along = first_value(scene, joint, 'length');
  if (along !== null) for (let n = 0; n < 3; ++n) place[n] -= along * axis[n];
  const turn = first_value(scene, joint, 'angle');
  return {
    place,
    angle_zero: turn === null ? 0 : angle_about(initial, before, after, axis) - turn,
    distance_zero: along === null ? 0 : distance_along(initial, before, after, axis) - along,
  };
}
