// A recording that a simulation in the page writes.

import { Column, coordinate_columns } from './recording.js';
import { Samples } from './samples.js';

export class GrowingRecording extends Samples {
  // signals: how many numbers there are of them
  constructor(scene, name, nq, nv, signals) {
    super(scene.tracks, nq);
    this.name = name;
    this.count = 0;
    this.limit = 100000;
    this.lists = {  // name: type of numbers, how many a time
      t: [Float64Array, 1], positions: [Float32Array, 3 * this.tracks], rotations: [Int16Array, 4 * this.tracks], q: [Float32Array, nq],
      v: [Float32Array, nv], signals: [Float32Array, signals], assisted: [Uint8Array, 1], energy: [Float32Array, 1],
    };
    this.reserve(1024);
    this.scene = scene;
  }

  reserve(capacity) {
    for (const [name, [Type, width]] of Object.entries(this.lists)) {
      const array = new Type(capacity * width);
      if (this[name]) array.set(this[name]);
      this[name] = array;
    }
    this.capacity = capacity;
  }

  // assisted: whether something acted that is not in the model. False when it is full.
  add(time, track_poses, { q, v, signals }, assisted, energy) {
    if (this.count >= this.limit) return false;
    if (this.count === this.capacity) this.reserve(2 * this.capacity);
    const i = this.count++;
    this.t[i] = time;
    this.q.set(q, i * q.length);
    this.v.set(v, i * v.length);
    this.signals.set(signals, i * signals.length);
    this.assisted[i] = assisted ? 1 : 0;
    this.energy[i] = energy;
    for (let k = 0; k < this.tracks; ++k) {
      const p = 3 * (i * this.tracks + k), r = 4 * (i * this.tracks + k);
      for (let n = 0; n < 3; ++n) this.positions[p + n] = track_poses[7 * k + n];
      for (let n = 0; n < 4; ++n) this.rotations[r + n] = Math.round(32767 * track_poses[7 * k + 3 + n]);
    }
    return true;
  }

  // The first n go.
  drop(n) {
    for (const [name, [, width]] of Object.entries(this.lists)) this[name].copyWithin(0, n * width, this.count * width);
    this.count -= n;
    this.hint = 0;
  }

  // New ones at each call: the numbers have grown.
  get columns() {
    const energy = new Column('energy', 'J', () => this.energy.subarray(0, this.count));
    return [...coordinate_columns(this.scene.coordinates, this), energy];
  }
}
