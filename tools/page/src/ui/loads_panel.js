// Forces as arrows: whether, of what, how long, and a list of them with their magnitudes.

import { groups } from '../scene/load_items.js';
import { number, shown } from '../text.js';
import { by_id, element } from './element.js';

const most_in_list = 300, most_names = 4, list_every = 200;  // ms

const reasons = {
  '': 'They depend on inputs or internal states that were not recorded.',
  'no velocities': 'The recording has no velocities, on which they depend.',
  velocities: 'They depend on velocities, and those here are not the rates of the coordinates.',
  accelerations: 'They depend on accelerations, and something acts here that is not in the model.',
};

// "12.3 N, 0.4 N m", of what is drawn
export function magnitude(arrow, loads) {
  const parts = [['force', 'N'], ['torque', 'N\u00a0m']].filter(([what]) => loads.is_seen(arrow[what], what));
  return parts.length ? parts.map(([what, unit]) => `${number(Math.hypot(...arrow[what]))} ${unit}`).join(', ') : 'none';
}

const scaled = (x) => 10 ** x;

export class LoadsPanel {
  // loads: Loads; switch_on(on), choose(group, on), rescale(factor), point(item or null), later(): calls
  constructor(loads, { switch_on, choose, rescale, point, later }) {
    this.loads = loads;
    this.point = point;
    this.later = later;
    this.box = element('input', { type: 'checkbox', id: 'loads-on' });
    this.box.addEventListener('change', () => switch_on(this.box.checked));
    const kinds = groups.filter(([group]) => loads.items.some((item) => item.group === group)).map(([group, text]) => {
      const box = element('input', { type: 'checkbox', id: `loads-${group}`, checked: loads.groups[group] });
      box.addEventListener('change', () => choose(group, box.checked));
      return element('label', { class: 'check' }, box, element('span', { class: `swatch ${group}` }), element('span', { text }));
    });
    this.output = element('output');
    const slider = element('input', { type: 'range', id: 'loads-scale', min: '-1.5', max: '1.5', step: '0.05', value: '0', 'aria-label': 'Length of arrows' });
    slider.addEventListener('input', () => rescale(scaled(Number(slider.value))));
    this.slider = slider;
    this.state = element('p', { class: 'hint', id: 'loads-state', role: 'status' });
    this.rows = element('ul', { class: 'loads' });
    this.list = element('details', { id: 'loads-list' }, element('summary', { text: 'List' }), this.rows);
    this.list.addEventListener('toggle', () => {
      this.fill();
      this.point(null);
    });
    this.options = element('div', { hidden: true }, ...kinds,
      element('div', { class: 'slider' }, element('span', { text: 'Length of arrows' }), this.output, slider), this.state, this.list);
    const name = element('span', { text: 'Forces and torques as arrows' });
    by_id('loads').append(element('label', { class: 'check', title: 'Key V' }, this.box, name), this.options);
    by_id('loads').hidden = loads.items.length === 0;
    this.filled = null;
    this.updated = 0;
  }

  show(on) {
    this.box.checked = on;
    this.options.hidden = !on;
  }

  // why: the reason why there is no engine, if there is none
  describe(why) {
    const { loads } = this;
    const { force, torque } = loads.reference ?? {}, size = loads.scene.size * loads.scale;
    const metres = loads.metres, unit = size > 0 ? 10 ** Math.floor(Math.log10(size)) : 1;
    const per = [[force, metres.force, 'N'], [torque, metres.torque, 'N\u00a0m']].filter(([x]) => x > 0).map(([, m, u]) => `${number(unit / m, 3)} ${u}`);
    const text = per.length ? `${number(unit)} m = ${per.join(', ')}` : '';
    if (this.output.value !== text) this.slider.setAttribute('aria-valuetext', this.output.value = text);
    const said = this.sentence(why);
    if (this.state.textContent !== said) this.state.textContent = said;
  }

  sentence(why) {
    const { unknown, doubt, groups: wanted } = this.loads;
    if (why && (wanted.elements || wanted.reactions)) return why;
    if (unknown.length === 0) return '';
    const names = [...new Set(unknown.map((item) => shown(item.name, 60)))];
    const rest = names.length > most_names ? ` and ${names.length - most_names} more` : '';
    return `Not known here: ${names.slice(0, most_names).join('; ')}${rest}. ${reasons[doubt]}`;
  }

  // A row for each item that is shown.
  fill() {
    const items = this.loads.shown_items.slice(0, most_in_list);
    this.filled = items.map((item) => {
      const value = element('em');
      const row = element('button', { type: 'button', class: 'load' }, element('span', { class: 'name', text: shown(item.name, 120) }), value);
      for (const event of ['focus', 'mouseenter']) row.addEventListener(event, () => this.point(item));
      for (const event of ['blur', 'mouseleave']) row.addEventListener(event, () => this.point(null));
      return { item, row, value };
    });
    const more = this.loads.shown_items.length - items.length;
    this.rows.replaceChildren(...this.filled.map(({ row }) => element('li', {}, row)), ...(more > 0 ? [element('li', { class: 'hint', text: `and ${more} more` })] : []));
    this.loads.stale = true;
  }

  update(now, why) {
    if (!this.loads.on) return;
    if (now - this.updated < list_every && !this.loads.stale) {
      this.timer ??= setTimeout(() => { this.timer = null; this.later(); }, list_every);
      return;
    }
    this.updated = now;
    this.loads.stale = false;
    this.describe(why);
    if (!this.list.open) return;
    if (!this.filled) this.fill();
    const values = new Map(this.loads.arrows.map((arrow) => [arrow.item, arrow]));
    for (const { item, value } of this.filled) {
      const text = values.has(item) ? magnitude(values.get(item), this.loads) : 'not known';
      if (value.textContent !== text) value.textContent = text;
    }
  }
}
