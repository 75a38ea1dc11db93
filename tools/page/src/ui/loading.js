// A line that says how far a page is that takes long; style.css shows it after a second.

import { by_id } from './element.js';

const busy = 50;  // ms of work between chances for the browser to draw

export class Loading {
  constructor() {
    this.line = by_id('loading');
    this.last = -Infinity;
  }

  // Lets the browser draw the text, at once or if it had no chance to draw for a while.
  async say(text, at_once = false) {
    this.line.textContent = text;
    if (!at_once && performance.now() - this.last < busy) return;
    await new Promise((go) => { setTimeout(go); });
    this.last = performance.now();
  }

  end() {
    this.line.remove();
  }
}
