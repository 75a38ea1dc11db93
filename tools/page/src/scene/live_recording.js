// The last seconds of what a program shows.

import { GrowingRecording } from './growing_recording.js';

const length = 30, slack = 5;  // s

export class LiveRecording extends GrowingRecording {
  // columns: [{name, unit}]
  constructor(scene, nq, nv, signals, columns) {
    super(scene, 'live', nq, nv, signals);
    this.kinds = columns;
    this.values = columns.map(() => []);
  }

  // A time that is not after the last begins anew.
  add(time, track_poses, state, assisted, values) {
    if (this.count > 0 && time < this.end) this.drop(this.count);
    else if (this.count > 0 && time === this.end) this.drop_last();
    else if (this.count > 0 && (time - this.start > length + slack || this.count === this.limit)) this.drop(this.first_after(time - length));
    super.add(time, track_poses, state, assisted);
    this.values.forEach((column, i) => column.push(Number.isFinite(values[i]) ? values[i] : null));
    return true;
  }

  first_after(time) {
    let i = this.count >> 4;
    while (i < this.count && this.t[i] < time) ++i;
    return Math.max(1, i);
  }

  drop_last() {
    --this.count;
    for (const column of this.values) column.pop();
  }

  drop(n) {
    super.drop(n);
    for (const column of this.values) column.splice(0, n);
  }

  get columns() { return this.kinds.map(({ name, unit }, i) => ({ name, unit, data: this.values[i].slice() })); }
}
