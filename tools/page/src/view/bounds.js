// The space that the mechanism takes, at rest and while it moves.

import { Box3, Sphere, Vector3 } from 'three';

// How far what hangs on each frame reaches from its origin.
function reaches(mechanism) {
  const reach = new Map();
  const box = new Box3(), corner = new Vector3(), origin = new Vector3();
  mechanism.root.updateMatrixWorld(true);
  for (const [frame, node] of mechanism.nodes) {
    origin.setFromMatrixPosition(node.matrixWorld);
    let farthest = 0;
    node.traverse((object) => {
      if (!object.isMesh || object.userData.kind === 'frame') return;
      const shape = object.userData.kind === 'shape' ? mechanism.scene.shapes[object.userData.index] : null;
      if (shape && (shape.type === 'plane' || shape.role === 'collision')) return;
      box.setFromObject(object);
      if (box.isEmpty()) return;
      corner.set(Math.max(box.max.x - origin.x, origin.x - box.min.x), Math.max(box.max.y - origin.y, origin.y - box.min.y),
        Math.max(box.max.z - origin.z, origin.z - box.min.z));
      farthest = Math.max(farthest, Math.min(corner.length(), 20 * mechanism.scene.size));
    });
    reach.set(frame, farthest);
  }
  return reach;
}

// Frames that carry something to see, or all where none does.
function seen_frames(scene) {
  const seen = new Set();
  for (const { from, to } of scene.links) seen.add(from).add(to);
  for (const { before, after } of scene.joints) seen.add(before).add(after);
  for (const { frame } of scene.bodies) seen.add(frame);
  for (const { frame, type } of scene.shapes) if (type !== 'plane') seen.add(frame);
  for (const { frames } of scene.forces) for (const frame of frames) seen.add(frame);
  return seen.size ? [...seen] : scene.frames.map((_, i) => i);
}

function box_of(mechanism, frames, reach, world, box) {
  const low = new Vector3(), high = new Vector3();
  for (const frame of frames) {
    const r = reach.get(frame) ?? 0;
    low.set(world[7 * frame] - r, world[7 * frame + 1] - r, world[7 * frame + 2] - r);
    high.set(world[7 * frame] + r, world[7 * frame + 1] + r, world[7 * frame + 2] + r);
    box.expandByPoint(low).expandByPoint(high);
  }
  return box;
}

// {box, sphere} of the motion; `visit(use)` calls use(world poses) at some times. Motion far away counts up to 3 diameters.
export function motion_bounds(mechanism, visit) {
  const frames = seen_frames(mechanism.scene), reach = reaches(mechanism);
  const first = box_of(mechanism, frames, reach, mechanism.initial, new Box3());
  if (first.isEmpty()) first.setFromCenterAndSize(new Vector3(), new Vector3(1, 1, 1).multiplyScalar(mechanism.scene.size));
  const whole = first.clone();
  visit((world) => box_of(mechanism, frames, reach, world, whole));
  const margin = 3 * Math.max(first.getSize(new Vector3()).length(), 0.1 * mechanism.scene.size);
  whole.intersect(first.clone().expandByScalar(margin));
  return { box: whole, sphere: whole.getBoundingSphere(new Sphere()) };
}
