// World poses of all frames from those of the tracks.

import { compose } from './pose.js';

export class FramePoses {
  constructor(frames) {
    this.count = frames.length;
    this.world = new Float64Array(7 * frames.length);
    this.tracks = Int32Array.from(frames, (frame) => frame.track ?? -1);
    this.parents = Int32Array.from(frames, (frame) => frame.parent ?? -1);
    this.fixed = new Float64Array(7 * frames.length);
    frames.forEach((frame, i) => this.fixed.set(frame.pose ?? [0, 0, 0, 1, 0, 0, 0], 7 * i));
  }

  update(track_poses) {
    const { world, fixed } = this;
    for (let i = 0; i < this.count; ++i) {
      if (this.tracks[i] >= 0) for (let k = 0, from = 7 * this.tracks[i]; k < 7; ++k) world[7 * i + k] = track_poses[from + k];
      else if (this.parents[i] < 0) for (let k = 7 * i; k < 7 * i + 7; ++k) world[k] = fixed[k];
      else compose(world, 7 * i, world, 7 * this.parents[i], fixed, 7 * i);
    }
  }

  // The frame with a track that carries frame i, or -1 for the world.
  carrier(i) {
    while (i >= 0 && this.tracks[i] < 0) i = this.parents[i];
    return i;
  }
}
