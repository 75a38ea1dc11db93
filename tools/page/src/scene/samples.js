// Times with poses of all tracks (float32 positions, int16 quaternions) and what is between them.

export class Samples {
  // t: numbers in ascending order; positions: 3, rotations: 4 numbers a track and time; q, v: numbers a time, or null;
  // signals: numbers a time, perhaps none
  constructor(tracks, nq) {
    this.tracks = tracks;
    this.nq = nq;
    this.hint = 0;
  }

  get start() { return this.t[0]; }
  get end() { return this.t[this.count - 1]; }

  // The last sample not after `time`, at least 0.
  index_at(time) {
    const { t, count } = this;
    let i = Math.min(this.hint, count - 1);
    if (t[i] <= time && (i + 1 >= count || time < t[i + 1])) return i;
    let low = 0, high = count;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (t[middle] <= time) low = middle;
      else high = middle;
    }
    this.hint = low;
    return low;
  }

  // How far `time` is from sample i to the next, 0 to 1.
  fraction(time, i) {
    if (i + 1 >= this.count) return 0;
    const step = this.t[i + 1] - this.t[i];
    return step > 0 ? Math.min(1, Math.max(0, (time - this.t[i]) / step)) : 0;
  }

  // About n samples, the last, and those in which a track is farthest along an axis.
  samples_of_motion(n) {
    const { positions, count, tracks } = this, chosen = new Set(), steps = Math.max(1, Math.min(n, count - 1));
    for (let k = 0; k <= steps; ++k) chosen.add(Math.round((k * (count - 1)) / steps));
    for (let axis = 0; axis < 3; ++axis) {
      let lowest = axis, highest = axis;  // in positions
      for (let i = axis; i < 3 * count * tracks; i += 3) {
        if (positions[i] < positions[lowest]) lowest = i;
        if (positions[i] > positions[highest]) highest = i;
      }
      if (tracks > 0) for (const i of [lowest, highest]) chosen.add(Math.floor(i / (3 * tracks)));
    }
    return chosen;
  }

  // Poses of all tracks at `time`, 7 numbers each.
  poses_at(time, out) {
    const i = this.index_at(time), f = this.fraction(time, i), j = f > 0 ? i + 1 : i;
    for (let k = 0; k < this.tracks; ++k) this.pose(out, 7 * k, k, i, j, f);
    return out;
  }

  // Pose of track k, between samples i and j.
  pose(out, o, k, i, j, f) {
    const { positions: p, rotations: r, tracks } = this;
    const a = 3 * (i * tracks + k), b = 3 * (j * tracks + k);
    for (let n = 0; n < 3; ++n) out[o + n] = p[a + n] + f * (p[b + n] - p[a + n]);
    const c = 4 * (i * tracks + k), d = 4 * (j * tracks + k);
    const sign = r[c] * r[d] + r[c + 1] * r[d + 1] + r[c + 2] * r[d + 2] + r[c + 3] * r[d + 3] < 0 ? -f : f;
    let square = 0;
    for (let n = 0; n < 4; ++n) {
      const x = (1 - f) * r[c + n] + sign * r[d + n];
      out[o + 3 + n] = x;
      square += x * x;
    }
    if (square > 0) for (let n = 3; n < 7; ++n) out[o + n] /= Math.sqrt(square);
    else out[o + 3] = 1;
  }

  // What is known of the mechanism at sample i: q, v, signals (of the engine), free: whether nothing else acted on it; null
  // where q was not recorded.
  state_of(i) {
    if (!this.q) return null;
    const part = (all) => {
      const width = all.length / this.t.length;
      return Float64Array.from(all.subarray(width * i, width * (i + 1)));
    };
    return { t: this.t[i], q: part(this.q), v: this.v ? part(this.v) : null, signals: part(this.signals), free: !this.assisted?.[i] };
  }

  // Coordinates at `time`; false where they were not recorded.
  q_at(time, out) {
    if (!this.q) return false;
    const i = this.index_at(time), f = this.fraction(time, i), j = f > 0 ? i + 1 : i, n = this.nq;
    for (let k = 0; k < n; ++k) out[k] = this.q[i * n + k] + f * (this.q[j * n + k] - this.q[i * n + k]);
    return true;
  }
}
