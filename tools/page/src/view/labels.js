// Names of frames beside them, as text of the page over the canvas.

import { shown } from '../text.js';

const place = { x: 0, y: 0, z: 0 };

export class Labels {
  constructor(container, stage) {
    this.container = container;
    this.stage = stage;
    this.labels = [];
  }

  // frames: [index, name] of those that are labelled
  set(frames) {
    this.container.replaceChildren();
    this.labels = frames.map(([frame, name]) => {
      const element = document.createElement('span');
      element.className = 'label name';
      element.textContent = shown(name, 40);
      this.container.append(element);
      return { frame, element };
    });
  }

  update(world) {
    const { width, height } = this.stage;
    for (const { frame, element } of this.labels) {
      this.stage.project(world[7 * frame], world[7 * frame + 1], world[7 * frame + 2], place);
      const visible = place.z > -1 && place.z < 1 && place.x > 0 && place.x < width && place.y > 0 && place.y < height;
      element.style.display = visible ? '' : 'none';
      if (visible) element.style.transform = `translate(${place.x.toFixed(1)}px, ${place.y.toFixed(1)}px)`;
    }
  }
}
