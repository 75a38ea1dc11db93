// Play, scrub, speed, repeat, and the time in words.

import { seconds } from '../text.js';
import { by_id } from './element.js';

export class Transport {
  // actions: seek(time), play()
  constructor(player, actions) {
    this.player = player;
    this.scrub = by_id('scrub');
    this.time = by_id('time');
    this.play = by_id('play');
    this.speed = by_id('speed');
    this.loop = by_id('loop');
    this.scrub.addEventListener('input', () => actions.seek(Number(this.scrub.value)));
    this.play.addEventListener('click', () => actions.play());
    this.speed.addEventListener('change', () => { this.player.speed = Number(this.speed.value); });
    this.loop.addEventListener('click', () => this.toggle_loop());
  }

  toggle_loop() {
    this.player.loop = !this.player.loop;
    this.loop.setAttribute('aria-pressed', String(this.player.loop));
  }

  // One step slower or faster.
  change_speed(step) {
    const index = Math.min(this.speed.options.length - 1, Math.max(0, this.speed.selectedIndex + step));
    this.speed.selectedIndex = index;
    this.player.speed = Number(this.speed.value);
  }

  set_range() {
    const { start, end, length } = this.player;
    this.scrub.min = start;
    this.scrub.max = length > 0 ? end : start + 1;
    this.scrub.disabled = this.play.disabled = !(length > 0);
    this.update();
  }

  update(playing = this.player.playing) {
    const { time, end, length } = this.player;
    this.scrub.value = time;
    const text = `${seconds(time, length)} / ${seconds(end, length)} s`;
    if (this.time.value !== text) {
      this.time.value = text;
      this.scrub.setAttribute('aria-valuetext', `${seconds(time, length)} seconds of ${seconds(end, length)}`);
    }
    if (this.playing !== playing) {
      this.playing = playing;
      this.play.toggleAttribute('data-playing', playing);
      by_id('play-name').textContent = playing ? 'Pause' : 'Play';
      this.play.title = playing ? 'Pause (Space)' : 'Play (Space)';
    }
  }
}
