// The page: its clock, its sources of poses, its picture and its panels, and what each tells the others.

import { Acting } from './acting.js';
import { listen } from './actions.js';
import { Picture } from './picture.js';
import { Player } from './player.js';
import { FramePoses } from './scene/frame_poses.js';
import { Simulating } from './simulating.js';
import { Sources } from './sources.js';
import { shown } from './text.js';
import { Announcer } from './ui/announcer.js';
import { Details } from './ui/details.js';
import { by_id } from './ui/element.js';
import { fill_heading, fill_notes } from './ui/heading.js';
import { fill_layers, fill_legend, shown_at_first } from './ui/layers.js';
import { Plots } from './ui/plots.js';
import { RecordingChoice } from './ui/recording_choice.js';
import { Tabs } from './ui/tabs.js';
import { Theme } from './ui/theme.js';
import { Transport } from './ui/transport.js';
import { item_of, Tree } from './ui/tree.js';

export class Viewer {
  // say(text): shows a sentence in place of the 3D view; shown(): the first picture is there
  constructor(scene, say, shown) {
    this.scene = scene;
    this.shown = shown;
    this.notes = scene.notes.map(String);
    this.sources = new Sources(scene);
    this.player = new Player(() => this.request());
    this.announcer = new Announcer();
    this.theme = new Theme((name) => this.set_theme(name));
    this.layers = { ...shown_at_first };
    this.sources.update(this.sources.main?.start ?? 0);
    this.begin_picture(say);
    this.simulating = new Simulating(this);
    this.acting = new Acting(this);
    this.begin_panels();
    this.show_recordings();
    listen(this);
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
    fill_heading(scene);
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
    fill_notes(this.notes);
    this.tabs = new Tabs((name) => {
      if (name === 'move') this.load_engine();
      this.request();
    });
    const moves = this.sources.range()[1] > this.sources.range()[0];
    this.tabs.open(moves || scene.model === null ? 'plots' : 'move');
    if (this.tabs.narrow.matches && !moves && scene.model === null) this.tabs.open('tree');
  }

  begin_playing() {
    const at = /^#t=(-?[\d.]+(?:e-?\d+)?)$/i.exec(window.location.hash);
    if (at) this.player.seek(Number(at[1]));
    else if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.play(true);
  }

  // ---- what is shown
  set_theme(name) {
    this.picture?.set_theme(name);
    this.acting?.arrows?.set_theme(name);
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
    this.acting.changed();
    if (this.picture && this.picture.trailed >= 0) this.trail(this.picture.trailed);
    this.set_range();
  }

  set_range() {
    const [start, end] = this.sources.range();
    this.player.set_range(start, end);
    document.body.classList.toggle('still', !(end > start) && !this.simulating.running);
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
    if (this.simulating.running) this.simulating.pause();
    this.sources.mode = 'play';
  }

  // ---- what simulates: {running, time, poses, q}, and how bodies are pulled
  get simulation() { return this.simulating.simulation; }
  set simulation(simulation) { this.simulating.simulation = simulation; }
  get pull() { return this.simulating.pull; }
  set pull(pull) { this.simulating.pull = pull; }

  pulled() { return this.pull?.active ? this.pull : null; }
  load_engine() { this.simulating.load(); }
  run_simulation() { return this.simulating.run(); }
  advance_simulation(elapsed, now) { this.simulating.advance(elapsed, now); }

  // ---- the clock of the screen
  request() {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame((now) => this.tick(now));
  }

  tick(now) {
    this.requested = false;
    const elapsed = Math.min(0.5, this.last_tick ? (now - this.last_tick) / 1000 : 0);
    const { player, simulating, sources } = this;
    if (simulating.running) this.advance_simulation(elapsed, now);
    else player.advance(elapsed);
    const moving = player.playing || simulating.running;
    this.last_tick = moving ? now : 0;
    if (moving) this.picture?.thrift.tell(elapsed);
    simulating.attempt_quietly(() => sources.update(player.time, simulating.simulation));
    this.poses.update(sources.tracks);
    this.acting.update(now, player.time, simulating.simulation, this.poses.world);
    this.picture?.draw(player.time, simulating.pull);
    this.transport.update(moving);
    this.plots.update(player.time);
    if (document.body.dataset.panel === 'move') simulating.update(sources.q);
    this.details.update();
    this.drawn = (this.drawn ?? 0) + 1;  // pictures
    if (this.drawn === 1) this.tell_first_picture();
    if (moving) this.request();
  }

  async tell_first_picture() {
    await this.picture?.stage.finished();
    performance.mark('kte-first-picture');
    this.shown();
  }
}
