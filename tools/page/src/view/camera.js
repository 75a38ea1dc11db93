// The camera: perspective about the mechanism, or orthographic from +z for planar chains.

import { MOUSE, OrthographicCamera, PerspectiveCamera, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { extent_along } from './bounds.js';

const margin = 1.15;  // around what is fitted
const offset = new Vector3(), step = new Vector3();

// A direction at right angles to up.
function sideways(up) {
  const side = new Vector3(Math.abs(up.x) > 0.9 ? 0 : 1, Math.abs(up.x) > 0.9 ? 1 : 0, 0);
  return side.addScaledVector(up, -side.dot(up)).normalize();
}

export class Camera {
  constructor(canvas, up, planar, changed) {
    this.planar = planar;
    this.up = new Vector3(...up);
    this.camera = planar ? new OrthographicCamera() : new PerspectiveCamera(35, 1, 0.01, 1000);
    this.camera.up.copy(this.up);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', changed);
    this.controls.zoomToCursor = true;
    if (planar) {
      this.controls.enableRotate = false;
      this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
      this.controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    }
    this.aspect = 1;
  }

  resize(width, height) {
    this.aspect = width / Math.max(1, height);
    this.project();
  }

  project() {
    const camera = this.camera;
    if (this.planar) {
      const half = this.half ?? 1;
      camera.top = half / Math.min(1, this.aspect);
      camera.right = camera.top * this.aspect;
      camera.bottom = -camera.top;
      camera.left = -camera.right;
    } else {
      camera.aspect = this.aspect;
    }
    camera.updateProjectionMatrix();
  }

  // Shows all points of the motion, in 3D from `from`: shares of right, front and up.
  fit(bounds, from = [0.62, 0.85, 0.42]) {
    const { camera, controls } = this;
    const radius = Math.max(bounds.sphere.radius, 1e-6);
    controls.target.copy(bounds.sphere.center);
    if (this.planar) {
      const right = offset.set(this.up.y, -this.up.x, 0);
      const [left_end, right_end] = extent_along(bounds, right), [bottom, top] = extent_along(bounds, this.up);
      const square = Math.min(1, this.aspect);  // project() divides by it
      this.half = Math.max(0.5 * margin * square * Math.max(top - bottom, (right_end - left_end) / this.aspect), 1e-3 * radius);
      camera.zoom = 1;
      camera.position.copy(bounds.sphere.center).add(step.set(0, 0, 20 * radius));
      camera.near = radius;
      camera.far = 60 * radius;
    } else {
      const right = sideways(this.up), front = step.crossVectors(right, this.up);
      offset.copy(right).multiplyScalar(from[0]).addScaledVector(front, from[1]).addScaledVector(this.up, from[2]).normalize();
      const distance = this.distance_for(bounds.points, offset, bounds.sphere.radius);
      camera.position.copy(controls.target).addScaledVector(offset, distance);
      camera.near = distance / 500;
      camera.far = distance * 60;
    }
    this.project();
    controls.update();
  }

  // Moves the target to the middle of the points, seen along -backward, and tells from where all are in view.
  distance_for(points, backward, radius) {
    const tall = Math.tan((this.camera.fov * Math.PI) / 360) / margin, wide = tall * this.aspect;
    if (points.length === 0) return (margin * radius) / Math.min(tall, wide);
    const right = new Vector3().crossVectors(this.up, backward).normalize(), above = new Vector3().crossVectors(backward, right);
    const { target } = this.controls;
    for (const axis of [right, above]) target.addScaledVector(axis, 0.5 * extent_along({ points }, axis).reduce((low, high) => low + high) - target.dot(axis));
    const p = new Vector3();
    let distance = 0.2 * radius;
    for (let i = 0; i < points.length; i += 3) {
      p.fromArray(points, i).sub(target);
      distance = Math.max(distance, p.dot(backward) + Math.max(Math.abs(p.dot(right)) / wide, Math.abs(p.dot(above)) / tall));
    }
    return distance;
  }

  // Moves with what is followed.
  shift(x, y, z) {
    step.set(x, y, z);
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
  }

  // Turns about the target, rad; in the plane it pans instead.
  orbit(left, up) {
    if (this.planar) {
      const scale = (0.5 * this.half) / this.camera.zoom;
      const right = offset.set(this.up.y, -this.up.x, 0);
      this.shift(scale * (right.x * left + this.up.x * up), scale * (right.y * left + this.up.y * up), 0);
      return;
    }
    offset.subVectors(this.camera.position, this.controls.target);
    const right = step.crossVectors(this.up, offset).normalize();
    const angle = offset.angleTo(this.up);
    offset.applyAxisAngle(right, Math.min(Math.max(-up, 0.02 - angle), Math.PI - 0.02 - angle));
    offset.applyAxisAngle(this.up, left);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
  }

  zoom(factor) {
    if (this.planar) {
      this.camera.zoom *= factor;
      this.project();
    } else {
      offset.subVectors(this.camera.position, this.controls.target).divideScalar(factor);
      this.camera.position.copy(this.controls.target).add(offset);
    }
    this.controls.update();
  }
}
