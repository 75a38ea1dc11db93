// The page: its clock, its sources of poses, its picture and its panels, and what each tells the others.

import { FramePoses } from './scene/frame_poses.js';
import { Picture } from './picture.js';
import { Player } from './player.js';
import { load_simulation_engine } from './simulation/load.js';
import { Pull } from './simulation/pull.js';
import { Simulation } from './simulation/simulation.js';
import { Sources } from './sources.js';
import { counted, number, shown } from './text.js';
import { Announcer } from './ui/announcer.js';
import { Details } from './ui/details.js';
import { by_id, element } from './ui/element.js';
import { listen_to_keys } from './ui/keys.js';
import { fill_layers, fill_legend, shown_at_first } from './ui/layers.js';
import { Plots } from './ui/plots.js';
import { Pointer } from './ui/pointer.js';
import { RecordingChoice } from './ui/recording_choice.js';
import { SimulationPanel } from './ui/simulation_panel.js';
import { Sliders } from './ui/sliders.js';
import { Tabs } from './ui/tabs.js';
import { Theme } from './ui/theme.js';
import { Transport } from './ui/transport.js';
import { item_of, Tree } from './ui/tree.js';

const plots_every = 0.3;  // s between new plots of a running simulation

export class Viewer {
  // say(text): shows a sentence in place of the 3D view
  constructor(scene, say) {
    this.scene = scene;
    this.notes = scene.notes.map(String);
    this.sources = new Sources(scene);
    this.posed = false;  // by sliders
    this.player = new Player(() => this.request());
    this.announcer = new Announcer();
    this.theme = new Theme((name) => this.set_theme(name));
    this.layers = { ...shown_at_first };
    this.sources.update(this.sources.main?.start ?? 0);
    this.begin_picture(say);
    this.begin_panels();
    this.show_recordings();
    this.listen();
    this.begin_playing();
    this.request();
  }

  // ---- beginning
  begin_picture(say) {
    try {
      this.picture = new Picture(this.scene, this.sources, this.theme.name, this.layers, this.notes, () => this.request());
      this.poses = this.picture.poses;
    } catch (error) {
      this.picture = null;
      this.poses = new FramePoses(this.scene.frames);
      say(`There is no 3D view: ${error.message} Names and plots are beside it.`);
    }
  }

  begin_panels() {
    const { scene } = this;
    this.describe();
    this.transport = new Transport(this.player, { seek: (t) => this.seek(t), play: () => this.play() });
    this.tree = new Tree(scene, { pointed: (row) => this.point_at(row), chosen: (row) => this.choose(row), followed: (row) => this.follow(row.frame) });
    const state = this.picture ?? { followed: -1, trailed: -1, triads: new Map() };
    this.details = new Details(scene, state, this.poses.world, {
      follow: (frame) => this.follow(frame), trail: (frame) => this.trail(frame),
      triad: (frame, on) => { this.picture?.show_triad(frame, on); this.request(); },
    });
    this.plots = new Plots((t) => this.seek(t));
    this.plots.changed = () => this.request();
    this.choice = new RecordingChoice((main, other, wants) => this.choose_recordings(main, other, wants));
    fill_layers(scene, this.layers, (name, on) => { this.picture?.show_layer(name, on); this.show_other(); this.request(); });
    fill_legend(scene, this.theme.name);
    this.fill_notes();
    this.tabs = new Tabs((name) => this.opened(name));
    const moves = this.sources.range()[1] > this.sources.range()[0];
    this.tabs.open(moves || scene.model === null ? 'plots' : 'move');
    if (this.tabs.narrow.matches && !moves && scene.model === null) this.tabs.open('tree');
  }

  begin_playing() {
    const at = /^#t=(-?[\d.]+(?:e-?\d+)?)$/i.exec(window.location.hash);
    if (at) this.player.seek(Number(at[1]));
    else if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.play(true);
  }

  describe() {
    const { scene } = this;
    const title = shown(scene.title ?? '', 200);
    document.title = `${title} \u2013 kte`;
    by_id('title').textContent = title;
    by_id('title').title = title;
    const mass = scene.bodies.reduce((sum, body) => sum + (body.mass ?? 0), 0);
    const facts = [];
    if (scene.joints.length) facts.push(counted(scene.joints.length, 'joint'));
    if (scene.bodies.length) facts.push(counted(scene.bodies.length, 'body', 'bodies'), `${number(mass, 4)} kg`);
    if (scene.frames.length) facts.push(counted(scene.frames.length, 'frame'));
    by_id('summary').textContent = facts.join(' \u00b7 ');
    const view = scene.planar ? 'View of the plane' : '3D view';
    by_id('canvas').setAttribute('aria-label', `${view} of ${title}. W, A, S, D ${scene.planar ? 'move' : 'turn'} it, plus and minus zoom, F shows all.`);
  }

  fill_notes() {
    const notes = by_id('notes');
    const said = this.notes.length ? this.notes : ['All that the scene has is drawn.'];
    notes.replaceChildren(...said.map((note) => element('li', { class: 'name', text: shown(note, 1000) })));
    if (this.notes.length) by_id('tab-notes').textContent = `Notes (${this.notes.length})`;
  }

  listen() {
    const { picture } = this;
    const camera = (act) => (...args) => { if (picture) act(picture.stage.camera, ...args); this.request(); };
    const fit = () => { picture?.fit(); this.request(); };
    const help = () => by_id('help-dialog').showModal();
    const search = () => { if (this.tabs.narrow.matches) this.tabs.open('tree'); else document.body.classList.remove('no-tree'); by_id('search').focus(); };
    by_id('fit').addEventListener('click', fit);
    by_id('theme').addEventListener('click', () => this.theme.toggle());
    by_id('help').addEventListener('click', help);
    for (const [id, name] of [['toggle-frames', 'no-tree'], ['toggle-side', 'no-side']]) {
      by_id(id).addEventListener('click', () => by_id(id).setAttribute('aria-pressed', String(!document.body.classList.toggle(name))));
    }
    listen_to_keys({
      play: () => this.play(), loop: () => this.transport.toggle_loop(), faster: (n) => this.transport.change_speed(n),
      step: (n) => this.scrub(this.sources.step(this.player.time, n)), share: (x) => this.scrub(this.player.time + x * this.player.length),
      first: () => this.scrub(this.player.start), last: () => this.scrub(this.player.end),
      orbit: camera((c, left, up) => c.orbit(left, up)), zoom: camera((c, factor) => c.zoom(factor)),
      fit, help, search, theme: () => this.theme.toggle(),
    });
    if (picture) this.listen_to_pointer(picture);
  }

  listen_to_pointer(picture) {
    const row_of = (hit) => (hit ? { ...hit.object.userData } : null);
    this.pointer = new Pointer(by_id('canvas'), (event) => picture.pick(event), {
      hover: (hit) => { const row = row_of(hit); this.tree.point(row?.kind ?? null, row?.index); this.point_at(row); },
      choose: (hit) => { if (hit) { const of = this.tree_item(hit.object.userData); this.tree.choose_item(of.kind, of.index); } },
      follow: (hit) => this.follow(hit ? hit.object.userData.frame : -1),
      pulls: () => this.sources.mode === 'simulate' && this.simulation?.running,
      grab: (hit) => this.attempt(() => this.pull.grab(hit)) ?? false,
      move: (event) => this.attempt(() => this.pull.move(event)),
      release: () => this.attempt(() => this.pull.release()),
    });
  }

  // Rows of the tree are frames, joints and bodies.
  tree_item(of) {
    return of.kind === 'joint' || of.kind === 'body' ? of : { kind: 'frame', index: of.frame };
  }

  // ---- what is shown
  set_theme(name) {
    this.picture?.set_theme(name);
    if (this.plots) {
      fill_legend(this.scene, name);
      this.plots.theme = name;
      this.plots.stale = true;
      this.request();
    }
  }

  point_at(row) {
    const item = row && item_of(this.scene, row.kind, row.index);
    const frame = row && row.frame >= 0 ? this.scene.frames[row.frame] : null;
    const name = item ? shown(item.name, 60) : frame ? shown(frame.name, 60) : '';
    by_id('pointed').hidden = name === '';
    by_id('pointed').textContent = row ? `${row.kind} ${name}` : '';
    this.picture?.point_at(row);
    this.request();
  }

  choose(row) {
    this.details.show(row);
    this.request();
  }

  follow(frame) {
    this.picture?.follow(frame);
    this.details.show(this.details.row);
    this.announcer.say(frame < 0 ? 'Following nothing' : `Following ${shown(this.scene.frames[frame].name)}`);
    this.request();
  }

  trail(frame) {
    this.picture?.set_trail(frame, this.sources.main);
    this.details.show(this.details.row);
    this.request();
  }

  show_other() {
    this.picture?.show_other(this.sources.other !== null);
  }

  // ---- recordings and time
  show_recordings() {
    this.choice.draw(this.sources.recordings);
    this.choose_recordings(this.choice.main, this.choice.other, this.choice.difference);
  }

  choose_recordings(main, other, wants_difference) {
    const { sources } = this;
    sources.main = sources.recordings[main] ?? null;
    sources.other = other === main ? null : sources.recordings[other] ?? null;
    this.plots.set(sources.main, sources.other, wants_difference, this.theme.name);
    this.show_other();
    if (this.picture && this.picture.trailed >= 0) this.trail(this.picture.trailed);
    this.set_range();
  }

  set_range() {
    const [start, end] = this.sources.range();
    this.player.set_range(start, end);
    document.body.classList.toggle('still', !(end > start) && !this.simulation?.running);
    this.transport.set_range();
  }

  seek(time) {
    this.leave_simulation();
    this.player.seek(time);
    this.announcer.time(this.player);
  }

  // Seeks and stands still there.
  scrub(time) {
    this.player.play(false);
    this.seek(time);
  }

  play() {
    if (this.sources.mode === 'simulate') return this.run_simulation();
    this.leave_simulation();
    this.player.play();
    return this.announcer.time(this.player);
  }

  leave_simulation() {
    if (this.simulation?.running) this.pause_simulation();
    this.sources.mode = 'play';
  }

  // ---- sliders and simulation
  opened(name) {
    if (name === 'move') this.load_engine();
    this.request();
  }

  async load_engine() {
    if (this.engine_asked) return;
    this.engine_asked = true;
    by_id('engine-state').textContent = 'Loading kte\u2026';
    try {
      this.begin_engine(await load_simulation_engine(this.scene));
      by_id('engine-state').textContent = '';
    } catch (error) {
      by_id('engine-state').textContent = `No sliders and no simulation. ${error.message}`;
    }
    this.request();
  }

  begin_engine(engine) {
    this.sources.engine = engine;
    this.simulation = new Simulation(this.scene, engine);
    if (this.picture) this.pull = new Pull(this.scene, this.poses, this.picture.stage, engine);
    this.sliders = new Sliders(this.scene, (q) => this.pose(q));
    const mass = this.scene.bodies.reduce((sum, body) => sum + (body.mass ?? 0), 0) || 1;
    this.simulation_panel = new SimulationPanel(10 * mass * Math.max(1, this.scene.size ** 2), {
      run: () => this.run_simulation(), reset: () => this.reset_simulation(), damp: (c) => this.attempt(() => this.simulation.set_damping(c)),
    });
  }

  // Runs what may throw an error of kte, and says it.
  attempt(action) {
    try {
      by_id('engine-state').textContent = '';
      return action();
    } catch (error) {
      if (this.simulation) this.simulation.running = false;
      by_id('engine-state').textContent = error.message;
      this.tabs.open('move');
      return undefined;
    }
  }

  // The sliders' configuration.
  pose(q) {
    this.player.play(false);
    this.stop_simulation();
    this.sources.mode = 'pose';
    this.sources.q.set(q);
    this.posed = true;
    this.request();
  }

  run_simulation() {
    const { simulation, sources } = this;
    if (simulation.running) return this.pause_simulation();
    this.player.play(false);
    this.attempt(() => {
      if (!simulation.recording) this.start_simulation();
      sources.mode = 'simulate';
      simulation.running = true;
    });
    this.choice.main = sources.recordings.indexOf(this.simulated);
    if (this.choice.other === this.choice.main) this.choice.other = -1;
    this.show_recordings();
    return this.request();
  }

  start_simulation() {
    const { simulation, sources, scene } = this;
    const v = this.posed ? new Float64Array(scene.state.v.length) : Float64Array.from(scene.state.v);
    simulation.start(this.posed ? sources.q : Float64Array.from(scene.state.q), v);
    sources.recordings = [...sources.recordings.filter((recording) => recording !== this.simulated), simulation.recording];
    this.simulated = simulation.recording;
  }

  pause_simulation() {
    this.simulation.running = false;
    this.attempt(() => this.pull?.release());
    this.plots.stale = true;
    this.plots.columns = this.sources.main?.columns ?? [];
    this.set_range();
    this.player.seek(this.simulation.time);
    if (this.picture && this.picture.trailed >= 0) this.trail(this.picture.trailed);
  }

  // The next run begins anew.
  stop_simulation() {
    if (this.simulation.running) this.pause_simulation();
    this.simulation.recording = null;
  }

  reset_simulation() {
    this.player.play(false);
    this.stop_simulation();
    this.sources.mode = 'pose';
    this.sources.q.set(this.scene.state.q);
    this.posed = false;
    this.request();
  }

  // ---- the clock of the screen
  request() {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame((now) => this.tick(now));
  }

  tick(now) {
    this.requested = false;
    const elapsed = Math.min(0.1, this.last_tick ? (now - this.last_tick) / 1000 : 0);
    const { player, simulation, sources } = this;
    if (simulation?.running) this.advance_simulation(elapsed, now);
    else player.advance(elapsed);
    const moving = player.playing || (simulation?.running ?? false);
    this.last_tick = moving ? now : 0;
    if (moving) this.picture?.thrift.tell(elapsed);
    this.attempt_quietly(() => sources.update(player.time, simulation));
    if (this.picture) this.picture.draw(player.time, this.pull);
    else this.poses.update(sources.tracks);
    this.transport.update(moving);
    this.plots.update(player.time);
    if (document.body.dataset.panel === 'move') {
      this.sliders?.update(sources.q);
      this.simulation_panel?.update(simulation);
    }
    this.details.update();
    this.drawn = (this.drawn ?? 0) + 1;  // pictures
    if (this.drawn === 1) performance.mark('kte-first-picture');
    if (moving) this.request();
  }

  advance_simulation(elapsed, now) {
    const { simulation, player, plots } = this;
    this.attempt(() => simulation.advance(elapsed, player.speed));
    player.start = 0;
    player.end = player.time = simulation.time;
    this.transport.set_range();
    if (now - (this.last_plots ?? 0) > 1000 * plots_every) {
      this.last_plots = now;
      plots.columns = simulation.recording.columns;
      plots.main = simulation.recording;
      plots.stale = true;
    }
  }

  attempt_quietly(action) {
    try {
      action();
    } catch (error) {
      by_id('engine-state').textContent = error.message;
    }
  }
}
