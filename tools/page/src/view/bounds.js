// The space that the mechanism takes while it moves, as points on the boxes of what hangs on its frames.

import { Box3, Matrix4, Quaternion, Sphere, Vector3 } from 'three';

// Not axes, planes, long ranges of joints, collision shapes, and inertias larger than the mechanism.
function counts(scene, { kind, index }) {
  if (kind === 'shape') return scene.shapes[index].type !== 'plane' && scene.shapes[index].role !== 'collision';
  if (kind === 'body') return Math.max(...scene.bodies[index].ellipsoid) < 0.6 * scene.size;
  return kind !== 'frame';
}

// Of each frame the box of what hangs on it, in its axes.
function local_boxes(mechanism) {
  const boxes = new Map(), inverse = new Matrix4(), relative = new Matrix4(), box = new Box3();
  const { scene, unit } = mechanism;
  mechanism.root.updateMatrixWorld(true);
  for (const [frame, node] of mechanism.nodes) {
    inverse.copy(node.matrixWorld).invert();
    const whole = new Box3();
    node.traverse((object) => {
      if (!object.isMesh || object.parent.userData.far || !counts(scene, object.userData)) return;
      if (!object.geometry.boundingBox) object.geometry.computeBoundingBox();
      box.copy(object.geometry.boundingBox).applyMatrix4(relative.multiplyMatrices(inverse, object.matrixWorld));
      whole.union(box);
    });
    if (!whole.isEmpty()) boxes.set(frame, whole);
  }
  const ends = [...scene.links.flatMap(({ from, to }) => [from, to]), ...scene.forces.flatMap(({ frames }) => frames)];
  const needed = boxes.size || ends.length ? ends : scene.frames.map((_, i) => i);
  const small = new Vector3(unit, unit, unit);
  for (const frame of needed) if (!boxes.has(frame)) boxes.set(frame, new Box3().setFromCenterAndSize(new Vector3(), small));
  return boxes;
}

// Middles of the sides of a box, and points towards its corners: of what is round, corners are far off.
const directions = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
for (let k = 0; k < 8; ++k) directions.push([k & 1 ? 0.8 : -0.8, k & 2 ? 0.8 : -0.8, k & 4 ? 0.8 : -0.8]);

function add_points(points, boxes, world) {
  const p = new Vector3(), centre = new Vector3(), half = new Vector3(), rotation = new Quaternion();
  for (const [frame, box] of boxes) {
    const i = 7 * frame;
    rotation.set(world[i + 4], world[i + 5], world[i + 6], world[i + 3]);
    box.getCenter(centre);
    box.getSize(half).multiplyScalar(0.5);
    for (const [x, y, z] of directions) {
      p.set(x, y, z).multiply(half).add(centre).applyQuaternion(rotation);
      points.push(p.x + world[i], p.y + world[i + 1], p.z + world[i + 2]);
    }
  }
}

// {points: x y z ..., box, sphere} of the motion; `visit(use)` calls use(world poses) at some times. What moves farther away
// than three diameters of the mechanism is left out.
export function motion_bounds(mechanism, visit) {
  const boxes = local_boxes(mechanism);
  const first = [];
  add_points(first, boxes, mechanism.initial);
  const near = new Box3().setFromArray(first);
  if (near.isEmpty()) near.setFromCenterAndSize(new Vector3(), new Vector3(1, 1, 1).multiplyScalar(mechanism.scene.size));
  near.expandByScalar(3 * near.getSize(new Vector3()).length());
  const all = [...first];
  visit((world) => add_points(all, boxes, world));
  const points = [], p = new Vector3();
  for (let i = 0; i < all.length; i += 3) if (near.containsPoint(p.fromArray(all, i))) points.push(p.x, p.y, p.z);
  const box = new Box3().setFromArray(points);
  if (box.isEmpty()) box.setFromCenterAndSize(new Vector3(), new Vector3(1, 1, 1).multiplyScalar(mechanism.scene.size));
  return { points, box, sphere: box.getBoundingSphere(new Sphere()) };
}

// The lowest and highest of points along a direction; those of the box where there are none.
export function extent_along({ points, box }, direction) {
  let low = Infinity, high = -Infinity;
  const take = (x, y, z) => {
    const at = direction.x * x + direction.y * y + direction.z * z;
    low = Math.min(low, at);
    high = Math.max(high, at);
  };
  for (let i = 0; i < points.length; i += 3) take(points[i], points[i + 1], points[i + 2]);
  if (points.length === 0) for (const corner of [box.min, box.max]) take(corner.x, corner.y, corner.z);
  return [low, high];
}
