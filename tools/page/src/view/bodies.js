// Bodies: the homogeneous ellipsoid of equal inertia about the centre of mass, or a small sphere for a point mass.

import { Group } from 'three';
import { opacities } from './palette.js';
import { part } from './part.js';
import { octahedron, sphere } from './solids.js';

// Inertias larger than the mechanism must not hide it.
function opacity_of(largest, size) {
  const share = Math.min(1, (0.25 * size) / largest);
  return Math.max(0.1, Math.round(20 * opacities.body * share) / 20);
}

export function add_bodies(mechanism) {
  const { scene, materials, unit } = mechanism;
  const shaped = new Set(scene.shapes.filter((shape) => shape.role !== 'collision' && shape.type !== 'plane').map((shape) => shape.frame));
  scene.bodies.forEach((body, index) => {
    const of = { kind: 'body', index, frame: body.frame };
    const group = new Group();
    group.position.set(...body.centre);
    const [w, x, y, z] = body.orientation;
    group.quaternion.set(x, y, z, w).normalize();
    const largest = Math.max(...body.ellipsoid);
    if (largest > 0) {
      const thin = Math.max(0.04 * largest, 0.12 * unit);
      group.add(part(sphere(), materials.of('body', opacity_of(largest, scene.size)), of, body.ellipsoid.map((a) => Math.max(a, thin))));
      group.add(part(octahedron(), materials.of('mass'), of, 0.22 * unit));
    } else {
      group.add(part(sphere(), materials.of('mass'), of, 0.55 * unit));
    }
    // where a shape stands for the body, or shapes would be hidden in it, its inertia is of a layer of its own
    const aside = shaped.has(body.frame) || (shaped.size > 0 && largest > 0.6 * scene.size);
    mechanism.add_to_frame(aside ? 'shaped bodies' : 'bodies', body.frame, group);
  });
}
