// What is known of the row that is chosen, and what can be done with its frame.

import { number, shown, with_unit } from '../text.js';
import { by_id, element } from './element.js';
import { item_of } from './tree.js';

const triple = (values, unit) => `${values.map((x) => number(x)).join(', ')}${unit ? ` ${unit}` : ''}`;

function facts(scene, row) {
  const item = item_of(scene, row.kind, row.index);
  const frame_name = (i) => shown(scene.frames[i].name, 60);
  if (row.kind === 'body') {
    return [['Mass', with_unit(item.mass, 'kg')], ['Centre', triple(item.centre, 'm')], ['Ellipsoid', triple(item.ellipsoid, 'm')], ['Frame', frame_name(item.frame)]];
  }
  if (row.kind === 'joint') {
    const unit = scene.coordinates[item.coordinates[0]]?.unit;
    const list = [['Type', shown(item.type)], ['From', frame_name(item.before)], ['To', frame_name(item.after)]];
    if (item.axis) list.push(['Axis', triple(item.axis)]);
    if (Number.isFinite(item.lower) || Number.isFinite(item.upper)) {
      list.push(['Range', `${number(item.lower ?? -Infinity)} to ${number(item.upper ?? Infinity)}${unit && unit !== '1' ? ` ${unit}` : ''}`]);
    }
    return list;
  }
  return [];
}

export class Details {
  // world: poses of all frames as they are drawn; calls: follow(frame or -1), trail(frame or -1), triad(frame, shown)
  constructor(scene, state, world, calls) {
    this.row = null;
    this.world = world;
    this.scene = scene;
    this.state = state;
    this.calls = calls;
    this.box = by_id('details');
  }

  show(row) {
    this.box.hidden = row === null;
    this.row = row;
    if (!row) return;
    const { scene, state, calls } = this;
    const item = item_of(scene, row.kind, row.index);
    const list = element('dl');
    for (const [term, value] of facts(scene, row)) list.append(element('dt', { text: term }), element('dd', { class: 'name', text: value }));
    this.position = element('dd');
    list.append(element('dt', { text: 'Position' }), this.position);
    const toggle = (text, title, pressed, change) => {
      const button = element('button', { type: 'button', text, title, 'aria-pressed': String(pressed) });
      button.addEventListener('click', () => {
        const now = button.getAttribute('aria-pressed') !== 'true';
        button.setAttribute('aria-pressed', String(now));
        change(now);
      });
      return button;
    };
    const frame = row.frame;
    this.box.replaceChildren(
      element('h2', { class: 'name', text: shown(item.name, 2000) }), list,
      element('div', { class: 'buttons' },
        toggle('Follow', 'The camera moves with it', state.followed === frame, (on) => calls.follow(on ? frame : -1)),
        toggle('Trail', 'Its path', state.trailed === frame, (on) => calls.trail(on ? frame : -1)),
        toggle('Axes', 'Its x, y and z axes', state.triads.has(frame), (on) => calls.triad(frame, on))));
    this.text = '';
    this.update();
  }

  update() {
    if (!this.row) return;
    const i = 7 * this.row.frame, { world } = this;
    const text = triple([world[i], world[i + 1], world[i + 2]].map((x) => Math.round(x * 1e5) / 1e5), 'm');
    if (text !== this.text) this.position.textContent = this.text = text;
  }
}
