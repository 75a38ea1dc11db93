// Whether recorded velocities are the rates of recorded coordinates, and accelerations those of velocities: a program may
// have moved the mechanism by something that is not in its model.

const share = 0.03;     // of a rate, by which slopes may be off beside their own change
const float = 1.2e-7;   // of a number in 32 bits

// The slope at sample i of number k of `width` a time, and by how much it may be off: from the samples beside it. Null where
// there are no three.
function slope(t, numbers, width, count, i, k) {
  const j = Math.min(Math.max(i, 1), count - 2);
  const before = t[j] - t[j - 1], after = t[j + 1] - t[j];
  if (count < 3 || !(before > 0 && after > 0)) return null;
  const [x, y, z] = [j - 1, j, j + 1].map((n) => numbers[n * width + k]);
  const first = (y - x) / before, second = (z - y) / after, change = Math.abs(second - first);
  const rounding = (4 * float * Math.max(Math.abs(x), Math.abs(y), Math.abs(z))) / Math.min(before, after);
  if (i === j) return { mean: (first + second) / 2, off: change + rounding };
  return { mean: i < j ? first : second, off: 2 * change + rounding };
}

function fits(rate, at) {
  return at === null || !Number.isFinite(rate) || Math.abs(rate - at.mean) <= at.off + share * Math.max(Math.abs(rate), Math.abs(at.mean));
}

// Of coordinates of one number.
export function velocities_fit({ t, q, v, nq, count }, coordinates, nv, i) {
  return coordinates.every((c) => c.size !== 1 || c.q < 0 || fits(v[i * nv + c.v], slope(t, q, nq, count, i, c.q)));
}

export function accelerations_fit({ t, v, count }, accelerations, i) {
  const nv = accelerations.length;
  return accelerations.every((a, k) => fits(a, slope(t, v, nv, count, i, k)));
}

// What the engine says of sample i, with all that is doubtful unknown: {loads by the engine, doubt: '' | 'no velocities' |
// 'velocities' | 'accelerations'}. ask(v, free) asks the engine.
export function loads_of_sample(recording, coordinates, nv, i, free, ask) {
  const unknown = new Float64Array(nv).fill(NaN);
  if (recording.v === null) return { acting: ask(unknown, free), doubt: 'no velocities' };
  if (!velocities_fit(recording, coordinates, nv, i)) return { acting: ask(unknown, free), doubt: 'velocities' };
  const v = Float64Array.from(recording.v.subarray(nv * i, nv * (i + 1))), acting = ask(v, free);
  if (!free || accelerations_fit(recording, acting.accelerations, i)) return { acting, doubt: free ? '' : 'accelerations' };
  return { acting: ask(v, false), doubt: 'accelerations' };
}
