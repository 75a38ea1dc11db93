// A simulation by kte in the page: steps with the clock of the screen, and writes a recording.

import { GrowingRecording } from '../scene/growing_recording.js';

const longest_step = 0.25;     // s of the clock between two pictures; slower machines simulate slower
const sample = 1 / 60;         // s of the clock between samples of the recording
const most_milliseconds = 24;  // of work between two pictures

export class Simulation {
  constructor(scene, engine) {
    this.scene = scene;
    this.engine = engine;
    this.running = false;
    this.damping = 0;
    this.pulled = () => false;
    this.pace = 1;  // of what the clock and the speed ask for, the mean of late
  }

  start(q, v) {
    this.engine.start(q, v);
    this.engine.damping(this.damping);
    const { signals } = this.engine.state();
    this.recording = new GrowingRecording(this.scene, 'simulated here', q.length, v.length, signals.length);
    this.read();
  }

  read() {
    const state = this.engine.state(), { t, q, v, energy } = state;
    Object.assign(this, { time: t, q, v, energy: energy.kinetic + energy.potential });
    this.poses = this.engine.poses(q);
    if (!this.recording.add(t, this.poses, state, this.damping > 0 || this.pulled(), this.energy)) this.running = false;
  }

  // What acts now.
  loads() { return { acting: this.engine.loads_now(), doubt: '' }; }

  set_damping(c) {
    this.damping = c;
    if (this.recording) this.engine.damping(c);
  }

  advance(elapsed, speed) {
    if (!this.running) return;
    const begin = this.time;
    const end = this.time + Math.min(elapsed, longest_step) * speed, latest = performance.now() + most_milliseconds;
    while (this.running && this.time < end) {
      const left = latest - performance.now();
      if (left <= 0) break;
      this.engine.step(Math.min(sample * speed, end - this.time), left);
      this.read();
    }
    if (elapsed > 0) this.pace += 0.1 * ((this.time - begin) / (elapsed * speed) - this.pace);
  }
}
