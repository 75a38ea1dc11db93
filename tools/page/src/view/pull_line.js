// The spring by which the pointer pulls a body.

import { Group } from 'three';
import { part, span } from './part.js';
import { rod, sphere } from './solids.js';

export class PullLine {
  constructor(stage, materials, unit) {
    this.unit = unit;
    const of = { kind: 'pull', index: 0, frame: -1 };
    this.rod = part(rod(), materials.of('pull'), of);
    this.hand = part(sphere(), materials.of('pull'), of, 0.35 * unit);
    this.object = new Group();
    this.object.add(this.rod, this.hand);
    this.object.visible = false;
    stage.world.add(this.object);
  }

  show(from, to) {
    this.object.visible = true;
    span(this.rod, ...from, ...to, 0.1 * this.unit);
    this.hand.position.set(...to);
  }

  hide() {
    this.object.visible = false;
  }
}
