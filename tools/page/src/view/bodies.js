// Bodies: the homogeneous ellipsoid of equal inertia about the centre of mass, or a small sphere for a point mass.

import { Group, Vector3 } from 'three';
import { FramePoses } from '../scene/frame_poses.js';
import { opacities } from './palette.js';
import { part } from './part.js';
import { octahedron, sphere } from './solids.js';

// Inertias larger than the mechanism must not hide it.
function opacity_of(largest, size) {
  const share = Math.min(1, (0.25 * size) / largest);
  return Math.max(0.1, Math.round(20 * opacities.body * share) / 20);
}

// Half the longest side of what is drawn.
function half_length(mesh) {
  const { geometry, scale } = mesh, size = new Vector3();
  if (!geometry.boundingBox) geometry.computeBoundingBox();
  geometry.boundingBox.getSize(size).multiply(scale);
  return 0.5 * Math.max(size.x, size.y, size.z);
}

// Where shapes are: which body nodes (frames that move, each with those that are rigid in it) have some, and how large.
class Shapes {
  constructor(mechanism) {
    const { scene } = mechanism, poses = new FramePoses(scene.frames);
    this.node_of = (frame) => poses.carrier(frame);
    this.sizes = new Map();  // node: half the length of its largest shape
    for (const mesh of mechanism.layer('visual')) {
      const { index, frame } = mesh.userData, node = this.node_of(frame);
      if (scene.shapes[index].type !== 'plane') this.sizes.set(node, Math.max(this.sizes.get(node) ?? 0, half_length(mesh)));
    }
    this.beside = new Map();  // node: those at the other ends of its joints
    for (const { before, after } of scene.joints) this.join(this.node_of(before), this.node_of(after));
  }

  join(a, b) {
    for (const [from, to] of [[a, b], [b, a]]) this.beside.set(from, [...this.beside.get(from) ?? [], to]);
  }

  // The largest of the shapes nearest to a node along joints, or of all.
  size_near(node) {
    const seen = new Set([node]);
    for (let level = [node]; level.length > 0;) {
      const found = level.filter((n) => this.sizes.has(n));
      if (found.length > 0) return Math.max(...found.map((n) => this.sizes.get(n)));
      level = level.flatMap((n) => this.beside.get(n) ?? []).filter((n) => !seen.has(n) && seen.add(n));
    }
    return Math.max(...this.sizes.values());
  }

  // Whether a shape stands for a body, or its inertia would hide the shapes near it.
  hide(body) {
    const node = this.node_of(body.frame);
    return this.sizes.size > 0 && (this.sizes.has(node) || Math.max(...body.ellipsoid) > this.size_near(node));
  }
}

export function add_bodies(mechanism) {
  const { scene, materials, unit } = mechanism;
  const shapes = new Shapes(mechanism);
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
    mechanism.add_to_frame(shapes.hide(body) ? 'shaped bodies' : 'bodies', body.frame, group);
  });
}
