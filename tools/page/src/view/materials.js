// One material a role, opacity and kind of geometry: those without normals are faceted. A theme changes their colours in place.

import { DoubleSide, MeshBasicMaterial, MeshStandardMaterial } from 'three';
import { opacities, palettes } from './palette.js';

const flat = new Set(['range', 'plane']);  // not lit

export const is_faceted = (geometry) => !geometry.attributes.normal;

export class Materials {
  constructor(theme) {
    this.theme = theme;
    this.roles = new Map();
    this.coloured = new Map();
  }

  of(role, opacity = opacities[role] ?? 1, faceted = false) {
    const key = `${role} ${opacity} ${faceted}`;
    let material = this.roles.get(key);
    if (!material) {
      const Type = flat.has(role) ? MeshBasicMaterial : MeshStandardMaterial;
      material = new Type({ transparent: opacity < 1, opacity, depthWrite: opacity >= 1, color: palettes[this.theme][role] });
      if (flat.has(role)) material.side = DoubleSide;
      else material.setValues({ roughness: 0.62, metalness: 0.05, flatShading: faceted });
      if (role === 'ghost') material.depthWrite = true;
      this.roles.set(key, material);
    }
    return material;
  }

  // Of a file's shape: r g b a, 0 to 1.
  of_colour(rgba, faceted) {
    const key = `${rgba.join(' ')} ${faceted}`;
    let material = this.coloured.get(key);
    if (!material) {
      const [r, g, b, a = 1] = rgba.map((x) => Math.min(1, Math.max(0, Number(x) || 0)));
      material = new MeshStandardMaterial({ roughness: 0.7, metalness: 0.05, flatShading: faceted, transparent: a < 1, opacity: Math.max(a, 0.05), depthWrite: a >= 1 });
      material.color.setRGB(r, g, b, 'srgb');
      this.coloured.set(key, material);
    }
    return material;
  }

  // Of a role, for a mesh.
  for_mesh(role, mesh) {
    return this.of(role, undefined, is_faceted(mesh.geometry));
  }

  set_theme(theme) {
    this.theme = theme;
    for (const [key, material] of this.roles) material.color.setHex(palettes[theme][key.split(' ')[0]]);
  }
}
