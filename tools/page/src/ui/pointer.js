// The pointer over the 3D view: shows what it is over, chooses, follows, pulls.

const still = 4;  // pixels that a click may move

export class Pointer {
  // pick(event): what of the mechanism is there; calls: hover(hit), choose(hit), follow(hit), body(event): what there is to pull, grab(hit): true if pulled, move(event), release()
  constructor(canvas, pick, calls) {
    this.pulling = false;
    // before the camera's controls hear of it
    canvas.addEventListener('pointerdown', (event) => {
      this.down = { x: event.clientX, y: event.clientY };
      if (event.button !== 0 || !calls.pulls()) return;
      const hit = calls.body(event);
      if (!hit || !calls.grab(hit)) return;
      this.pulling = true;
      canvas.setPointerCapture(event.pointerId);
      event.stopImmediatePropagation();
    }, { capture: true });
    canvas.addEventListener('pointermove', (event) => {
      if (this.pulling) {
        calls.move(event);
        event.stopImmediatePropagation();
      } else if (event.buttons === 0) {
        this.hover(event, pick, calls);
      }
    }, { capture: true });
    const end = (event) => {
      if (!this.pulling) return;
      this.pulling = false;
      calls.release();
      event.stopImmediatePropagation();
    };
    canvas.addEventListener('pointerup', end, { capture: true });
    canvas.addEventListener('pointercancel', end, { capture: true });
    canvas.addEventListener('pointerleave', () => { if (!this.pulling) calls.hover(null); });
    canvas.addEventListener('click', (event) => {
      if (this.down && Math.hypot(event.clientX - this.down.x, event.clientY - this.down.y) <= still) calls.choose(pick(event));
    });
    canvas.addEventListener('dblclick', (event) => calls.follow(pick(event)));
  }

  // Once a picture: picking costs more than a move of the pointer.
  hover(event, pick, calls) {
    this.last = event;
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!this.pulling) calls.hover(pick(this.last));
    });
  }
}
