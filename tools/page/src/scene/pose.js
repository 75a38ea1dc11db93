// Poses as 7 numbers in a flat array: x y z, then the quaternion w x y z.

// out[o..] = a[i..] * b[j..]; out may be neither.
export function compose(out, o, a, i, b, j) {
  const w = a[i + 3], x = a[i + 4], y = a[i + 5], z = a[i + 6];
  const px = b[j], py = b[j + 1], pz = b[j + 2];
  // p + 2 w (r x p) + 2 r x (r x p)
  const cx = y * pz - z * py, cy = z * px - x * pz, cz = x * py - y * px;
  out[o] = a[i] + px + 2 * (w * cx + y * cz - z * cy);
  out[o + 1] = a[i + 1] + py + 2 * (w * cy + z * cx - x * cz);
  out[o + 2] = a[i + 2] + pz + 2 * (w * cz + x * cy - y * cx);
  const bw = b[j + 3], bx = b[j + 4], by = b[j + 5], bz = b[j + 6];
  out[o + 3] = w * bw - x * bx - y * by - z * bz;
  out[o + 4] = w * bx + x * bw + y * bz - z * by;
  out[o + 5] = w * by - x * bz + y * bw + z * bx;
  out[o + 6] = w * bz + x * by - y * bx + z * bw;
}

// out = R^T (p - origin) of pose a[i..]: a point of the world in axes of the pose.
export function to_local(out, a, i, p) {
  const w = a[i + 3], x = -a[i + 4], y = -a[i + 5], z = -a[i + 6];
  const px = p[0] - a[i], py = p[1] - a[i + 1], pz = p[2] - a[i + 2];
  const cx = y * pz - z * py, cy = z * px - x * pz, cz = x * py - y * px;
  out[0] = px + 2 * (w * cx + y * cz - z * cy);
  out[1] = py + 2 * (w * cy + z * cx - x * cz);
  out[2] = pz + 2 * (w * cz + x * cy - y * cx);
  return out;
}
