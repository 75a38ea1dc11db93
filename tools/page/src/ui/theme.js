// Light or dark: as the system has it until the switch is used, which is kept where the browser lets pages keep things.

const system = window.matchMedia('(prefers-color-scheme: dark)');

function kept() {
  try {
    return window.localStorage.getItem('kte-theme');
  } catch {
    return null;
  }
}

export class Theme {
  constructor(changed) {
    const chosen = kept();
    this.chosen = chosen === 'light' || chosen === 'dark' ? chosen : null;
    this.changed = changed;
    system.addEventListener('change', () => this.apply());
    this.apply();
  }

  get name() { return this.chosen ?? (system.matches ? 'dark' : 'light'); }

  apply() {
    document.documentElement.dataset.theme = this.name;
    this.changed(this.name);
  }

  toggle() {
    this.chosen = this.name === 'dark' ? 'light' : 'dark';
    try {
      window.localStorage.setItem('kte-theme', this.chosen);
    } catch {
      // a page without storage forgets it
    }
    this.apply();
  }
}
