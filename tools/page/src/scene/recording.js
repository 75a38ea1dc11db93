// A recording of the scene. Its arrays are decoded when they are asked for first.

import { decode_array, decode_base64 } from './base64.js';
import { coordinate_parts } from './coordinate_parts.js';
import { Samples } from './samples.js';

export class Column {
  constructor(name, unit, read) {
    this.name = String(name);
    this.unit = String(unit ?? '1');
    this.read = read;
  }

  // Values at the times of the recording; null where there is no number. Throws where the scene has bad ones.
  get data() {
    if (!this.values) {
      const values = this.read();
      this.values = values.every(Number.isFinite) ? values : Array.from(values, (x) => (Number.isFinite(x) ? x : null));
    }
    return this.values;
  }
}

// Numbers of q as columns.
export function coordinate_columns(coordinates, samples) {
  const columns = [];
  for (const coordinate of coordinates.filter((c) => c.q >= 0)) {
    coordinate_parts(coordinate).forEach(({ name, unit }, k) => {
      const at = coordinate.q + k;
      columns.push(new Column(name, unit, () => Float32Array.from({ length: samples.count }, (_, i) => samples.q[i * samples.nq + at])));
    });
  }
  return columns;
}

export class Recording extends Samples {
  constructor(scene, data, place) {
    const nq = scene.coordinates.reduce((n, c) => Math.max(n, c.q + c.size), scene.state.q.length);
    super(scene.tracks, nq);
    this.nv = scene.state.v.length;
    this.name = String(data.name ?? '');
    this.count = data.count;
    this.data = data;
    this.place = place;
    const recorded = data.columns.map(
      (column, i) => new Column(column.name, column.unit, () => decode_array(Float32Array, column.data, data.count, `${place}.columns[${i}]`)));
    const names = new Set(recorded.map((column) => column.name));
    const coordinates = data.q ? coordinate_columns(scene.coordinates, this).filter((column) => !names.has(column.name)) : [];
    this.columns = [...coordinates, ...recorded];
    this.plotted = (data.plotted ?? []).map(String);
  }

  lazily(name, Type, count) {
    const value = decode_array(Type, this.data[name] ?? '', count, `${this.place}.${name}`);
    Object.defineProperty(this, name, { value });
    return value;
  }

  get t() { return this.lazily('t', Float64Array, this.count); }
  get positions() { return this.lazily('positions', Float32Array, this.count * this.tracks * 3); }
  get rotations() { return this.lazily('rotations', Int16Array, this.count * this.tracks * 4); }
  get q() { return this.data.q ? this.lazily('q', Float32Array, this.count * this.nq) : null; }
  get v() { return this.data.v ? this.lazily('v', Float32Array, this.count * this.nv) : null; }
  // So many a row as there are.
  get signals() {
    const bytes = decode_base64(this.data.signals ?? '');
    if (bytes.length % (4 * this.count)) throw new Error(`${this.place}.signals: ${bytes.length} bytes for ${this.count} rows`);
    return this.lazily('signals', Float32Array, bytes.length / 4);
  }
}
