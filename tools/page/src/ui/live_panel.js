// Buttons and sliders of a page of a program that runs.

import { number, shown, with_unit } from '../text.js';
import { by_id, element } from './element.js';

export class LivePanel {
  // run(): pauses and goes on; tell(what): sends a button; move(i, x): a slider; pulls: whether bodies can be pulled
  constructor({ run, tell, move, pulls }) {
    this.move = move;
    const button = (text, title, onclick, name) => element('button', { type: 'button', text, title, onclick, id: `live-${name}` });
    this.run = element('button', { type: 'button', class: 'main', text: 'Pause', id: 'live-run', onclick: run });
    this.record = button('Record', 'Keeps all states from now on', () => tell(this.recording ? 'keep' : 'record'), 'record');
    this.buttons = [this.run, button('Step', 'One step of the program', () => tell('step'), 'step'), button('Reset', 'Begins anew', () => tell('reset'), 'reset'), this.record];
    this.status = element('p', { class: 'hint', id: 'live-state' });
    this.kept = element('p', { class: 'hint', id: 'live-recording' });
    this.save = element('a', { href: 'recording.csv', download: 'recording.csv', text: 'Save as CSV' });
    by_id('simulation').append(element('div', { class: 'buttons' }, ...this.buttons), this.status, this.kept);
    if (pulls) by_id('simulation').append(element('p', { class: 'hint', text: 'While it runs, drag a body to pull it.' }));
    this.box = by_id('sliders');
    this.sliders = [];
    this.row_count = 0;
    this.connected(false, '');
  }

  say(text) {
    by_id('engine-state').textContent = text;
  }

  connected(on, why = '') {
    this.say(why);
    for (const each of this.buttons) each.disabled = !on;
    for (const { input } of this.sliders ?? []) input.disabled = !on;
  }

  time(t) {
    this.t = t;
    this.describe();
  }

  rows(n) {
    if (n === this.row_count) return;
    this.row_count = n;
    this.describe_recording();
  }

  update(controls) {
    Object.assign(this, { paused: controls.paused, recording: controls.recording, full: controls.full });
    this.run.textContent = controls.paused ? 'Run' : 'Pause';
    this.record.textContent = controls.recording ? 'Stop recording' : 'Record';
    const names = controls.sliders.map((s) => s.name).join('\n');
    if (names !== this.names) this.fill(controls.sliders);
    this.names = names;
    controls.sliders.forEach((s, i) => this.show(this.sliders[i], s));
    this.describe();
    this.describe_recording();
    this.say(controls.message && shown(controls.message, 1000));
  }

  describe() {
    const text = this.t === undefined ? '' : `t = ${number(this.t, 4)} s${this.paused ? ', paused' : ''}`;
    if (this.status.textContent !== text) this.status.textContent = text;
  }

  describe_recording() {
    const n = this.row_count;
    const text = this.full ? `The recording is full with ${n} states. ` : this.recording ? `Recording: ${n} states` : n > 0 ? `Recorded: ${n} states. ` : '';
    this.kept.replaceChildren(text, ...(n > 0 && !this.recording ? [this.save] : []));
  }

  fill(sliders) {
    this.sliders = sliders.map((s, i) => {
      const output = element('output');
      const input = element('input', {
        type: 'range', min: String(s.lower), max: String(s.upper), step: 'any', 'aria-label': `${shown(s.name)}${s.unit === '1' ? '' : ` in ${shown(s.unit, 24)}`}`,
      });
      input.addEventListener('input', () => {
        this.write(output, input, Number(input.value), s.unit);
        this.move(i, Math.min(s.upper, Math.max(s.lower, Number(input.value))));
      });
      return { input, output };
    });
    this.box.replaceChildren(...sliders.map((s, i) => element('div', { class: 'slider' },
      element('span', { class: 'name', text: shown(s.name), title: shown(s.name, 400) }), this.sliders[i].output, this.sliders[i].input,
      element('span', { class: 'end', text: number(s.lower) }), element('span', { class: 'end', text: number(s.upper) }))));
  }

  // Not where the user is moving it.
  show({ input, output }, { value, unit }) {
    if (document.activeElement === input && output.value !== '') return;
    input.value = String(value);
    this.write(output, input, value, unit);
  }

  write(output, input, value, unit) {
    output.value = with_unit(value, shown(unit, 24));
    input.setAttribute('aria-valuetext', output.value);
  }
}
