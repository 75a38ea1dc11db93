// The loads that a page may show as arrows: what each is, where it acts, and how it is read from what the engine gives.

// Item: {group: 'weights' | 'elements' | 'reactions', kind, index: what of the scene it belongs to, name, frame: where it acts,
// point: in that frame, read(engine's loads by key, out)}; out: {force, torque} in axes of the world, NaN where unknown.

export const groups = [['weights', 'Weight of bodies'], ['elements', 'Springs, dampers, motors, ...'], ['reactions', 'Reactions of joints']];

const origin = [0, 0, 0], none = [0, 0, 0], unknown = [NaN, NaN, NaN];

// R v of pose w[i..]
export function rotated(w, i, [vx, vy, vz]) {
  const s = w[i + 3], x = w[i + 4], y = w[i + 5], z = w[i + 6];
  const cx = y * vz - z * vy, cy = z * vx - x * vz, cz = x * vy - y * vx;
  return [vx + 2 * (s * cx + y * cz - z * cy), vy + 2 * (s * cy + z * cx - x * cz), vz + 2 * (s * cz + x * cy - y * cx)];
}

export const element_key = (element, on, which) => `${element} ${on} ${which}`;
export const reaction_key = (track) => `reaction ${track}`;

function weights(scene) {
  const gravity = Array.isArray(scene.gravity) ? scene.gravity.map(Number) : none;
  if (!gravity.some((x) => x !== 0)) return [];
  return scene.bodies.flatMap((body, index) => {
    const force = gravity.map((g) => g * body.mass);
    return body.mass > 0 ? [{ group: 'weights', kind: 'body', index, name: `weight of ${body.name}`, frame: body.frame, point: body.centre, read: () => ({ force, torque: none }) }] : [];
  });
}

// Of a load with this key, on a frame in axes of the world.
const on_frame = (key) => (loads) => loads.get(key) ?? { force: unknown, torque: unknown };

// On a coordinate: by the axis of its joint, or of several numbers in the axes of the frame that moves.
function on_coordinate(key, joint, coordinate) {
  return (loads, world) => {
    const load = loads.get(key);
    if (!load) return { force: unknown, torque: unknown };
    if (coordinate.kind === 'rotation' || coordinate.kind.startsWith('pose')) {
      return { force: rotated(world, 7 * joint.after, load.force), torque: rotated(world, 7 * joint.after, load.torque) };
    }
    const along = rotated(world, 7 * joint.before, joint.axis).map((x) => x * load.force[0]);
    return coordinate.kind === 'length' ? { force: along, torque: none } : { force: none, torque: along };
  };
}

// "flexible beam (wall, body)"
const described = ({ type, name }) => `${String(type).replace(/_(gen|2D|3D)$/, '').replaceAll('_', ' ')} (${name})`;

function of_elements(scene) {
  const items = [];
  scene.forces.forEach((force, index) => {
    if (!(force.element >= 0)) return;
    const add = (name, frame, read) => items.push({ group: 'elements', kind: 'force', index, name, frame, point: origin, read });
    force.frames.forEach((frame, k) => add(`${described(force)} on ${scene.frames[frame].name}`, frame, on_frame(element_key(force.element, 'frame', k))));
    force.coordinates.forEach((c, k) => {
      const coordinate = scene.coordinates[c];
      for (const joint of scene.joints) {
        if (!joint.coordinates.includes(c) || (coordinate.size === 1 && !joint.axis)) continue;
        add(`${described(force)} on ${coordinate.name}`, joint.after, on_coordinate(element_key(force.element, 'coordinate', k), joint, coordinate));
      }
    });
  });
  return items;
}

function reactions(scene) {
  return scene.joints.flatMap((joint, index) => {
    const track = scene.frames[joint.after].track ?? -1;
    return track < 0 || joint.kind === 'free' ? [] : [{ group: 'reactions', kind: 'joint', index, name: `joint ${joint.name} on ${scene.frames[joint.after].name}`, frame: joint.after, point: origin, read: on_frame(reaction_key(track)) }];
  });
}

export const load_items = (scene) => [...weights(scene), ...of_elements(scene), ...reactions(scene)];

// What the engine gives, by key; between two of these at a share f of the way.
export function loads_by_key({ loads, reactions: of_tracks }) {
  const all = new Map();
  for (const load of loads) {
    const on = load.frame === undefined ? 'coordinate' : 'frame';
    all.set(element_key(load.element, on, load[on]), load);
  }
  of_tracks.forEach((load, track) => all.set(reaction_key(track), load));
  return all;
}

export function loads_between(a, b, f) {
  if (f === 0 || a === b) return a;
  const mix = (x, y) => x.map((n, i) => n + f * (y[i] - n));
  return new Map([...a].map(([key, load]) => [key, { force: mix(load.force, b.get(key).force), torque: mix(load.torque, b.get(key).torque) }]));
}
