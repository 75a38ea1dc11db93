// The clock of recordings.

export class Player {
  constructor(changed) {
    this.changed = changed;
    this.time = 0;
    this.start = 0;
    this.end = 0;
    this.speed = 1;
    this.loop = true;
    this.playing = false;
  }

  set_range(start, end) {
    this.start = start;
    this.end = Math.max(start, end);
    this.seek(this.time);
  }

  get length() { return this.end - this.start; }

  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.changed();
  }

  play(playing = !this.playing) {
    this.playing = playing && this.length > 0;
    if (this.playing && this.time >= this.end) this.time = this.start;
    this.changed();
  }

  advance(elapsed) {
    if (!this.playing) return;
    const time = this.time + this.speed * elapsed;
    if (time < this.end) this.time = time;
    else if (this.loop) this.time = this.start + ((time - this.start) % this.length);
    else {
      this.time = this.end;
      this.playing = false;
    }
    this.changed();
  }
}
