// A piece of a symbol: a mesh that knows what of the scene it belongs to.

import { Mesh, Quaternion, Vector3 } from 'three';

const z = new Vector3(0, 0, 1);
const direction = new Vector3();
const turn = new Quaternion();

// `of`: {kind, index, frame}
export function part(geometry, material, of, scale = 1) {
  const mesh = new Mesh(geometry, material);
  if (Array.isArray(scale)) mesh.scale.set(...scale);
  else mesh.scale.setScalar(scale);
  mesh.userData = of;
  mesh.castShadow = !material.transparent;
  return mesh;
}

// Turns an object's z axis to `axis`.
export function align(object, axis) {
  object.quaternion.setFromUnitVectors(z, direction.set(...axis).normalize());
  return object;
}

// Places an object whose geometry spans z = 0 to 1 from (x, y, z) a to b; thickness is its x and y scale.
export function span(object, ax, ay, az, bx, by, bz, thickness) {
  const length = Math.hypot(bx - ax, by - ay, bz - az);
  object.visible = length > 1e-9;
  if (!object.visible) return;
  object.position.set(ax, ay, az);
  object.scale.set(thickness, thickness, length);
  object.quaternion.copy(turn.setFromUnitVectors(z, direction.set((bx - ax) / length, (by - ay) / length, (bz - az) / length)));
}
