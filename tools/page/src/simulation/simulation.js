// A simulation by kte in the page: steps with the clock of the screen, and writes a recording.

import { GrowingRecording } from '../scene/growing_recording.js';

const longest_step = 1 / 20;      // s of the clock in one step; slower machines simulate slower
const most_milliseconds = 14;     // of work in one step

export class Simulation {
  constructor(scene, engine) {
    this.scene = scene;
    this.engine = engine;
    this.running = false;
    this.damping = 0;
  }

  start(q, v) {
    this.engine.start(q, v);
    this.engine.damping(this.damping);
    this.recording = new GrowingRecording(this.scene, 'simulated here', q.length);
    this.read();
  }

  read() {
    const { t, q, v, energy } = this.engine.state();
    Object.assign(this, { time: t, q, v, energy });
    this.poses = this.engine.poses(q);
    if (!this.recording.add(t, this.poses, q)) this.running = false;
  }

  set_damping(c) {
    this.damping = c;
    if (this.recording) this.engine.damping(c);
  }

  advance(elapsed, speed) {
    if (!this.running) return;
    this.engine.step(Math.min(elapsed, longest_step) * speed, most_milliseconds);
    this.read();
  }
}
