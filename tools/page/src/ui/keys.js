// Keys of the whole page. Fields, sliders, trees and tabs keep their own.

const takes_text = (target) => target.matches?.('textarea, select, input:not([type="range"]):not([type="checkbox"])');
const takes_space = (target) => target.matches?.('button, summary, input, select, [role="treeitem"]');
const takes_arrows = (target) => target.matches?.('input[type="range"]:not(#scrub), select, [role="treeitem"], [role="tab"], pre');

// actions: play, step(n), share(x), first, last, faster(n), loop, orbit(left, up), zoom(factor), fit, search, theme, forces, help
export function listen_to_keys(actions) {
  const turn = Math.PI / 24;
  const anywhere = {
    f: actions.fit, l: actions.loop, t: actions.theme, v: actions.forces, '/': actions.search, '?': actions.help,
    ',': () => actions.faster(-1), '.': () => actions.faster(1),
    w: () => actions.orbit(0, turn), s: () => actions.orbit(0, -turn), a: () => actions.orbit(-turn, 0), d: () => actions.orbit(turn, 0),
    '+': () => actions.zoom(1.15), '=': () => actions.zoom(1.15), '-': () => actions.zoom(1 / 1.15),
  };
  const arrows = {
    ArrowLeft: (event) => (event.shiftKey ? actions.share(-0.05) : actions.step(-1)),
    ArrowRight: (event) => (event.shiftKey ? actions.share(0.05) : actions.step(1)),
    Home: actions.first,
    End: actions.last,
  };
  window.addEventListener('keydown', (event) => {
    const target = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || event.isComposing || takes_text(target) || document.querySelector('dialog[open]')) return;
    let action = null;
    if (event.key === ' ') action = takes_space(target) ? null : actions.play;
    else if (Object.hasOwn(arrows, event.key)) action = takes_arrows(target) ? null : arrows[event.key];
    else {
      const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
      if (Object.hasOwn(anywhere, key)) action = anywhere[key];
    }
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}
