// The mechanism of a scene as objects of three.js, moved by poses of its frames.

import { Group, Quaternion, Vector3 } from 'three';
import { add_bodies } from './bodies.js';
import { add_forces } from './forces.js';
import { add_joints } from './joints.js';
import { add_links } from './links.js';
import { add_shapes } from './shapes.js';
import { symbol_size } from './symbol_size.js';
import { add_triads } from './triads.js';

const position = new Vector3(), rotation = new Quaternion(), ones = new Vector3(1, 1, 1);

export class Mechanism {
  // initial: world poses of all frames, 7 numbers each, and the q that they belong to, null if unknown; notes: gets what
  // cannot be drawn
  constructor(scene, materials, initial, initial_q, notes) {
    this.scene = scene;
    this.materials = materials;
    this.initial = initial;
    this.initial_q = initial_q;
    this.unit = symbol_size(scene, initial);  // m
    this.root = new Group();
    this.nodes = new Map();   // frame: its group
    this.layers = new Map();  // name: objects
    this.updates = [];
    add_links(this);
    add_joints(this);
    add_shapes(this, notes);
    add_bodies(this);
    add_forces(this);
    this.update(initial);
  }

  node(frame) {
    let node = this.nodes.get(frame);
    if (!node) {
      node = new Group();
      node.matrixAutoUpdate = false;
      this.nodes.set(frame, node);
      this.root.add(node);
    }
    return node;
  }

  layer(name) {
    if (!this.layers.has(name)) this.layers.set(name, []);
    return this.layers.get(name);
  }

  // An object that moves with a frame.
  add_to_frame(layer, frame, object) {
    this.node(frame).add(object);
    this.layer(layer).push(object);
  }

  // An object in world axes, in a group of its own, so that it can hide itself while its layer is shown.
  add_loose(layer, object) {
    const group = new Group();
    group.add(object);
    this.root.add(group);
    this.layer(layer).push(group);
  }

  on_update(update) {
    this.updates.push(update);
  }

  update(world) {
    for (const [frame, node] of this.nodes) {
      const i = 7 * frame;
      position.set(world[i], world[i + 1], world[i + 2]);
      rotation.set(world[i + 4], world[i + 5], world[i + 6], world[i + 3]);
      node.matrix.compose(position, rotation, ones);
      node.matrixWorldNeedsUpdate = true;
    }
    for (const update of this.updates) update(world);
  }

  show(layer, visible) {
    if (layer === 'frames' && visible && this.layer('frames').length === 0) add_triads(this);  // many, and rarely asked for
    for (const object of this.layer(layer)) object.visible = visible;
  }

  // Every mesh gets the material of one role: a mechanism to compare with.
  paint(role) {
    this.root.traverse((object) => {
      if (object.isMesh) object.material = this.materials.for_mesh(role, object);
    });
  }
}
