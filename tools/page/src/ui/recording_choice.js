// Which recording is shown, and which one over it.

import { shown } from '../text.js';
import { by_id, element } from './element.js';

export class RecordingChoice {
  // changed(main index, other index or -1, difference wanted)
  constructor(changed) {
    this.changed = changed;
    this.box = by_id('recordings');
    this.main = 0;
    this.other = -1;
    this.difference = true;
  }

  draw(recordings) {
    this.box.replaceChildren();
    this.box.hidden = recordings.length < 2;
    if (recordings.length < 2) return;
    const names = recordings.map((recording, i) => shown(recording.name || `recording ${i + 1}`, 60));
    const select = (label, chosen, none, change) => {
      const list = element('select', { 'aria-label': label });
      if (none) list.append(element('option', { value: '-1', text: none }));
      names.forEach((name, i) => list.append(element('option', { value: String(i), text: name })));
      list.value = String(chosen);
      list.addEventListener('change', () => change(Number(list.value)));
      return element('div', { class: 'field' }, element('span', { text: label, 'aria-hidden': 'true' }), list);
    };
    const call = () => this.changed(this.main, this.other, this.difference);
    const box = element('input', { type: 'checkbox', id: 'difference', checked: this.difference });
    box.addEventListener('change', () => {
      this.difference = box.checked;
      call();
    });
    const both = element('label', { class: 'check', hidden: this.other < 0 }, box, element('span', { text: 'Plot the difference too' }));
    this.box.append(
      select('Recording', this.main, null, (i) => { this.main = i; call(); }),
      select('Compare', this.other, 'nothing', (i) => { this.other = i; both.hidden = i < 0; call(); }), both);
  }
}
