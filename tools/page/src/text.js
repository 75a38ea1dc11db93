// Names and numbers as the page shows them. Names are any Unicode text: they only ever become text, never markup.

// Controls of C0 as their pictures; other controls and those that reorder text by their number.
function visible(character) {
  const code = character.charCodeAt(0);
  if (code < 0x20) return String.fromCharCode(0x2400 + code);
  if (code === 0x7f) return '\u2421';
  return `\u27e8U+${code.toString(16).toUpperCase().padStart(4, '0')}\u27e9`;
}

const controls = /[\u0000-\u001f\u007f-\u009f\u200b\u200e\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;
const lone_surrogates = /[\ud800-\udbff](?![\udc00-\udfff])|(?<![\ud800-\udbff])[\udc00-\udfff]/g;

// A name for one line of the page, cut after `limit` characters.
export function shown(name, limit = 80) {
  let text = String(name);
  const long = text.length > limit;
  if (long) text = text.slice(0, limit);
  text = text.replace(lone_surrogates, '\ufffd').replace(controls, visible);
  if (long) text += '\u2026';
  return text.trim() === '' ? '(no name)' : text;
}

// A number with about `digits` digits, a real minus sign, and no more zeros than needed.
export function number(x, digits = 4) {
  if (!Number.isFinite(x)) return '\u2013';
  const magnitude = Math.abs(x);
  let text;
  if (magnitude !== 0 && (magnitude >= 1e6 || magnitude < 1e-4)) text = x.toExponential(digits - 1).replace(/\.?0*e\+?/, 'e');
  else text = String(Number(x.toPrecision(digits)));
  return text.replace(/-/g, '\u2212');
}

// Seconds with as many decimals as the length of the recording asks for.
export function seconds(t, length) {
  const decimals = length < 0.1 ? 5 : length < 1 ? 4 : length < 100 ? 2 : 1;
  return t.toFixed(decimals).replace('-', '\u2212');
}

export function with_unit(x, unit) {
  return unit && unit !== '1' ? `${number(x)} ${unit}` : number(x);
}

// "1 joint", "2 joints", "2 bodies"
export function counted(n, one, many = `${one}s`) {
  return `${n} ${n === 1 ? one : many}`;
}
