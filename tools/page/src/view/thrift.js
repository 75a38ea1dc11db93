// Machines without a graphics processor draw slowly: they get fewer pixels and no shadows.

const slow = 0.07;  // s between pictures
const pictures = 15;

export class Thrift {
  constructor(stage) {
    this.stage = stage;
    this.steps = [() => stage.drop_shadows(), () => stage.set_pixel_ratio(1), () => stage.set_pixel_ratio(0.7)];
    this.begin();
  }

  begin() {
    this.count = 0;
    this.total = 0;
  }

  // The time since the picture before, s, while the mechanism moves.
  tell(elapsed) {
    if (this.steps.length === 0 || elapsed <= 0) return;
    this.total += elapsed;
    if (++this.count < pictures) return;
    if (this.total / this.count > slow) this.steps.shift()();
    this.begin();
  }
}
