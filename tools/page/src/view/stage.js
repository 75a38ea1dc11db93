// The canvas: renderer, lights, ground, camera, and what is under the pointer.

import {
  Color, DirectionalLight, HemisphereLight, Mesh, PCFShadowMap, PlaneGeometry, Raycaster, Scene, ShadowMaterial, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { extent_along } from './bounds.js';
import { Camera } from './camera.js';
import { Grid } from './grid.js';
import { palettes } from './palette.js';

const point = new Vector3();

export class Stage {
  // Throws where the browser offers no WebGL.
  constructor(canvas, up, planar, theme, changed) {
    this.canvas = canvas;
    const context = canvas.getContext('webgl2', { antialias: true, powerPreference: 'high-performance' });
    if (!context) throw new Error('this browser offers no WebGL 2 here.');
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.world = new Scene();
    this.theme = theme;
    this.up = new Vector3(...up);
    this.planar = planar;
    this.camera = new Camera(canvas, up, planar, changed);
    this.sky = new HemisphereLight(palettes[theme].sky, palettes[theme].ground, 1.7);
    this.sun = new DirectionalLight(0xffffff, 1.9);
    this.world.add(this.sky, this.sun, this.sun.target);
    this.raycaster = new Raycaster();
    this.pointer = new Vector2();
  }

  // Lights and ground for the space that the mechanism takes.
  furnish(bounds) {
    const { sphere } = bounds;
    const radius = Math.max(sphere.radius, 1e-6);
    const [lowest] = extent_along(bounds, this.up);
    const height = this.planar ? -radius : lowest > -0.08 * radius ? 0 : lowest;
    this.grid = new Grid((this.planar ? 12 : 7) * Math.max(radius, sphere.center.length() / 3), this.planar ? [0, 0, 1] : this.up.toArray(), height, this.theme);
    this.world.add(this.grid.object);
    this.sky.position.copy(this.planar ? new Vector3(0, 0, 1) : this.up);
    this.sun.position.copy(sphere.center).addScaledVector(this.planar ? new Vector3(-0.4, 0.7, 1).normalize() : this.sun_direction(), 6 * radius);
    this.sun.target.position.copy(sphere.center);
    if (!this.planar && !this.draws_in_software()) this.cast_shadows(sphere, radius, height);
  }

  // Without a graphics processor a picture takes long, with shadows half as long again.
  draws_in_software() {
    const gl = this.renderer.getContext(), names = gl.getExtension('WEBGL_debug_renderer_info');
    return names !== null && /swiftshader|llvmpipe|softpipe|software|basic render/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
  }

  sun_direction() {
    const side = new Vector3(Math.abs(this.up.x) > 0.9 ? 0 : 1, Math.abs(this.up.x) > 0.9 ? 1 : 0, 0);
    const front = new Vector3().crossVectors(side, this.up);
    return side.multiplyScalar(-0.3).addScaledVector(front, 0.35).addScaledVector(this.up, 1).normalize();
  }

  cast_shadows(sphere, radius, height) {
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.radius = 3;
    Object.assign(this.sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.1 * radius, far: 14 * radius });
    this.shadow = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: palettes[this.theme].shadow }));
    this.shadow.material.depthWrite = false;
    this.shadow.scale.setScalar(8 * radius);
    this.shadow.quaternion.copy(this.grid.object.quaternion);
    this.shadow.position.copy(sphere.center).addScaledVector(this.up, height - sphere.center.dot(this.up));
    this.shadow.receiveShadow = true;
    this.shadow.raycast = () => {};
    this.world.add(this.shadow);
  }

  drop_shadows() {
    this.sun.castShadow = false;
    if (this.shadow) this.shadow.visible = false;
  }

  set_pixel_ratio(ratio) {
    if (ratio >= this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.width, this.height, false);
  }

  set_theme(theme) {
    this.theme = theme;
    this.world.background = new Color(palettes[theme].background);
    this.sky.color.setHex(palettes[theme].sky);
    this.sky.groundColor.setHex(palettes[theme].ground);
    this.grid?.set_theme(theme);
    if (this.shadow) this.shadow.material.opacity = palettes[theme].shadow;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0 || (this.width === width && this.height === height)) return;
    this.width = width;
    this.height = height;
    this.renderer.setSize(width, height, false);
    this.camera.resize(width, height);
  }

  render() {
    this.renderer.render(this.world, this.camera.camera);
  }

  // Until the graphics processor, or what stands for it, has drawn everything.
  async finished() {
    const gl = this.renderer.getContext(), all = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (gl.clientWaitSync(all, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise((go) => { setTimeout(go, 20); });
    gl.deleteSync(all);
  }

  // Pixels of the canvas of a point of the world; z is below 1 in front of the camera.
  project(x, y, z, out) {
    point.set(x, y, z).project(this.camera.camera);
    out.x = (0.5 + 0.5 * point.x) * this.width;
    out.y = (0.5 - 0.5 * point.y) * this.height;
    out.z = point.z;
    return out;
  }

  aim(event) {
    const box = this.canvas.getBoundingClientRect();
    this.pointer.set((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
    this.raycaster.setFromCamera(this.pointer, this.camera.camera);
    return this.raycaster.ray;
  }

  // The first visible piece of what hangs on `root` that is under the pointer: {object, point}, or null.
  pick(event, root) {
    this.aim(event);
    const shown = (object) => {
      for (let o = object; o; o = o.parent) if (!o.visible) return false;
      return true;
    };
    const hits = this.raycaster.intersectObject(root, true);
    return hits.find((hit) => shown(hit.object) && hit.object.userData.frame >= 0) ?? null;
  }
}
