// Where a joint sits on the frame before it, and what its angle or distance counts from.

import { to_local } from '../scene/pose.js';
import { angle_about, distance_along } from './joint_angle.js';

// The value in q of a coordinate of one number of this joint, of the given kind; null if there is none.
function value_of(scene, joint, kind, q) {
  const k = joint.coordinates.find((i) => scene.coordinates[i].kind === kind && scene.coordinates[i].size === 1);
  const x = k === undefined ? undefined : q?.[scene.coordinates[k].q];
  return Number.isFinite(x) ? x : null;
}

// {place: in axes of `before`, for a distance of zero; angle_zero, distance_zero: what the poses show at q = 0}
export function joint_seat({ scene, initial, initial_q }, joint, axis) {
  const { before, after } = joint;
  const place = to_local(new Float64Array(3), initial, 7 * before, initial.subarray(7 * after, 7 * after + 3));
  const along = value_of(scene, joint, 'length', initial_q);
  if (along !== null) for (let n = 0; n < 3; ++n) place[n] -= along * axis[n];
  const turn = value_of(scene, joint, 'angle', initial_q);
  return {
    place,
    angle_zero: turn === null ? 0 : angle_about(initial, before, after, axis) - turn,
    distance_zero: along === null ? 0 : distance_along(initial, before, after, axis) - along,
  };
}
