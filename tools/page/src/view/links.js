// Links: rods between two frames, moved with both.

import { part, span } from './part.js';
import { rod } from './solids.js';

export function add_links(mechanism) {
  const { scene, materials, unit } = mechanism;
  const material = materials.of('link');
  scene.links.forEach((link, index) => {
    const mesh = part(rod(), material, { kind: 'link', index, frame: link.to });
    mechanism.add_loose('links', mesh);
    const a = 7 * link.from, b = 7 * link.to;
    mechanism.on_update((w) => span(mesh, w[a], w[a + 1], w[a + 2], w[b], w[b + 1], w[b + 2], 0.3 * unit));
  });
}
