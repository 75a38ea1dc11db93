// The space that the mechanism takes while it moves, as points on what hangs on its frames.

import { Box3, Matrix4, Quaternion, Sphere, Vector3 } from 'three';

// What moves farther away, in diameters of the mechanism, would make a dot of it, and is left out.
const farthest_away = 100;

const most_numbers = 1e6;  // of points, by which the number of rows looked at is chosen

const directions = [];
for (const x of [-1, 0, 1]) for (const y of [-1, 0, 1]) for (const z of [-1, 0, 1]) if (x || y || z) directions.push([x, y, z]);

// Of points x y z ... those that reach farthest in 26 directions: of a box its corners.
function outermost(points) {
  const reach = directions.map(() => -Infinity), found = directions.map(() => 0);
  for (let i = 0; i + 2 < points.length; i += 3) {
    for (let k = 0; k < directions.length; ++k) {
      const [x, y, z] = directions[k], at = x * points[i] + y * points[i + 1] + z * points[i + 2];
      if (at > reach[k]) {
        reach[k] = at;
        found[k] = i;
      }
    }
  }
  return [...new Set(found)].flatMap((i) => [points[i], points[i + 1], points[i + 2]]);
}

const kept = new WeakMap();  // geometry: its outermost vertices
function outermost_of(geometry) {
  if (!kept.has(geometry)) kept.set(geometry, outermost(geometry.attributes.position.array));
  return kept.get(geometry);
}

function is_shown(object, root) {
  for (let o = object; o !== root; o = o.parent) if (!o.visible) return false;
  return true;
}

// Not axes, planes, long ranges of joints, and inertias larger than the mechanism.
function counts(scene, { kind, index }) {
  if (kind === 'shape') return scene.shapes[index].type !== 'plane';
  if (kind === 'body') return Math.max(...scene.bodies[index].ellipsoid) < 0.6 * scene.size;
  return kind !== 'frame';
}

// Of each frame the outermost points of what is shown on it, in its axes.
function points_of_frames(mechanism) {
  const all = new Map(), inverse = new Matrix4(), relative = new Matrix4(), p = new Vector3();
  const { scene, unit } = mechanism;
  mechanism.root.updateMatrixWorld(true);
  for (const [frame, node] of mechanism.nodes) {
    inverse.copy(node.matrixWorld).invert();
    const points = [];
    node.traverse((object) => {
      if (!object.isMesh || object.parent.userData.far || !counts(scene, object.userData) || !is_shown(object, node)) return;
      relative.multiplyMatrices(inverse, object.matrixWorld);
      const vertices = outermost_of(object.geometry);
      for (let i = 0; i < vertices.length; i += 3) points.push(...p.fromArray(vertices, i).applyMatrix4(relative));
    });
    if (points.length > 0) all.set(frame, outermost(points));
  }
  const ends = [...scene.links.flatMap(({ from, to }) => [from, to]), ...scene.forces.flatMap(({ frames }) => frames)];
  const needed = all.size || ends.length ? ends : scene.frames.map((_, i) => i);
  const small = [-0.5, 0.5].flatMap((x) => [x, 0, 0, 0, x, 0, 0, 0, x]).map((x) => x * unit);
  for (const frame of needed) if (!all.has(frame)) all.set(frame, small);
  return all;
}

function add_points(to, frames, world) {
  const p = new Vector3(), rotation = new Quaternion();
  for (const [frame, points] of frames) {
    const i = 7 * frame;
    rotation.set(world[i + 4], world[i + 5], world[i + 6], world[i + 3]);
    for (let k = 0; k < points.length; k += 3) {
      p.fromArray(points, k).applyQuaternion(rotation);
      to.push(p.x + world[i], p.y + world[i + 1], p.z + world[i + 2]);
    }
  }
}

// {points: x y z ..., box, sphere} of the motion; `visit(times, use)` calls use(world poses) at about so many times.
export function motion_bounds(mechanism, visit) {
  const frames = points_of_frames(mechanism);
  const all = [];
  add_points(all, frames, mechanism.initial);
  const near = new Box3().setFromArray(all);
  if (near.isEmpty()) near.setFromCenterAndSize(new Vector3(), new Vector3(1, 1, 1).multiplyScalar(mechanism.scene.size));
  near.expandByScalar(farthest_away * near.getSize(new Vector3()).length());
  visit(Math.max(100, Math.round(most_numbers / all.length)), (world) => add_points(all, frames, world));
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
