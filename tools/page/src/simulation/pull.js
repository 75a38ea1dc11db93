// Pulls a body by the pointer: a spring from the point that was grabbed to the pointer, in the plane that faces the viewer.

import { Plane, Vector3 } from 'three';
import { to_local } from '../scene/pose.js';

const rate = 9;             // rad/s of the whole mass on the spring
const damping_ratio = 0.4;

// What is grabbed, and where it is drawn to.
export class Hand {
  constructor(scene, frame_poses, stage) {
    Object.assign(this, { scene, frame_poses, stage });
    this.frame = -1;
    this.plane = new Plane();
    this.normal = new Vector3();
    this.target = new Vector3();
    this.point = new Float64Array(3);
  }

  // Grabs what was hit; false where it hangs on the world.
  grab(hit) {
    const frame = this.frame_poses.carrier(hit.object.userData.frame);
    if (frame < 0) return false;
    this.frame = frame;
    this.target.copy(hit.point);
    to_local(this.point, this.frame_poses.world, 7 * frame, hit.point.toArray());
    this.stage.camera.camera.getWorldDirection(this.normal);
    this.plane.setFromNormalAndCoplanarPoint(this.normal, hit.point);
    this.apply();
    return true;
  }

  move(event) {
    this.stage.aim(event).intersectPlane(this.plane, this.target);
    this.apply();
  }

  release() {
    if (this.frame >= 0) this.end();
    this.frame = -1;
  }

  get active() { return this.frame >= 0; }

  // Where the point that was grabbed is now.
  from(out) {
    const w = this.frame_poses.world, i = 7 * this.frame;
    const [px, py, pz] = this.point, s = w[i + 3], x = w[i + 4], y = w[i + 5], z = w[i + 6];
    const cx = y * pz - z * py, cy = z * px - x * pz, cz = x * py - y * px;
    out[0] = w[i] + px + 2 * (s * cx + y * cz - z * cy);
    out[1] = w[i + 1] + py + 2 * (s * cy + z * cx - x * cz);
    out[2] = w[i + 2] + pz + 2 * (s * cz + x * cy - y * cx);
    return out;
  }
}

// By the engine of the page.
export class Pull extends Hand {
  constructor(scene, frame_poses, stage, engine) {
    super(scene, frame_poses, stage);
    this.engine = engine;
    const mass = scene.bodies.reduce((sum, body) => sum + (body.mass > 0 ? body.mass : 0), 0) || 1;
    this.stiffness = mass * rate * rate;
    this.damping = 2 * damping_ratio * mass * rate;
  }

  apply() {
    this.engine.pull(this.scene.frames[this.frame].name, [...this.point], this.target.toArray(), this.stiffness, this.damping);
  }

  end() {
    this.engine.pull(null);
  }
}
