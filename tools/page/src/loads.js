// Forces and torques as arrows: what acts at each instant, by the engine, and how long its arrows are.

import { element_key, load_items, loads_between, loads_by_key, rotated } from './scene/load_items.js';
import { loads_of_sample } from './scene/recorded_rates.js';

const longest = 0.35, widest = 0.14;  // of the mechanism's size: the arrow of a typical large force, the arc of such a torque
const instants = 24;                  // at which it is looked for
const share = 0.9;                    // of instants with less than that
const half_life = 6;                  // s, in which it is forgotten while a simulation runs
const nothing = 1e-6;                 // of it: not drawn

const size_of = ([x, y, z]) => Math.hypot(x, y, z);

export class Loads {
  // pulled(simulation): {frame, point} of what is pulled now, or null
  constructor(scene, sources, pulled) {
    this.scene = scene;
    this.sources = sources;
    this.pulled = pulled;
    this.pull = { group: 'pull', kind: 'pull', index: 0, name: 'pull', frame: -1, point: [0, 0, 0] };
    this.items = load_items(scene);
    if (this.items.length) this.items.push(this.pull);
    this.on = false;
    this.groups = { weights: true, elements: true, reactions: false };
    this.scale = 1;
    this.engine = null;
    this.kept = [];        // of the two samples last looked at: {recording, i, loads}
    this.reference = null; // {force, torque}: those of the longest arrows
    this.arrows = [];      // {item, point, force, torque}
    this.unknown = [];     // items
  }

  get shown_items() { return this.items.filter((item) => this.groups[item.group]); }

  // Loads by key at the time of the player, and what is in doubt.
  at(time, simulation) {
    const { engine, sources } = this;
    if (!engine) return { loads: new Map(), doubt: '' };
    if (sources.mode === 'simulate') {
      const { acting, doubt } = simulation.loads(engine);
      return { loads: loads_by_key(acting), doubt };
    }
    if (sources.mode === 'pose' || !sources.main) return { loads: loads_by_key(engine.loads(sources.q)), doubt: '' };
    const recording = sources.main, i = recording.index_at(time), f = recording.fraction(time, i);
    if (!recording.q) return { loads: new Map(), doubt: 'no velocities' };
    const first = this.of_sample(recording, i), next = f > 0 ? this.of_sample(recording, i + 1) : first;
    return { loads: loads_between(first.loads, next.loads, f), doubt: first.doubt || next.doubt };
  }

  of_sample(recording, i) {
    const known = this.kept.find((one) => one.recording === recording && one.i === i && one.t === recording.t[i]);
    if (known) return known;
    const { coordinates, state } = this.scene, { t, q, signals, free } = recording.state_of(i);
    const { acting, doubt } = loads_of_sample(recording, coordinates, state.v.length, i, free, (v, alone) => this.engine.loads(q, v, signals, t, alone));
    this.kept = [...this.kept.slice(-1), { recording, i, t, loads: loads_by_key(acting), doubt }];
    return this.kept.at(-1);
  }

  // now: ms of the clock of the screen; world: poses of all frames at that time.
  update(now, time, simulation, world) {
    this.arrows = [];
    this.unknown = [];
    if (!this.on) return;
    const { loads, doubt } = this.at(time, simulation);
    this.doubt = doubt;
    for (const item of this.shown_items) {
      const { force, torque } = item.read(loads, world);
      if (![...force, ...torque].every(Number.isFinite)) {
        this.unknown.push(item);
        continue;
      }
      const at = rotated(world, 7 * item.frame, item.point);
      this.arrows.push({ item, point: at.map((x, n) => x + world[7 * item.frame + n]), force, torque });
    }
    this.take_pull(loads, simulation, world);
    this.reference ??= this.find_reference();
    if (this.sources.mode !== 'play') this.adapt(now);
  }

  // Of a simulation nobody knows what is to come: the longest arrows stand for the largest forces of late.
  adapt(now) {
    const kept = 2 ** (-Math.max(0, now - (this.adapted ?? now)) / 1000 / half_life);
    this.adapted = now;
    for (const what of ['force', 'torque']) {
      const largest = this.arrows.reduce((most, arrow) => Math.max(most, size_of(arrow[what])), 0);
      this.reference[what] = Math.max(largest, kept * this.reference[what]);
    }
  }

  // It acts at its point, and is the element after those of the model.
  take_pull(loads, simulation, world) {
    const hand = this.engine && this.groups.elements && this.sources.mode === 'simulate' ? this.pulled(simulation) : null;
    if (!hand) return;
    this.elements ??= JSON.parse(this.scene.model).kte_model.elements.length;
    const load = loads.get(element_key(this.elements, 'frame', 0));
    if (!load) return;
    const at = rotated(world, 7 * hand.frame, hand.point);
    Object.assign(this.pull, { frame: hand.frame, name: `pull on ${this.scene.frames[hand.frame].name}` });
    this.arrows.push({ item: this.pull, point: at.map((x, n) => x + world[7 * hand.frame + n]), force: load.force, torque: [0, 0, 0] });
  }

  // What the longest arrows stand for, which stays while the mechanism moves.
  find_reference() {
    const { sources } = this, recording = sources.mode === 'play' && this.engine ? sources.main : null;
    const most = { force: [], torque: [] };
    const take = (what) => {
      const large = { force: 0, torque: 0 };
      for (const each of what) for (const name of ['force', 'torque']) if (Number.isFinite(each[name][0])) large[name] = Math.max(large[name], size_of(each[name]));
      for (const name of ['force', 'torque']) if (large[name] > 0) most[name].push(large[name]);
    };
    take(this.arrows);
    if (recording?.q) {
      const constant = this.shown_items.filter((item) => item.group === 'weights').map((item) => item.read());
      const wanted = new Set(this.groups.elements ? this.items.filter((item) => item.group === 'elements').map((item) => this.scene.forces[item.index].element) : []);
      for (let k = 0; k < instants; ++k) {
        const { loads } = this.of_sample(recording, Math.floor((k * (recording.count - 1)) / instants));
        take([...constant, ...[...loads].filter(([key]) => (key.startsWith('reaction') ? this.groups.reactions : wanted.has(Number(key.split(' ')[0])))).map(([, load]) => load)]);
      }
    }
    const typical = (all) => all.sort((a, b) => a - b)[Math.min(all.length - 1, Math.floor(share * all.length))] ?? 0;
    return { force: typical(most.force), torque: typical(most.torque) };
  }

  // m of an arrow of 1 N, of the radius of an arc of 1 N m
  get metres() {
    const { force, torque } = this.reference ?? { force: 0, torque: 0 }, size = this.scale * this.scene.size;
    return { force: force > 0 ? (longest * size) / force : 0, torque: torque > 0 ? (widest * size) / torque : 0 };
  }

  is_seen(load, what) {
    return size_of(load) > nothing * (this.reference?.[what] ?? 0) && size_of(load) > 0;
  }

  // What has changed: groups, recordings.
  begin_anew() {
    this.reference = null;
    this.kept = [];
  }
}
