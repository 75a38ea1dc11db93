// The path of one frame through a recording: faint as a whole, strong up to now.

import { Group } from 'three';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { palettes } from './palette.js';

const most_points = 4000;

export class Trail {
  constructor(stage) {
    this.stage = stage;
    this.object = new Group();
    this.whole = new LineMaterial({ linewidth: 1.5, transparent: true, opacity: 0.35 });
    this.passed = new LineMaterial({ linewidth: 2.5 });
    this.set_theme(stage.theme);
    stage.world.add(this.object);
    this.lines = [];
  }

  set_theme(theme) {
    for (const material of [this.whole, this.passed]) material.color.setHex(palettes[theme].trail);
  }

  clear() {
    for (const line of this.lines) line.geometry.dispose();
    this.object.clear();
    this.lines = [];
  }

  // Of `frame`, whose poses the FramePoses `poses` has from those of the recording's tracks.
  set(recording, frame, poses) {
    this.clear();
    if (!recording || recording.count < 2) return;
    const every = Math.ceil(recording.count / most_points);
    const tracks = new Float64Array(7 * recording.tracks);
    this.times = [];
    const points = [];
    for (let i = 0; i < recording.count; i += every) {
      recording.poses_at(recording.t[i], tracks);
      poses.update(tracks);
      points.push(poses.world[7 * frame], poses.world[7 * frame + 1], poses.world[7 * frame + 2]);
      this.times.push(recording.t[i]);
    }
    if (this.times.length < 2) return;
    for (const material of [this.whole, this.passed]) {
      const line = new Line2(new LineGeometry().setPositions(points), material);
      line.raycast = () => {};
      line.frustumCulled = false;
      this.lines.push(line);
      this.object.add(line);
    }
  }

  update(time) {
    if (this.lines.length < 2) return;
    let low = 0, high = this.times.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle;
    }
    this.lines[1].geometry.instanceCount = low;
    this.lines[1].visible = low > 0;
  }
}
