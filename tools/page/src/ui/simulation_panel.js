// Simulate, reset, damping, and what the simulation says.

import { number } from '../text.js';
import { by_id, element } from './element.js';

// Slider position 0 to 1 to a damping: 0, then up to `largest` on a logarithmic scale.
const scaled = (x, largest) => (x <= 0 ? 0 : largest * 10 ** (4 * (x - 1)));

export class SimulationPanel {
  // run(), reset(), damp(c): calls; largest: the strongest damping
  constructor(largest, { run, reset, damp }) {
    this.box = by_id('simulation');
    this.run = element('button', { type: 'button', class: 'main', text: 'Simulate', id: 'simulate', onclick: run });
    this.reset = element('button', { type: 'button', text: 'Reset', id: 'reset', title: 'Back to the initial state', onclick: reset });
    this.status = element('p', { class: 'hint', id: 'simulation-state' });
    const output = element('output', { text: '0' });
    const input = element('input', { type: 'range', min: '0', max: '1', step: '0.01', value: '0', id: 'damping', 'aria-label': 'Damping of all coordinates' });
    input.addEventListener('input', () => {
      const c = scaled(Number(input.value), largest);
      output.value = c === 0 ? '0' : `${number(c, 2)} N\u00a0s/m, N\u00a0m\u00a0s/rad`;
      damp(c);
    });
    this.box.append(
      element('div', { class: 'buttons' }, this.run, this.reset), this.status,
      element('div', { class: 'slider' }, element('span', { text: 'Damping of all coordinates' }), output, input),
      element('p', { class: 'hint', text: 'While it runs, drag a body to pull it. It starts from the initial state, or at rest where the sliders have put it.' }));
    this.update(null);
  }

  update(simulation) {
    const running = simulation?.running ?? false;
    const text = running ? 'Pause' : simulation?.recording ? 'Go on' : 'Simulate';
    if (this.run.textContent !== text) this.run.textContent = text;
    const slow = running && simulation.pace < 0.8 ? `, at ${number(simulation.pace, 1)} of the speed asked for` : '';
    const state = simulation?.recording ? `t = ${number(simulation.time, 4)} s, energy ${number(simulation.energy, 4)} J${slow}` : '';
    if (this.status.textContent !== state) this.status.textContent = state;
  }
}
