// Where the poses that are shown come from: a recording at the player's time, the sliders, or the simulation.

import { Recording } from './scene/recording.js';

export class Sources {
  constructor(scene) {
    this.scene = scene;
    this.recordings = scene.recordings.map((data, i) => new Recording(scene, data, `recordings[${i}]`));
    this.main = this.recordings[0] ?? null;
    this.other = null;
    this.mode = 'play';  // or 'pose', 'simulate'
    this.engine = null;
    this.q = Float64Array.from(scene.state.q);
    this.tracks = new Float64Array(7 * scene.tracks);
    this.other_tracks = new Float64Array(7 * scene.tracks);
    for (let k = 0; k < scene.tracks; ++k) this.tracks[7 * k + 3] = 1;
  }

  // A configuration of the sliders.
  pose(q) {
    this.mode = 'pose';
    this.q.set(q);
  }

  // Poses of tracks at a time of the player.
  update(time, simulation) {
    if (this.mode === 'simulate') {
      this.tracks.set(simulation.poses);
      this.q.set(simulation.q);
    } else if (this.mode === 'pose') {
      this.tracks.set(this.engine.poses(this.q));
    } else if (this.main) {
      this.main.poses_at(time, this.tracks);
      this.main.q_at(time, this.q);
    }
    if (this.other) this.other.poses_at(time, this.other_tracks);
  }

  // The q of the poses that update() left; null where the recording has none.
  known_q() {
    return this.mode !== 'play' || !this.main || this.main.q ? this.q.slice() : null;
  }

  // Times that the recordings shown cover.
  range() {
    const shown = [this.main, this.other].filter(Boolean);
    return shown.length ? [Math.min(...shown.map((r) => r.start)), Math.max(...shown.map((r) => r.end))] : [0, 0];
  }

  // Poses of tracks at about so many times of the recordings shown.
  visit(times, use) {
    for (const recording of [this.main, this.other]) {
      if (!recording) continue;
      for (const i of recording.samples_of_motion(times)) use(recording.poses_at(recording.t[i], this.other_tracks));
    }
  }

  // The time of the sample `steps` from the one at `time`.
  step(time, steps) {
    if (!this.main) return time;
    const i = this.main.index_at(time);
    // between samples: a step back goes to the one before
    const j = i + steps + (steps < 0 && time > this.main.t[i] ? 1 : 0);
    return this.main.t[Math.min(this.main.count - 1, Math.max(0, j))];
  }
}
