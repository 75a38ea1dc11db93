// The tree of frames, joints and bodies: folds, hover, choice, search, keys.

import { outline } from '../scene/outline.js';
import { counted, shown } from '../text.js';
import { palettes } from '../view/palette.js';
import { by_id, element } from './element.js';
import { mark } from './marks.js';

const most_unfolded = 1500, most_rows = 4000;

export function item_of(scene, kind, index) {
  const lists = { frame: scene.frames, joint: scene.joints, body: scene.bodies, force: scene.forces };
  return lists[kind]?.[index] ?? null;
}

export class Tree {
  // pointed(row or null), chosen(row): what the pointer is over, what is clicked on
  constructor(scene, { pointed, chosen, followed }) {
    this.scene = scene;
    this.list = by_id('tree');
    this.calls = { pointed, chosen, followed };
    this.rows = [];  // {row, depth, parent, folded}
    this.collect(outline(scene));
    const many = this.rows.length > most_unfolded;
    for (const entry of this.rows) entry.folded = many && entry.depth >= 4;
    // long chains are deep: names must fit in beside them
    this.indent = Math.min(13, 110 / this.rows.reduce((most, entry) => Math.max(most, entry.depth), 1));
    this.query = '';
    by_id('search').addEventListener('input', (event) => this.search(event.target.value));
    by_id('search').addEventListener('keydown', (event) => this.key_in_search(event));
    this.list.addEventListener('mouseleave', () => pointed(null));
    this.list.addEventListener('keydown', (event) => this.key(event));
    this.draw();
  }

  // All rows in the order they are shown in, without recursion: chains may be long.
  collect(roots) {
    const stack = roots.map((row) => ({ row, depth: 0, parent: null })).reverse();
    while (stack.length) {
      const entry = stack.pop();
      this.rows.push(entry);
      for (let i = entry.row.children.length - 1; i >= 0; --i) stack.push({ row: entry.row.children[i], depth: entry.depth + 1, parent: entry });
    }
  }

  name_of(row) { return item_of(this.scene, row.kind, row.index).name; }

  search(query) {
    this.query = query.trim().toLowerCase();
    this.draw();
    const count = this.query ? this.matches.size : 0;
    by_id('found').textContent = !this.query ? '' : count === 0 ? 'No name has this in it.' : `${counted(count, 'name')} found`;
  }

  visible_entries() {
    if (!this.query) {
      return this.rows.filter((entry) => {
        for (let up = entry.parent; up; up = up.parent) if (up.folded) return false;
        return true;
      });
    }
    this.matches = new Set(this.rows.filter(({ row }) => String(this.name_of(row)).toLowerCase().includes(this.query)));
    return this.rows.filter((entry) => this.matches.has(entry));
  }

  draw() {
    const entries = this.visible_entries();
    this.drawn = entries.slice(0, most_rows);
    this.list.replaceChildren(...this.drawn.map((entry) => this.element_of(entry)));
    if (entries.length > most_rows) this.list.append(element('li', { role: 'none', text: `and ${entries.length - most_rows} more: search for a name` }));
    this.set_focusable(this.drawn.find((entry) => entry === this.current) ?? this.drawn[0]);
  }

  element_of(entry) {
    const { row, depth } = entry;
    const name = shown(this.name_of(row));
    const joint = row.kind === 'joint' ? this.scene.joints[row.index] : null;
    const kind = joint ? shown(joint.kind, 20) : '';
    const item = element('li', {
      role: 'treeitem', tabindex: '-1', 'aria-level': String(depth + 1), 'aria-label': `${name}, ${joint ? `${kind} joint` : row.kind}`,
      'aria-selected': String(entry === this.current),
      onclick: () => this.choose(entry), ondblclick: () => this.calls.followed(row), onmouseenter: () => this.calls.pointed(row),
    });
    item.style.paddingLeft = `${4 + (this.query ? 0 : Math.min(110, this.indent * depth))}px`;
    const folds = row.children.length > 0 && !this.query;
    if (folds) item.setAttribute('aria-expanded', String(!entry.folded));
    const fold = element('span', { class: 'fold', 'aria-hidden': 'true', text: folds ? (entry.folded ? '\u25b6' : '\u25bc') : '' });
    if (folds) fold.addEventListener('click', (event) => { event.stopPropagation(); this.fold(entry, !entry.folded); });
    const picture = joint ? (joint.kind === 'prismatic' ? 'prismatic' : joint.kind === 'fixed' ? 'fixed' : 'joint') : row.kind;
    item.append(fold, mark(picture, palettes.light), element('span', { class: 'name', text: name }), element('span', { class: 'kind', text: kind }));
    entry.item = item;
    return item;
  }

  fold(entry, folded) {
    const focused = this.list.contains(document.activeElement);
    entry.folded = folded;
    this.draw();
    if (focused) this.focus(entry);
  }

  set_focusable(entry) {
    if (this.focusable?.item) this.focusable.item.tabIndex = -1;
    this.focusable = entry;
    if (entry) entry.item.tabIndex = 0;
  }

  focus(entry) {
    if (!entry?.item) return;
    this.set_focusable(entry);
    entry.item.focus();
    this.calls.pointed(entry.row);
  }

  choose(entry) {
    const old = this.current;
    this.current = entry;
    old?.item?.setAttribute('aria-selected', 'false');
    entry?.item?.setAttribute('aria-selected', 'true');
    if (entry) this.set_focusable(entry);
    this.calls.chosen(entry?.row ?? null);
  }

  find({ kind, index }) { return this.rows.find(({ row }) => row.kind === kind && row.index === index); }

  // What the pointer is over in the 3D view.
  point(item) {
    const entry = item && this.find(item);
    if (this.pointed_item) this.pointed_item.classList.remove('pointed');
    this.pointed_item = entry?.item?.isConnected ? entry.item : null;
    this.pointed_item?.classList.add('pointed');
  }

  // What is clicked on in the 3D view.
  choose_item(item) {
    const entry = this.find(item);
    if (!entry) return;
    for (let up = entry.parent; up; up = up.parent) up.folded = false;
    this.query = by_id('search').value = '';
    by_id('found').textContent = '';
    this.draw();
    this.choose(entry);
    entry.item?.scrollIntoView({ block: 'nearest' });
  }

  // To what was found.
  key_in_search(event) {
    const first = this.drawn[0];
    if (!first || event.isComposing || !['ArrowDown', 'Enter'].includes(event.key)) return;
    event.preventDefault();
    if (event.key === 'Enter') this.choose(first);
    this.focus(first);
  }

  key(event) {
    const i = this.drawn.indexOf(this.focusable), entry = this.focusable;
    if (!entry) return;
    const moves = {
      ArrowDown: () => this.focus(this.drawn[i + 1]),
      ArrowUp: () => this.focus(this.drawn[i - 1]),
      Home: () => this.focus(this.drawn[0]),
      End: () => this.focus(this.drawn.at(-1)),
      Enter: () => this.choose(entry),
      ' ': () => this.choose(entry),
      ArrowRight: () => (entry.row.children.length && entry.folded ? this.fold(entry, false) : this.focus(this.drawn[i + 1])),
      ArrowLeft: () => (entry.row.children.length && !entry.folded && !this.query ? this.fold(entry, true) : this.focus(entry.parent)),
    };
    if (!Object.hasOwn(moves, event.key)) return;
    event.preventDefault();
    event.stopPropagation();
    moves[event.key]();
  }
}
