// A page of a program that runs (kte::live_page): shows the states that it sends, and tells it what buttons and sliders say.

import { decode_array } from './scene/base64.js';
import { LiveRecording } from './scene/live_recording.js';
import { loads_of_sample } from './scene/recorded_rates.js';
import { LivePull } from './simulation/live_pull.js';
import { by_id } from './ui/element.js';
import { LivePanel } from './ui/live_panel.js';
import { Viewer } from './viewer.js';

const plots_every = 0.3;   // s between new plots
const try_again_after = 2; // s

export class LiveViewer extends Viewer {
  constructor(scene, say, shown) {
    super(scene, say, shown);
    this.columns = (scene.recordings[0]?.columns ?? []).map(({ name, unit }) => ({ name: String(name), unit: String(unit ?? '1') }));
    this.nq = scene.state.q.length;
    this.nv = scene.state.v.length;
    this.signal_count = this.sources.main?.signals.length ?? 0;
    this.controls = null;
    this.looks_back = false;   // at what was shown, while the program stands still
    this.speed = this.player.speed;
    this.waiting = new Map();  // what is to be sent to a place
    this.simulation = {
      running: false, time: 0, poses: this.sources.tracks.slice(), q: this.sources.q.slice(), v: Float64Array.from(scene.state.v), signals: new Float64Array(this.signal_count),
      advance() {}, loads: (engine) => this.live_loads(engine),
    };
    if (this.picture) {
      this.pull = new LivePull(scene, this.poses, this.picture.stage, {
        move: (request) => this.tell_newest('pull', request), release: () => this.tell_newest('pull', 'release'),
      });
    }
    this.panel = new LivePanel({ run: () => this.run_simulation(), tell: (what) => this.tell(what), move: (i, x) => this.tell_newest(`slider ${i}`, `slider?index=${i}&value=${x}`), pulls: scene.pulls.length > 0 });
    by_id('tab-move').textContent = 'Live';
    by_id('panel-move').setAttribute('aria-label', 'Live');
    this.tabs.open('move');
    this.panel.say('Connecting\u2026');
    this.connect();
  }

  // The program simulates, not the page.
  load_engine() {}

  connect() {
    const source = new EventSource('events');
    source.addEventListener('open', () => this.panel.connected(true));
    source.addEventListener('controls', (event) => this.take_controls(JSON.parse(event.data)));
    source.addEventListener('state', (event) => this.take_state(JSON.parse(event.data)));
    source.addEventListener('end', () => {
      source.close();
      this.stand_still('The program has ended.');
    });
    source.addEventListener('error', () => {
      const refused = source.readyState === EventSource.CLOSED;
      this.stand_still(refused ? 'The program answers, but refuses this page: too many are open, or it has begun anew and printed another address.'
        : 'Connection lost. Trying again\u2026');
      if (refused) setTimeout(() => this.connect(), 1000 * try_again_after);
    });
  }

  stand_still(why) {
    this.panel.connected(false, why);
    this.simulation.running = false;
    this.announcer.say(why);
    this.request();
  }

  // ---- to the program
  async tell(what) {
    if (['run', 'step', 'reset'].includes(what)) this.looks_back = false;
    try {
      const answer = await fetch(what, { method: 'POST' });
      if (!answer.ok) this.panel.say((await answer.text()).slice(0, 300));
    } catch {
      this.panel.say('Connection lost: the program was not told.');
    }
  }

  // Of several requests of one kind, the last is sent when the one before has been answered.
  async tell_newest(kind, request) {
    const busy = this.waiting.has(kind);
    this.waiting.set(kind, request);
    if (busy) return;
    for (let sent; this.waiting.has(kind) && sent !== this.waiting.get(kind);) {
      sent = this.waiting.get(kind);
      await this.tell(sent);
    }
    this.waiting.delete(kind);
  }

  run_simulation() {
    this.tell(this.controls?.paused ? 'run' : 'pause');
  }

  // Of a look back: the program pauses, and what was shown last stays to be scrubbed.
  leave_simulation() {
    if (this.sources.mode === 'simulate' && this.controls && !this.controls.paused) this.tell('pause');
    this.looks_back = this.recording !== undefined;
    this.simulation.running = false;
    this.sources.mode = 'play';
  }

  play() {
    this.run_simulation();
  }

  // ---- from the program
  take_controls(controls) {
    const ran = this.simulation.running;
    if (this.controls?.paused && !controls.paused) this.looks_back = false;
    this.controls = controls;
    this.simulation.running = !controls.paused && this.recording !== undefined && !this.looks_back;
    if (this.simulation.running) this.sources.mode = 'simulate';
    if (ran && !this.simulation.running && !this.looks_back) this.refresh_plots();
    this.show_speed(controls.speed);
    this.panel.update(controls);
    this.request();
  }

  // The choice of the page, unless the program has another.
  show_speed(speed) {
    if (this.waiting.has('speed') || speed === this.player.speed) return;
    this.speed = this.player.speed = speed;
    const select = by_id('speed');
    select.value = String(speed);
    if (select.selectedIndex < 0) {
      select.add(new Option(`${speed}\u00d7`, String(speed)));
      select.value = String(speed);
    }
  }

  take_state({ t, rows, numbers, pull }) {
    const { simulation, scene, nq, nv } = this, poses = 7 * scene.tracks;
    const at = { q: poses, v: poses + nq, signals: poses + nq + nv, columns: poses + nq + nv + this.signal_count };
    const all = decode_array(Float32Array, numbers, at.columns + this.columns.length, 'the state');
    this.panel.rows(rows);
    if (!all.subarray(0, poses + nq).every(Number.isFinite)) {
      this.panel.say(`From t = ${t} s the state is not finite: the mechanism is shown where it was last.`);
      return;
    }
    simulation.time = t;
    simulation.poses = Float64Array.from(all.subarray(0, poses));
    simulation.q = Float64Array.from(all.subarray(at.q, at.v));
    simulation.v = Float64Array.from(all.subarray(at.v, at.signals));
    simulation.signals = Float64Array.from(all.subarray(at.signals, at.columns));
    simulation.pull = pull;
    const begins = this.recording === undefined;
    this.recording ??= new LiveRecording(scene, nq, nv, this.signal_count, this.columns);
    this.recording.add(t, simulation.poses, simulation, pull !== null, all.subarray(at.columns));
    if (begins) this.begin_recording();
    this.panel.time(t);
    if (this.looks_back) return;
    this.sources.mode = 'simulate';
    simulation.running = !(this.controls?.paused ?? true);
    if (!simulation.running) this.refresh_plots();
    this.request();
  }

  pulled({ pull }) {
    const frame = pull ? this.scene.frames.findIndex(({ name }) => name === pull.frame) : -1;
    return frame < 0 ? null : { frame, point: pull.point };
  }

  // What acts in the program's newest state, with what it is pulled by.
  live_loads(engine) {
    const { recording, scene, nv } = this, { q, signals, pull, time } = this.simulation;
    if (pull) engine.pull(pull.frame, pull.point, pull.target, pull.stiffness, pull.damping);
    else engine.pull(null);
    const loads = loads_of_sample(recording, scene.coordinates, nv, recording.count - 1, true, (v, free) => engine.loads(q, v, signals, time, free));
    engine.pull(null);
    return loads;
  }

  begin_recording() {
    this.player.play(false);
    this.sources.recordings = [this.recording];
    this.choice.main = 0;
    this.choice.other = -1;
    this.show_recordings();
    document.body.classList.remove('still');
  }

  refresh_plots() {
    if (!this.recording) return;
    this.plots.main = this.recording;
    this.plots.columns = this.recording.columns;
    this.plots.stale = true;
    this.set_range();
    this.player.seek(this.simulation.time);
  }

  // ---- the clock of the screen
  advance_simulation(elapsed, now) {
    const { player, recording, plots } = this;
    player.start = recording.start;
    player.end = player.time = this.simulation.time;
    this.transport.set_range();
    if (now - (this.last_plots ?? 0) > 1000 * plots_every) {
      this.last_plots = now;
      plots.main = recording;
      plots.columns = recording.columns;
      plots.stale = true;
    }
  }

  tick(now) {
    super.tick(now);
    if (this.player.speed !== this.speed) {
      this.speed = this.player.speed;
      this.tell_newest('speed', `speed?value=${this.speed}`);
    }
  }
}
