// Switches forces as arrows on and off, and keeps loads, arrows, label and panel in step.

import { Loads } from './loads.js';
import { shown } from './text.js';
import { by_id } from './ui/element.js';
import { LoadsPanel, magnitude } from './ui/loads_panel.js';
import { Arrows } from './view/arrows.js';

export class Acting {
  constructor(viewer) {
    this.viewer = viewer;
    this.loads = new Loads(viewer.scene, viewer.sources, (simulation) => viewer.pulled(simulation));
    this.arrows = viewer.picture ? new Arrows(viewer.picture.stage, viewer.picture.mechanism.unit) : null;
    this.why = '';        // there is no engine
    this.pointed = null;  // item
    this.label = by_id('load-label');
    this.panel = new LoadsPanel(this.loads, {
      switch_on: (on) => this.show(on), choose: (group, on) => this.choose(group, on), rescale: (factor) => this.rescale(factor), point: (item) => this.point(item), later: () => viewer.request(),
    });
  }

  get on() { return this.loads.on; }

  show(on) {
    const { loads, panel, viewer } = this;
    loads.on = on && loads.items.length > 0;
    panel.show(loads.on);
    viewer.announcer.say(loads.items.length === 0 ? 'There are no forces to show' : on ? 'Forces are shown' : 'Forces are not shown');
    if (!loads.on) this.point(null);
    else this.load();
    this.changed();
  }

  // The engine, without which only weights are known.
  async load() {
    if (this.loads.engine || this.asked) return;
    this.asked = true;
    this.why = 'Loading kte\u2026';
    try {
      this.loads.engine = await this.viewer.simulating.engine();
      this.why = '';
    } catch (error) {
      this.why = `Only the weight of bodies is shown. ${error.message}`;
    }
    this.changed();
  }

  choose(group, on) {
    this.loads.groups[group] = on;
    this.panel.fill();
    this.changed();
  }

  rescale(factor) {
    this.loads.scale = factor;
    this.loads.stale = true;
    this.viewer.request();
  }

  // Recordings or groups are others now.
  changed() {
    this.loads.begin_anew();
    this.loads.stale = true;
    this.viewer.request();
  }

  point(item) {
    this.pointed = item;
    if (this.arrows) this.arrows.pointed = item;
    this.viewer.request();
  }

  item_of(index) { return this.loads.items[index] ?? null; }

  // At each picture, before it is drawn; world: poses of all frames.
  update(now, time, simulation, world) {
    const { loads, arrows, panel } = this;
    if (!loads.on && !this.was_on) return;
    this.was_on = loads.on;
    let failed = '';
    try {
      loads.update(now, time, simulation, world);
    } catch (error) {
      failed = error.message;
    }
    arrows?.update(loads);
    panel.update(now, failed || this.why);
    this.place_label();
  }

  place_label() {
    const { loads, arrows, label } = this;
    const arrow = this.pointed && loads.arrows.find(({ item }) => item === this.pointed);
    label.hidden = !arrow || !arrows;
    if (label.hidden) return;
    const text = `${shown(this.pointed.name, 80)}: ${magnitude(arrow, loads)}`;
    if (label.textContent !== text) label.textContent = text;
    const { stage } = this.viewer.picture;
    const at = stage.project(...arrows.label_place(arrow, loads), {});
    const x = Math.min(Math.max(at.x, 8), Math.max(8, stage.width - label.offsetWidth - 16)), y = Math.min(Math.max(at.y, 16), stage.height - 16);
    label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  }
}
