// A recording that a simulation in the page writes.

import { Column, coordinate_columns } from './recording.js';
import { Samples } from './samples.js';

export class GrowingRecording extends Samples {
  constructor(scene, name, nq) {
    super(scene.tracks, nq);
    this.name = name;
    this.count = 0;
    this.limit = 100000;
    this.reserve(1024);
    this.scene = scene;
  }

  reserve(capacity) {
    const grown = (Type, old, count) => {
      const array = new Type(count);
      if (old) array.set(old);
      return array;
    };
    this.t = grown(Float64Array, this.t, capacity);
    this.positions = grown(Float32Array, this.positions, capacity * this.tracks * 3);
    this.rotations = grown(Int16Array, this.rotations, capacity * this.tracks * 4);
    this.q = grown(Float32Array, this.q, capacity * this.nq);
    this.energy = grown(Float32Array, this.energy, capacity);
    this.capacity = capacity;
  }

  // False when it is full.
  add(time, track_poses, q, energy) {
    if (this.count >= this.limit) return false;
    if (this.count === this.capacity) this.reserve(2 * this.capacity);
    const i = this.count++;
    this.t[i] = time;
    this.q.set(q, i * this.nq);
    this.energy[i] = energy;
    for (let k = 0; k < this.tracks; ++k) {
      const p = 3 * (i * this.tracks + k), r = 4 * (i * this.tracks + k);
      for (let n = 0; n < 3; ++n) this.positions[p + n] = track_poses[7 * k + n];
      for (let n = 0; n < 4; ++n) this.rotations[r + n] = Math.round(32767 * track_poses[7 * k + 3 + n]);
    }
    return true;
  }

  // New ones at each call: the numbers have grown.
  get columns() {
    const energy = new Column('energy', 'J', () => this.energy.subarray(0, this.count));
    return [...coordinate_columns(this.scene.coordinates, this), energy];
  }
}
