// The numbers of a coordinate in q: what each is called and measured in.

const parts = {
  rotation: [['w', '1'], ['x', '1'], ['y', '1'], ['z', '1']],
  pose: [['x', 'm'], ['y', 'm'], ['z', 'm'], ['qw', '1'], ['qx', '1'], ['qy', '1'], ['qz', '1']],
  pose_2D: [['x', 'm'], ['y', 'm'], ['angle', 'rad']],
};

// [{name, unit}], one for each number
export function coordinate_parts({ name, kind, size, unit }) {
  if (size === 1) return [{ name, unit }];
  const known = Object.hasOwn(parts, kind) && parts[kind].length === size ? parts[kind] : null;
  return Array.from({ length: size }, (_, k) => ({ name: `${name}/${known ? known[k][0] : k}`, unit: known ? known[k][1] : unit }));
}
