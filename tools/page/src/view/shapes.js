// Shapes of files: primitives and meshes, on their frames.

import { CapsuleGeometry, PlaneGeometry } from 'three';
import { is_faceted } from './materials.js';
import { part } from './part.js';
import { box, cylinder, slab, sphere } from './solids.js';

const sizes = { box: 3, sphere: 1, cylinder: 2, capsule: 2, ellipsoid: 3, plane: 2 };

function mesh_geometry({ geometry, error }) {
  if (error) throw error;
  return geometry;
}

function geometry_and_scale(mechanism, shape) {
  const size = shape.size ?? [], { unit, scene } = mechanism, contact = shape.role === 'contact';
  const count = sizes[shape.type];
  if (count && (size.length !== count || !size.every((x) => Number.isFinite(x) && x >= 0))) return null;
  switch (shape.type) {
    case 'box': return [box(), size];
    case 'sphere': return [sphere(), Array(3).fill(size[0] || (contact ? 0.35 * unit : 0))];
    case 'ellipsoid': return [sphere(), size];
    case 'cylinder': return [cylinder(), [size[0], size[0], size[1] || (contact ? 4 * scene.size : 0)]];
    case 'capsule': return [new CapsuleGeometry(size[0], size[1], 10, 24).rotateX(Math.PI / 2), [1, 1, 1]];
    case 'plane': {
      const sides = [size[0] || 4 * scene.size, size[1] || 4 * scene.size];
      return scene.planar ? [slab(), [...sides, 0.5 * unit]] : [new PlaneGeometry(...sides), [1, 1, 1]];  // in the plane its edge is seen
    }
    case 'mesh': return [mesh_geometry(scene.meshes[shape.mesh]), Array.isArray(shape.size) && shape.size.length === 3 ? shape.size : [1, 1, 1]];
    default: return null;
  }
}

export function layer_of(shape) {
  return shape.role === 'collision' ? 'collision' : shape.role === 'contact' ? 'forces' : 'visual';
}

// The role of its material: an infinite plane is seen through.
function role_of(shape) {
  if (shape.type === 'plane' && (!Array.isArray(shape.colour) || !(shape.size[0] > 0 && shape.size[1] > 0))) return shape.role === 'collision' ? 'collision' : 'plane';
  return shape.role === 'collision' || (shape.role === 'contact' && !Array.isArray(shape.colour)) ? shape.role : 'visual';
}

export function add_shapes(mechanism, notes) {
  const { scene, materials } = mechanism;
  scene.shapes.forEach((shape, index) => {
    let drawn;
    try {
      drawn = geometry_and_scale(mechanism, shape);
    } catch (error) {
      notes.push(`Shape ${index} is not drawn: ${error.message}`);
      return;
    }
    if (!drawn) {
      notes.push(`Shape ${index} is not drawn: its type or size is unknown.`);
      return;
    }
    const faceted = is_faceted(drawn[0]), role = role_of(shape);
    const material = role === 'visual' && Array.isArray(shape.colour) ? materials.of_colour(shape.colour, faceted) : materials.of(role, undefined, faceted);
    const mesh = part(drawn[0], material, { kind: 'shape', index, frame: shape.frame }, drawn[1]);
    const [x, y, z, qw, qx, qy, qz] = shape.pose;
    mesh.position.set(x, y, z);
    mesh.quaternion.set(qx, qy, qz, qw).normalize();
    mechanism.add_to_frame(layer_of(shape), shape.frame, mesh);
  });
}
