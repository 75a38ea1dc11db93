// The panels: one at a time, chosen by tabs. On narrow screens the tree is one of them.

import { by_id } from './element.js';

const names = ['tree', 'plots', 'move', 'show', 'notes'];

export class Tabs {
  constructor(opened) {
    this.opened = opened;
    this.narrow = window.matchMedia('(max-width: 860px)');
    for (const name of names) {
      const tab = by_id(`tab-${name}`);
      tab.addEventListener('click', () => this.open(name));
      tab.addEventListener('keydown', (event) => this.move(event, name));
    }
    this.narrow.addEventListener('change', () => this.open(this.name));
  }

  get shown_names() { return names.filter((name) => name !== 'tree' || this.narrow.matches); }

  open(name) {
    this.name = name === 'tree' && !this.narrow.matches ? 'plots' : name;
    document.body.dataset.panel = this.name;
    for (const each of names) {
      const tab = by_id(`tab-${each}`);
      tab.setAttribute('aria-selected', String(each === this.name));
      tab.tabIndex = each === this.name ? 0 : -1;
    }
    this.opened(this.name);
  }

  move(event, name) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const shown = this.shown_names;
    const next = shown[(shown.indexOf(name) + step + shown.length) % shown.length];
    this.open(next);
    by_id(`tab-${next}`).focus();
  }
}
