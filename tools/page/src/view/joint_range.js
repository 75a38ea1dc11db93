// Ranges of joints: an arc or a bar on the frame before the joint, with a needle or a mark at its position.

import { Group } from 'three';
import { angle_about, distance_along, near_range } from './joint_angle.js';
import { align, part } from './part.js';
import { box, cylinder, sector } from './solids.js';

const limited = (joint) => Number.isFinite(joint.lower) && Number.isFinite(joint.upper) && joint.lower <= joint.upper;

// Of a joint about an axis. Angle 0 points along the symbol's x axis; without a range only the needle is drawn.
export function add_angle_range(mechanism, joint, of, axis, seat) {
  const { materials, unit } = mechanism;
  const group = align(new Group(), axis);
  group.position.set(...seat.place);
  const outer = 1.7 * unit, inner = 0.75 * unit;
  const whole = limited(joint) && joint.kind === 'revolute';
  if (whole) {
    const upper = Math.min(joint.upper, joint.lower + 2 * Math.PI);
    group.add(part(sector(inner, outer, joint.lower, upper), materials.of('range'), of));
    for (const angle of joint.upper - joint.lower < 2 * Math.PI ? [joint.lower, joint.upper] : []) group.add(stop(angle));
  }
  function stop(angle) {
    const mesh = part(box(), materials.of('range'), of, [outer - inner, 0.08 * unit, 0.3 * unit]);
    mesh.position.set(Math.cos(angle), Math.sin(angle), 0).multiplyScalar((inner + outer) / 2);
    mesh.rotation.z = angle;
    return mesh;
  }
  const needle = part(box(), materials.of('needle'), of, [outer - 0.5 * unit, 0.13 * unit, 0.13 * unit]);
  const turning = new Group();
  needle.position.x = (outer + 0.5 * unit) / 2;
  turning.add(needle);
  group.add(turning);
  mechanism.add_to_frame('ranges', joint.before, group);
  mechanism.on_update((w) => {
    const angle = angle_about(w, joint.before, joint.after, axis) - seat.angle_zero;
    turning.rotation.z = whole ? near_range(angle, joint.lower, joint.upper) : angle;
  });
}

// Of a joint along an axis: a bar from the lower to the upper limit, or one through the whole way so far.
export function add_length_range(mechanism, joint, of, axis, seat) {
  const { materials, unit } = mechanism;
  const group = align(new Group(), axis);
  group.position.set(...seat.place);
  const bar = part(cylinder(), materials.of('range'), of);
  group.add(bar);
  const place = (low, high) => {
    bar.position.z = (low + high) / 2;
    bar.scale.set(0.35 * unit, 0.35 * unit, Math.max(high - low, 0.01 * unit));
  };
  let low = 0, high = 0;
  if (limited(joint) && joint.kind === 'prismatic') {
    place(joint.lower, joint.upper);
    for (const at of [joint.lower, joint.upper]) {
      const stop = part(cylinder(), materials.of('range'), of, [0.8 * unit, 0.8 * unit, 0.12 * unit]);
      stop.position.z = at;
      group.add(stop);
    }
    [low, high] = [joint.lower, joint.upper];
    group.userData.far = high - low > 2 * mechanism.scene.size;
  }
  const mark = part(cylinder(), materials.of('needle'), of, [0.62 * unit, 0.62 * unit, 0.16 * unit]);
  group.add(mark);
  mechanism.add_to_frame('ranges', joint.before, group);
  mechanism.on_update((w) => {
    const at = distance_along(w, joint.before, joint.after, axis) - seat.distance_zero;
    mark.position.z = at;
    if (at < low) low = at;
    if (at > high) high = at;
    place(low, high);
  });
}
