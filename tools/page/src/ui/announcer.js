// Tells screen readers the time where the motion stands, not while it runs.

import { seconds } from '../text.js';
import { by_id } from './element.js';

export class Announcer {
  constructor() {
    this.region = by_id('live');
  }

  time(player) {
    clearTimeout(this.timer);
    if (player.playing) return;
    this.timer = setTimeout(() => {
      this.region.textContent = `${seconds(player.time, player.length)} seconds of ${seconds(player.end, player.length)}`;
    }, 400);
  }

  say(text) {
    clearTimeout(this.timer);
    this.region.textContent = text;
  }
}
