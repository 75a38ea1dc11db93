// Small pictures of frames, bodies and joints for rows of the tree and for the list of symbols.

const svg = 'http://www.w3.org/2000/svg';
const paths = {
  frame: [['M3 13V3', '#2f9e44'], ['M3 13h10', '#e03131'], ['M3 13l5-5', '#1c7ed6']],
  body: [['M8 3a6 5 0 1 0 .01 0z', 'body']],
  joint: [['M13 8a5 5 0 1 1-2-4M11 1v3.2H7.8', 'joint']],
  prismatic: [['M2 8h12M5 5L2 8l3 3M11 5l3 3-3 3', 'joint']],
  fixed: [['M4 4h8v8H4z', 'fixed']],
};

const css = (colour) => `#${colour.toString(16).padStart(6, '0')}`;

export function mark(kind, palette) {
  const picture = document.createElementNS(svg, 'svg');
  picture.setAttribute('viewBox', '0 0 16 16');
  picture.setAttribute('class', 'mark');
  picture.setAttribute('aria-hidden', 'true');
  for (const [d, colour] of paths[kind] ?? paths.joint) {
    const path = document.createElementNS(svg, 'path');
    path.setAttribute('d', d);
    path.setAttribute('fill', 'none');
    path.setAttribute('stroke-width', '1.8');
    path.setAttribute('stroke', palette[colour] === undefined ? colour : css(palette[colour]));
    picture.append(path);
  }
  return picture;
}
