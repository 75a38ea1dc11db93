// Elements of the page. Text of the scene only ever gets in as text or as a value of an attribute.

export const by_id = (id) => document.getElementById(id);

// element('p', {class: 'hint', 'aria-label': 'x', text: 'y', onclick: f}, ...children)
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === 'text') made.textContent = value;
    else if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (name in made && typeof value === 'boolean') made[name] = value;
    else made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children);
  return made;
}
