// Sliders and simulation by kte in the page: loads the engine, poses, runs, pauses, resets.

import { load_simulation_engine } from './simulation/load.js';
import { Pull } from './simulation/pull.js';
import { Simulation } from './simulation/simulation.js';
import { by_id } from './ui/element.js';
import { SimulationPanel } from './ui/simulation_panel.js';
import { Sliders } from './ui/sliders.js';

const plots_every = 0.3;  // s between new plots of a running simulation

export class Simulating {
  constructor(viewer) {
    this.viewer = viewer;
    this.scene = viewer.scene;
    this.simulation = null;
    this.pull = null;
    this.posed = false;  // by sliders
    this.recording = null;
    this.plotted = 0;
  }

  get running() { return this.simulation?.running ?? false; }

  // Loads the engine, once.
  async load() {
    if (this.asked) return;
    this.asked = true;
    by_id('engine-state').textContent = 'Loading kte\u2026';
    try {
      this.begin(await this.engine());
      by_id('engine-state').textContent = '';
    } catch (error) {
      by_id('engine-state').textContent = `No sliders and no simulation. ${error.message}`;
    }
    this.viewer.request();
  }

  // The engine with the scene's model, loaded once; throws an Error with a sentence for the user.
  engine() {
    this.loading ??= load_simulation_engine(this.scene).then((engine) => {
      this.viewer.sources.engine = engine;
      return engine;
    });
    return this.loading;
  }

  begin(engine) {
    const { scene, viewer } = this;
    this.simulation = new Simulation(scene, engine);
    if (viewer.picture) {
      this.pull = new Pull(scene, viewer.poses, viewer.picture.stage, engine);
      this.simulation.pulled = () => this.pull.active;
    }
    this.sliders = new Sliders(scene, (q) => this.pose(q));
    const mass = scene.bodies.reduce((sum, body) => sum + (body.mass ?? 0), 0) || 1;
    this.panel = new SimulationPanel(10 * mass * Math.max(1, scene.size ** 2), {
      run: () => this.run(), reset: () => this.reset(), damp: (c) => this.attempt(() => this.simulation.set_damping(c)),
    });
  }

  // Does what may throw an error of kte, and says it.
  attempt(action) {
    try {
      by_id('engine-state').textContent = '';
      return action();
    } catch (error) {
      if (this.simulation) this.simulation.running = false;
      by_id('engine-state').textContent = error.message;
      this.viewer.tabs.open('move');
      return undefined;
    }
  }

  // The same at each picture: the panel stays as it is.
  attempt_quietly(action) {
    try {
      action();
    } catch (error) {
      by_id('engine-state').textContent = error.message;
    }
  }

  // The sliders' configuration.
  pose(q) {
    this.viewer.player.play(false);
    this.stop();
    this.viewer.sources.pose(q);
    this.posed = true;
    this.viewer.request();
  }

  run() {
    const { simulation, viewer } = this, { sources, choice } = viewer;
    if (simulation.running) return this.pause();
    viewer.player.play(false);
    this.attempt(() => {
      if (!simulation.recording) this.start();
      sources.mode = 'simulate';
      simulation.running = true;
    });
    choice.main = Math.max(0, sources.recordings.indexOf(this.recording));
    if (choice.other === choice.main) choice.other = -1;
    viewer.show_recordings();
    return viewer.request();
  }

  start() {
    const { simulation, scene, posed } = this, { sources } = this.viewer;
    const v = posed ? new Float64Array(scene.state.v.length) : Float64Array.from(scene.state.v);
    simulation.start(posed ? sources.q : Float64Array.from(scene.state.q), v);
    sources.recordings = [...sources.recordings.filter((recording) => recording !== this.recording), simulation.recording];
    this.recording = simulation.recording;
  }

  pause() {
    const { viewer, simulation } = this, { picture, plots, sources } = viewer;
    simulation.running = false;
    this.attempt(() => this.pull?.release());
    plots.renew(sources.main);
    viewer.set_range();
    viewer.player.seek(simulation.time);
    if (picture && picture.trailed >= 0) viewer.trail(picture.trailed);
  }

  // The next run begins anew.
  stop() {
    if (this.running) this.pause();
    this.simulation.recording = null;
  }

  reset() {
    this.viewer.player.play(false);
    this.stop();
    this.viewer.sources.pose(this.scene.state.q);
    this.posed = false;
    this.viewer.request();
  }

  // At each picture while it runs: `elapsed` s of the clock.
  advance(elapsed, now) {
    const { simulation } = this, { player, plots, transport } = this.viewer;
    this.attempt(() => simulation.advance(elapsed, player.speed));
    player.start = 0;
    player.end = player.time = simulation.time;
    transport.set_range();
    if (now - this.plotted > 1000 * plots_every) {
      this.plotted = now;
      plots.renew(simulation.recording);
    }
  }

  update(q) {
    this.sliders?.update(q);
    this.panel?.update(this.simulation);
  }
}
