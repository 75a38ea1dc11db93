// The 3D view: mechanism, the one it is compared with, trail, labels, highlight, follower.

import { FramePoses } from './scene/frame_poses.js';
import { number } from './text.js';
import { by_id } from './ui/element.js';
import { motion_bounds } from './view/bounds.js';
import { Highlight } from './view/highlight.js';
import { Labels } from './view/labels.js';
import { Materials } from './view/materials.js';
import { Mechanism } from './view/mechanism.js';
import { PullLine } from './view/pull_line.js';
import { Stage } from './view/stage.js';
import { Thrift } from './view/thrift.js';
import { Trail } from './view/trail.js';
import { triad } from './view/triads.js';

const ends = [new Float64Array(3), new Float64Array(3)];

export class Picture {
  // Throws where the browser offers no WebGL. layers: name: shown
  constructor(scene, sources, theme, layers, notes, changed) {
    this.scene = scene;
    this.sources = sources;
    this.layers = layers;
    this.poses = new FramePoses(scene.frames);
    this.other_poses = new FramePoses(scene.frames);
    this.spare_poses = new FramePoses(scene.frames);
    this.stage = new Stage(by_id('canvas'), scene.up, scene.planar, theme, changed);
    this.thrift = new Thrift(this.stage);
    this.materials = new Materials(theme);
    this.poses.update(sources.tracks);
    this.mechanism = new Mechanism(scene, this.materials, this.poses.world.slice(), sources.known_q(), notes);
    this.stage.world.add(this.mechanism.root);
    this.highlight = new Highlight(this.mechanism);
    this.labels = new Labels(by_id('labels'), this.stage);
    this.trail = new Trail(this.stage);
    this.pull_line = new PullLine(this.stage, this.materials, this.mechanism.unit);
    this.followed = this.trailed = -1;  // frames
    this.last = null;                   // where the one followed was
    this.triads = new Map();
    this.pointed = null;  // row of the tree
    for (const [name, shown] of Object.entries(layers)) this.show_layer(name, shown);
    this.stage.resize();
    const bounds = this.find_bounds();
    this.stage.furnish(bounds);
    this.set_theme(theme);
    this.stage.camera.fit(bounds);
    by_id('scale').textContent = `grid ${number(this.stage.grid.cell)} m`;
    new ResizeObserver(changed).observe(by_id('view'));
    by_id('canvas').addEventListener('webglcontextrestored', changed);
  }

  // Of what is shown, now and in the recordings.
  find_bounds() {
    const poses = this.spare_poses;
    return motion_bounds(this.mechanism, (times, use) => {
      use(this.poses.world);
      this.sources.visit(times, (tracks) => {
        poses.update(tracks);
        use(poses.world);
      });
    });
  }

  // from: as Camera.fit has it
  fit(from) {
    this.stage.camera.fit(this.find_bounds(), from);
  }

  // What is drawn as a PNG file.
  save(name) {
    this.stage.render();
    by_id('canvas').toBlob((blob) => {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(blob);
      link.download = `${name.replace(/[^\p{L}\p{N} _-]/gu, '').trim().slice(0, 60) || 'mechanism'}.png`;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  }

  set_theme(theme) {
    this.stage.set_theme(theme);
    this.materials.set_theme(theme);
    this.trail.set_theme(theme);
  }

  show_layer(name, shown) {
    this.layers[name] = shown;
    if (name === 'labels') this.labels.set(shown ? this.scene.frames.map((frame, i) => [i, frame.name]) : []);
    else this.mechanism.show(name, shown);
  }

  show_triad(frame, shown) {
    if (shown && !this.triads.has(frame)) {
      const object = triad(1.3 * this.mechanism.unit, frame);
      this.triads.set(frame, object);
      this.mechanism.node(frame).add(object);
    }
    if (!shown && this.triads.has(frame)) {
      this.triads.get(frame).removeFromParent();
      this.triads.delete(frame);
    }
  }

  // A row of the tree in another colour, and the axes of its frame; null for none.
  point_at(row) {
    if (row?.kind === this.pointed?.kind && row?.index === this.pointed?.index) return;
    this.pointed = row;
    this.pointer_triad?.removeFromParent();
    this.pointer_triad = null;
    if (row && row.frame >= 0) {
      this.pointer_triad = triad(1.3 * this.mechanism.unit, row.frame);
      this.pointer_triad.traverse((object) => { object.raycast = () => {}; });
      this.mechanism.node(row.frame).add(this.pointer_triad);
    }
    this.highlight.set(row && ((of) => (row.kind === 'frame' ? of.frame === row.index && of.kind !== 'frame' && of.kind !== 'joint' : of.kind === row.kind && of.index === row.index)));
  }

  follow(frame) {
    this.followed = frame;
    this.last = frame < 0 ? null : [...this.poses.world.subarray(7 * frame, 7 * frame + 3)];
  }

  set_trail(frame, recording) {
    this.trailed = frame;
    if (frame < 0) this.trail.clear();
    else this.trail.set(recording, frame, this.spare_poses);
  }

  // The mechanism of the recording that is compared with.
  show_other(shown) {
    if (shown && !this.ghost) {
      this.ghost = new Mechanism(this.scene, this.materials, this.mechanism.initial, this.mechanism.initial_q, []);
      this.ghost.paint('ghost');
      for (const layer of ['ranges', 'frames', 'collision']) this.ghost.show(layer, false);
      this.ghost.root.traverse((object) => { object.castShadow = false; });
      this.stage.world.add(this.ghost.root);
    }
    if (this.ghost) {
      this.ghost.root.visible = shown;
      for (const layer of ['visual', 'links', 'joints', 'bodies', 'shaped bodies', 'forces']) this.ghost.show(layer, this.layers[layer]);
    }
  }

  // What of the mechanism is under the pointer.
  pick(event) {
    return this.stage.pick(event, this.mechanism.root);
  }

  draw(time, pull) {
    this.stage.resize();
    this.poses.update(this.sources.tracks);
    this.mechanism.update(this.poses.world);
    if (this.ghost?.root.visible) {
      this.other_poses.update(this.sources.other_tracks);
      this.ghost.update(this.other_poses.world);
    }
    this.shift_camera();
    this.trail.update(time);
    if (pull?.active) this.pull_line.show(pull.from(ends[0]), pull.target.toArray(ends[1]));
    else this.pull_line.hide();
    this.stage.render();
    this.labels.update(this.poses.world);
  }

  shift_camera() {
    if (this.followed < 0) return;
    const w = this.poses.world, i = 7 * this.followed;
    const now = this.last;
    const moved = now[0] !== w[i] || now[1] !== w[i + 1] || now[2] !== w[i + 2];
    if (moved) this.stage.camera.shift(w[i] - now[0], w[i + 1] - now[1], w[i + 2] - now[2]);
    for (let n = 0; n < 3; ++n) now[n] = w[i + n];
  }
}
