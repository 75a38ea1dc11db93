// The ground: a grid that fades with distance, at right angles to "up".

import { Color, DoubleSide, Mesh, PlaneGeometry, ShaderMaterial, Vector3 } from 'three';
import { palettes } from './palette.js';

const vertex = `
varying vec2 place;
uniform float extent;
void main() {
  place = position.xy * extent;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position.xy * extent, 0.0, 1.0);
}`;

// Lines of one pixel at multiples of the cell, stronger at ten cells and on the axes.
const fragment = `
varying vec2 place;
uniform float cell, extent;
uniform vec3 colour;
float lines(float size, float width) {
  vec2 at = place / size;
  vec2 slope = max(fwidth(at), 1e-6);
  vec2 from = abs(fract(at - 0.5) - 0.5) / slope;
  float covered = 1.0 - min(min(from.x, from.y) / width, 1.0);
  return covered * (1.0 - smoothstep(0.25, 0.7, max(slope.x, slope.y)));
}
void main() {
  float strength = max(0.26 * lines(cell, 1.0), 0.5 * lines(10.0 * cell, 1.2));
  float fade = 1.0 - smoothstep(0.25, 1.0, length(place) / extent);
  gl_FragColor = vec4(colour, strength * fade);
  #include <colorspace_fragment>
}`;

// 1, 2 or 5 times a power of ten, not above x.
export function round_down(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  const m = x / power;
  return (m >= 5 ? 5 : m >= 2 ? 2 : 1) * power;
}

export class Grid {
  // extent: how far it is seen, m
  constructor(extent, normal, height, theme) {
    this.cell = round_down(extent / 24);
    this.material = new ShaderMaterial({
      vertexShader: vertex,
      fragmentShader: fragment,
      uniforms: { cell: { value: this.cell }, extent: { value: extent }, colour: { value: new Color(palettes[theme].grid) } },
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
    });
    this.object = new Mesh(new PlaneGeometry(2, 2), this.material);
    this.object.frustumCulled = false;
    this.object.raycast = () => {};
    this.object.renderOrder = -1;
    const up = new Vector3(...normal);
    this.object.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), up);
    this.object.position.copy(up).multiplyScalar(height);
  }

  set_theme(theme) {
    this.material.uniforms.colour.value.setHex(palettes[theme].grid);
  }
}
