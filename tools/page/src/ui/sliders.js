// A slider for each number that poses the mechanism.

import { number, shown, with_unit } from '../text.js';
import { by_id, element } from './element.js';
import { slider_parts } from './slider_parts.js';

const angle = (x) => `${number(x, 3)} rad (${number((x * 180) / Math.PI, 3)}\u00b0)`;

export class Sliders {
  // moved(q) after a slider has changed q
  constructor(scene, moved) {
    this.box = by_id('sliders');
    this.sliders = [];
    this.q = Float64Array.from(scene.state.q);
    const free = scene.coordinates.filter((c) => !c.follows && c.q >= 0);
    for (const coordinate of free) for (const part of slider_parts(coordinate, scene.size)) this.add(part, moved);
  }

  add(part, moved) {
    const [low, high] = part.range;
    const output = element('output');
    const input = element('input', {
      type: 'range', min: String(low), max: String(high), step: String((high - low) / 2000), 'aria-label': `${shown(part.name)}${part.unit === '1' ? '' : ` in ${part.unit}`}`,
    });
    input.addEventListener('input', () => {
      part.write(this.q, Number(input.value));
      moved(this.q);
    });
    this.box.append(element('div', { class: 'slider' }, element('span', { class: 'name', text: shown(part.name), title: shown(part.name, 400) }), output, input));
    this.sliders.push({ part, input, output });
  }

  // Shows a configuration.
  update(q) {
    this.q.set(q);
    for (const { part, input, output } of this.sliders) {
      const x = part.read(this.q);
      if (document.activeElement !== input || Math.abs(Number(input.value) - x) > Number(input.step)) input.value = String(x);
      const text = part.unit === 'rad' ? angle(x) : with_unit(x, part.unit);
      if (output.value !== text) input.setAttribute('aria-valuetext', output.value = text);
    }
  }
}
