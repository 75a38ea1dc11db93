// The panel of plots: a list of columns to choose from, and a plot for each unit of those that are chosen.

import { difference, merged_times, resampled } from '../scene/resample.js';
import { shown } from '../text.js';
import { by_id, element } from './element.js';
import { Plot } from './plot.js';
import { series_colour } from './plot_colours.js';

const most_at_first = 3, most_asked_for = 20, most_in_list = 2000;

export class Plots {
  constructor(seek) {
    this.seek = seek;
    this.plots = [];
    this.chosen = [];  // names of columns
    this.span = 0;     // s that are seen; 0 for all
    this.from = 0;     // s
    this.time = 0;     // the present one, s
    this.container = by_id('plots');
    by_id('column-search').addEventListener('input', () => this.list());
    new ResizeObserver(() => {
      for (const plot of this.plots) plot.resize(this.container.clientWidth);
    }).observe(this.container);
  }

  // The recordings to plot: `other` may be null.
  set(main, other, wants_difference, theme) {
    const first = !this.main;
    Object.assign(this, { main, other, wants_difference, theme });
    this.columns = main ? main.columns : [];
    if (first) {
      const unit = this.columns[0]?.unit;
      const of_one_unit = this.columns.filter((column) => column.unit === unit).slice(0, most_at_first).map((column) => column.name);
      this.chosen = main?.plotted?.length ? main.plotted.slice(0, most_asked_for) : of_one_unit;
    }
    by_id('columns').hidden = this.columns.length === 0;
    this.list();
    this.stale = true;
  }

  // A recording that has grown.
  renew(recording) {
    this.main = recording;
    this.columns = recording?.columns ?? [];
    this.stale = true;
  }

  list() {
    const query = by_id('column-search').value.trim().toLowerCase();
    const found = this.columns.filter((column) => column.name.toLowerCase().includes(query));
    const rows = found.slice(0, most_in_list).map((column) => {
      const box = element('input', { type: 'checkbox', checked: this.chosen.includes(column.name) });
      box.addEventListener('change', () => {
        this.chosen = box.checked ? [...this.chosen, column.name] : this.chosen.filter((name) => name !== column.name);
        this.stale = true;
        this.changed();
      });
      return element('label', { class: 'check' }, box, element('span', { class: 'name', text: shown(column.name), title: shown(column.name, 400) }),
        element('span', { class: 'kind', text: column.unit === '1' ? '' : shown(column.unit, 20) }));
    });
    if (found.length > most_in_list) rows.push(element('p', { class: 'hint', text: `and ${found.length - most_in_list} more: search for a name` }));
    by_id('column-list').replaceChildren(...rows);
  }

  // Draws what is chosen anew; when the panel is open only.
  rebuild() {
    this.stale = false;
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    this.container.replaceChildren();
    if (this.columns.length === 0) {
      this.container.append(element('p', { class: 'hint', text: 'Nothing was recorded that can be plotted.' }));
      return;
    }
    const { main, other } = this;
    const times = other ? merged_times(main.t.subarray(0, main.count), other.t.subarray(0, other.count)) : main.t.subarray(0, main.count);
    const by_unit = new Map(), differences = new Map();
    const columns_of_other = new Map((other?.columns ?? []).map((column) => [column.name, column]));
    this.chosen.forEach((name, i) => {
      const column = this.columns.find((c) => c.name === name);
      if (!column) return;
      try {
        this.add_series(by_unit, differences, column, columns_of_other.get(name), times, series_colour(this.theme, i));
      } catch (error) {
        this.container.append(element('p', { class: 'hint', text: `${shown(name)} is not plotted: ${error.message}` }));
      }
    });
    const calls = { seek: this.seek, zoom: (factor, time) => this.zoom(factor, time), all: () => this.zoom(Infinity, 0) };
    for (const map of [by_unit, differences]) {
      for (const [unit, series] of map) this.plots.push(new Plot(this.container, times, unit, series, this.theme, calls));
    }
    if (this.container.childElementCount === 0) this.container.append(element('p', { class: 'hint', text: 'Choose columns above.' }));
  }

  // A column, its twin of the other recording if there is one, and their difference.
  add_series(by_unit, differences, column, twin, times, colour) {
    const { main, other } = this, { name, unit } = column;
    const add = (map, series) => map.set(unit, [...(map.get(unit) ?? []), series]);
    const values = other ? resampled(main.t.subarray(0, main.count), column.data, times) : column.data;
    add(by_unit, { name, values, colour });
    if (!twin) return;
    const others = resampled(other.t.subarray(0, other.count), twin.data, times);
    add(by_unit, { name: `${name} (${other.name})`, values: others, colour, dashed: true });
    if (this.wants_difference) add(differences, { name: `\u0394 ${name}`, values: difference(values, others), colour });
  }

  // Shows `factor` times as long a time as before; `time` stays where it is.
  zoom(factor, time) {
    const { start, end } = this.bounds(), length = end - start;
    const span = this.span || length, from = this.span ? this.from : start;
    const wanted = Math.max(span * factor, length / 1e5);
    this.span = wanted < length ? wanted : 0;
    this.from = time - (this.span / span) * (time - from);
    this.changed();
  }

  // The part of time that is seen goes with the present time, where that moves.
  show_span(time) {
    const { start, end } = this.bounds();
    if (!(end > start)) return;
    if (this.span) {
      if (time !== this.time && (time < this.from || time > this.from + this.span)) this.from = time - 0.1 * this.span;
      this.from = Math.max(start, Math.min(end - this.span, this.from));
    }
    this.time = time;
    for (const plot of this.plots) plot.show(this.span ? this.from : start, this.span ? this.from + this.span : end);
  }

  // Times of what is plotted.
  bounds() {
    const shown = [this.main, this.other].filter((recording) => recording?.count > 0);
    return { start: Math.min(...shown.map((r) => r.start)), end: Math.max(...shown.map((r) => r.end)) };
  }

  update(time) {
    if (this.container.clientWidth === 0) return;
    if (this.stale) this.rebuild();
    this.show_span(time);
    for (const plot of this.plots) plot.update(time);
  }
}
