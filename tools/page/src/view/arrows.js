// Forces as straight arrows from where they act, torques as arcs about their axes.

import { Group, MeshBasicMaterial, Quaternion, Vector3 } from 'three';
import { palettes } from './palette.js';
import { part } from './part.js';
import { arc, cone, rod } from './solids.js';

const z = new Vector3(0, 0, 1), direction = new Vector3(), turn = new Quaternion();
const roles = { weights: 'weight', elements: 'load', reactions: 'reaction', pull: 'pull' };

export class Arrows {
  constructor(stage, unit) {
    this.unit = unit;
    this.root = new Group();
    this.drawn = new Map();  // item: its pieces
    this.materials = {};
    for (const role of [...Object.values(roles), 'highlight']) {
      // over all else
      this.materials[role] = new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true });
    }
    this.set_theme(stage.theme);
    this.pointed = null;  // item
    stage.world.add(this.root);
  }

  set_theme(theme) {
    for (const [role, material] of Object.entries(this.materials)) material.color.setHex(palettes[theme][role]);
  }

  pieces(item, index) {
    let pieces = this.drawn.get(item);
    if (!pieces) {
      const of = { kind: 'load', index, frame: item.frame };
      const make = (geometry) => {
        const mesh = part(geometry, this.materials[roles[item.group]], of);
        mesh.renderOrder = 10;
        mesh.castShadow = false;
        return mesh;
      };
      pieces = { straight: new Group(), shaft: make(rod()), head: make(cone()), round: new Group(), arc: make(arc()), tip: make(cone()) };
      pieces.straight.add(pieces.shaft, pieces.head);
      // at the end of three quarters of a turn, along it
      pieces.tip.position.set(0, -1, 0);
      pieces.tip.quaternion.setFromUnitVectors(z, direction.set(1, 0, 0));
      pieces.round.add(pieces.arc, pieces.tip);
      pieces.straight.visible = pieces.round.visible = false;
      this.root.add(pieces.straight, pieces.round);
      this.drawn.set(item, pieces);
    }
    return pieces;
  }

  // loads: as Loads has them after an update
  update(loads) {
    this.root.visible = loads.on;
    for (const { straight, round } of this.drawn.values()) straight.visible = round.visible = false;
    if (!loads.on) return;
    const metres = loads.metres;
    for (const { item, point, force, torque } of loads.arrows) {
      const pieces = this.pieces(item, loads.items.indexOf(item));
      if (loads.is_seen(force, 'force')) this.place_straight(pieces, point, force, metres.force);
      if (loads.is_seen(torque, 'torque')) this.place_round(pieces, point, torque, metres.torque);
      const material = item === this.pointed ? this.materials.highlight : this.materials[roles[item.group]];
      for (const mesh of [pieces.shaft, pieces.head, pieces.arc, pieces.tip]) mesh.material = material;
    }
  }

  place_straight({ straight, shaft, head }, point, force, metres) {
    const size = Math.hypot(...force), length = metres * size, tall = Math.min(1.2 * this.unit, 0.5 * length);
    straight.visible = true;
    straight.position.set(...point);
    straight.quaternion.copy(turn.setFromUnitVectors(z, direction.set(...force).divideScalar(size)));
    const thick = Math.min(0.15 * this.unit, 0.1 * length);
    shaft.scale.set(thick, thick, Math.max(length - tall, 1e-12));
    head.position.z = length - tall;
    head.scale.set(2.8 * thick, 2.8 * thick, tall);
  }

  place_round({ round, tip }, point, torque, metres) {
    const size = Math.hypot(...torque);
    round.visible = true;
    round.position.set(...point);
    round.quaternion.copy(turn.setFromUnitVectors(z, direction.set(...torque).divideScalar(size)));
    round.scale.setScalar(metres * size);
    tip.scale.set(0.2, 0.2, 0.5);
  }

  // Where a label of an arrow stands, in the world.
  label_place({ point, force, torque }, loads) {
    const metres = loads.metres, size = Math.hypot(...force);
    if (size > 0) return point.map((x, n) => x + metres.force * force[n]);
    return point.map((x, n) => x + 0.5 * metres.torque * torque[n]);
  }
}
