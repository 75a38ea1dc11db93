// Columns of recordings at the times of others.

// Times of both, ascending, each once; one of the arrays itself where they agree.
export function merged_times(a, b) {
  if (a.length === b.length && a.every((t, i) => t === b[i])) return a;
  const all = new Float64Array(a.length + b.length);
  all.set(a);
  all.set(b, a.length);
  all.sort();
  return all.filter((t, i) => i === 0 || t !== all[i - 1]);
}

// Values (with their times t) at other times, linearly between; null outside and beside nulls.
export function resampled(t, values, times) {
  if (t === times) return values;
  const out = new Array(times.length);
  let i = 0;
  for (let k = 0; k < times.length; ++k) {
    const time = times[k];
    while (i + 1 < t.length && t[i + 1] <= time) ++i;
    if (time < t[0] || time > t[t.length - 1]) out[k] = null;
    else if (time === t[i] || i + 1 >= t.length) out[k] = values[i];
    else if (values[i] === null || values[i + 1] === null) out[k] = null;
    else out[k] = values[i] + ((time - t[i]) / (t[i + 1] - t[i])) * (values[i + 1] - values[i]);
  }
  return out;
}

export function difference(a, b) {
  return Array.from(a, (x, i) => (x === null || b[i] === null ? null : x - b[i]));
}

// The value at one time, between its neighbours; null outside and beside nulls.
export function value_at(t, values, time) {
  const last = t.length - 1;
  if (last < 0 || time < t[0] || time > t[last]) return null;
  let low = 0, high = last + 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle] <= time) low = middle;
    else high = middle;
  }
  if (low === last || t[low] === time) return values[low];
  if (values[low] === null || values[low + 1] === null) return null;
  return values[low] + ((time - t[low]) / (t[low + 1] - t[low])) * (values[low + 1] - values[low]);
}
