// Pulls a body of a program that runs, which is told again and again, so that it lets go where the page is gone.

import { Hand } from './pull.js';

const again = 500;  // ms

export class LivePull extends Hand {
  // move(request), release(): tell the program
  constructor(scene, frame_poses, stage, calls) {
    super(scene, frame_poses, stage);
    this.calls = calls;
    this.pulled = new Set(scene.pulls);
  }

  grab(hit) {
    const frame = this.frame_poses.carrier(hit.object.userData.frame);
    if (!this.pulled.has(frame) || !super.grab(hit)) return false;
    this.timer = setInterval(() => this.apply(), again);
    return true;
  }

  apply() {
    const [x, y, z] = this.point, [to_x, to_y, to_z] = this.target.toArray();
    this.count = (this.count ?? 0) + 1;
    this.calls.move(`pull?${new URLSearchParams({ frame: this.frame, x, y, z, to_x, to_y, to_z, n: this.count })}`);
  }

  end() {
    clearInterval(this.timer);
    this.calls.release();
  }
}
