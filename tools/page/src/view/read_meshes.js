// Geometries of the meshes of a scene.

import { decode_base64 } from '../scene/base64.js';
import { triangles } from './solids.js';

function geometry_of(mesh, place) {
  const positions = decode_base64(mesh.positions), indices = decode_base64(mesh.indices);
  if (positions.length % 12 || indices.length % 12) throw new Error(`${place}: not whole triangles`);
  const vertices = new Float32Array(positions.buffer, 0, positions.length / 4);
  const corners = new Uint32Array(indices.buffer, 0, indices.length / 4);
  if (corners.some((i) => 3 * i >= vertices.length)) throw new Error(`${place}: an index without a vertex`);
  return triangles(vertices, corners);
}

// Each mesh gets its `geometry`, or the `error` why there is none, instead of its text. Calls and awaits tell(done, all).
export async function read_meshes(meshes, tell) {
  for (const [i, mesh] of meshes.entries()) {
    await tell(i, meshes.length);
    try {
      mesh.geometry = geometry_of(mesh, `meshes[${i}]`);
    } catch (error) {
      mesh.error = error;
    }
    mesh.positions = mesh.indices = null;
  }
}
