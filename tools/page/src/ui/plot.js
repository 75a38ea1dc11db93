// One plot: columns of one unit against time, with a line at the present time. A click or a drag on it sets the time, the
// wheel zooms in time.

import uPlot from 'uplot';
import { value_at } from '../scene/resample.js';
import { number, shown } from '../text.js';
import { element } from './element.js';

const height = 190;

export class Plot {
  // series: [{name, values, colour, dashed}], all at `times`
  // seek(time), zoom(factor, time), all(): what the pointer asks for
  constructor(container, times, unit, series, theme, { seek, zoom, all }) {
    this.times = times;
    this.time = times[0] ?? 0;
    this.series = series;
    const dark = theme === 'dark';
    const soft = dark ? '#a0abba' : '#5a6675', line = dark ? '#2a313b' : '#e6eaf0';
    const axis = { stroke: soft, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 }, font: '11px system-ui, sans-serif', labelFont: '11px system-ui, sans-serif' };
    const written = (_, values) => values.map((x) => (x === null ? '' : number(x, 6)));
    this.box = element('div', { class: 'plot', role: 'group', 'aria-label': `Plot of ${series.map((s) => shown(s.name)).join(', ')}, ${unit}, against time` });
    const host = element('div');
    this.box.append(host, this.key());
    container.append(this.box);
    this.uplot = new uPlot({
      width: Math.max(120, container.clientWidth), height,
      legend: { show: false },
      hooks: { draw: [() => this.place(this.time)] },
      cursor: { drag: { x: false, y: false }, points: { show: false }, y: false },
      scales: { x: { time: false } },
      axes: [
        { ...axis, label: 't in s', labelSize: 16, size: 26, values: written },
        { ...axis, label: unit === '1' ? '' : shown(unit, 24), labelSize: unit === '1' ? 4 : 18, size: 52, values: written },
      ],
      series: [{}, ...series.map((s) => ({ stroke: s.colour, width: 1.6, dash: s.dashed ? [5, 4] : undefined, points: { show: times.length < 2 } }))],
    }, [times, ...series.map((s) => s.values)], host);
    host.querySelector('canvas').setAttribute('aria-hidden', 'true');  // the box says what it is, the key its values
    this.now = element('div', { class: 'now' });
    this.uplot.over.append(this.now);
    this.scrub(seek);
    this.uplot.over.addEventListener('wheel', (event) => {
      event.preventDefault();
      zoom(event.deltaY < 0 ? 0.8 : 1.25, this.time_of(event));
    }, { passive: false });
    this.uplot.over.addEventListener('dblclick', all);
  }

  // Names, colours and present values.
  key() {
    this.outputs = this.series.map(() => element('em'));
    return element('div', { class: 'series' }, ...this.series.map((s, i) => {
      const dash = element('i', { class: s.dashed ? 'dashed' : '' });
      dash.style.setProperty('--c', s.colour);
      dash.style.background = s.colour;
      return element('span', {}, dash, element('b', { class: 'name', text: shown(s.name), title: shown(s.name, 400) }), this.outputs[i]);
    }));
  }

  time_of(event) {
    return this.uplot.posToVal(event.clientX - this.uplot.over.getBoundingClientRect().left, 'x');
  }

  // Times from min to max.
  show(min, max) {
    const { x } = this.uplot.scales;
    if (x.min !== min || x.max !== max) this.uplot.setScale('x', { min, max });
  }

  scrub(seek) {
    const over = this.uplot.over;
    const to = (event) => seek(this.time_of(event));
    over.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      over.setPointerCapture(event.pointerId);
      to(event);
    });
    over.addEventListener('pointermove', (event) => { if (over.hasPointerCapture(event.pointerId)) to(event); });
  }

  resize(width) {
    if (width > 0 && width !== this.uplot.width) this.uplot.setSize({ width, height });
  }

  // The line at the present time; scales are known when the plot has been drawn.
  place(time) {
    if (!this.now) return;
    const x = this.uplot.valToPos(time, 'x');
    this.now.style.transform = `translateX(${Number.isFinite(x) ? x.toFixed(1) : -10}px)`;
  }

  update(time) {
    this.time = time;
    this.place(time);
    this.series.forEach((s, i) => {
      const value = value_at(this.times, s.values, time);
      const text = value === null ? '' : number(value);
      if (this.outputs[i].textContent !== text) this.outputs[i].textContent = text;
    });
  }

  destroy() {
    this.uplot.destroy();
    this.box.remove();
  }
}
