// The scene of the page, checked: every index refers to something, every list is there.

class BadScene extends Error {}

function list(scene, name) {
  const value = scene[name] ?? [];
  if (!Array.isArray(value)) throw new BadScene(`"${name}" is not a list`);
  return value;
}

function index(value, count, place) {
  if (!Number.isInteger(value) || value < 0 || value >= count) throw new BadScene(`${place}: there is no ${value}, only ${count}`);
  return value;
}

function numbers(value, count, place) {
  if (!Array.isArray(value) || value.length !== count || !value.every(Number.isFinite))
    throw new BadScene(`${place}: expected ${count} numbers`);
  return value;
}

function check_frames(scene) {
  scene.frames.forEach((frame, i) => {
    if (frame.track !== undefined && frame.track !== null) return index(frame.track, scene.tracks, `frames[${i}].track`);
    if (frame.parent !== -1) index(frame.parent, i, `frames[${i}].parent`);
    return numbers(frame.pose, 7, `frames[${i}].pose`);
  });
}

function check_links_and_joints(scene) {
  const count = scene.frames.length;
  scene.joints.forEach((joint, i) => {
    index(joint.before, count, `joints[${i}].before`);
    index(joint.after, count, `joints[${i}].after`);
    if (joint.axis) numbers(joint.axis, 3, `joints[${i}].axis`);
    joint.coordinates ??= [];
    joint.coordinates.forEach((k) => index(k, scene.coordinates.length, `joints[${i}].coordinates`));
  });
  scene.links.forEach((link, i) => {
    index(link.from, count, `links[${i}].from`);
    index(link.to, count, `links[${i}].to`);
  });
}

function check_bodies_and_forces(scene) {
  const count = scene.frames.length;
  scene.bodies.forEach((body, i) => {
    index(body.frame, count, `bodies[${i}].frame`);
    numbers(body.centre, 3, `bodies[${i}].centre`);
    numbers(body.orientation, 4, `bodies[${i}].orientation`);
    numbers(body.ellipsoid, 3, `bodies[${i}].ellipsoid`);
  });
  scene.forces.forEach((force, i) => {
    force.frames = (force.frames ?? []).map((f) => index(f, count, `forces[${i}].frames`));
    force.coordinates = (force.coordinates ?? []).map((k) => index(k, scene.coordinates.length, `forces[${i}].coordinates`));
  });
}

function check_pulls(scene) {
  scene.pulls.forEach((frame, i) => index(frame, scene.frames.length, `pulls[${i}]`));
}

function check_shapes(scene) {
  scene.shapes.forEach((shape, i) => {
    index(shape.frame, scene.frames.length, `shapes[${i}].frame`);
    numbers(shape.pose, 7, `shapes[${i}].pose`);
    if (shape.type === 'mesh') index(shape.mesh, scene.meshes.length, `shapes[${i}].mesh`);
  });
}

function check_recordings(scene) {
  scene.recordings.forEach((recording, i) => {
    if (!Number.isInteger(recording.count) || recording.count < 0) throw new BadScene(`recordings[${i}].count is ${recording.count}`);
    recording.columns ??= [];
  });
  scene.recordings = scene.recordings.filter((recording) => recording.count > 0);
}

function unit_vector(value, planar) {
  const [x = 0, y = 0, z = 0] = Array.isArray(value) ? value : [];
  const length = Math.hypot(x, y, z);
  if (!(length > 0)) return planar ? [0, 1, 0] : [0, 0, 1];
  return [-x / length, -y / length, -z / length];
}

// The scene with all its lists and with `up`; null where the page has none. Throws an Error that says what is wrong.
export function read_scene(text) {
  const scene = JSON.parse(text);
  if (scene === null) return null;
  if (scene.format !== 'kte-scene-1') throw new BadScene(`this page reads "kte-scene-1", not "${String(scene.format).slice(0, 80)}"`);
  const lists = ['frames', 'coordinates', 'joints', 'links', 'bodies', 'forces', 'pulls', 'shapes', 'meshes', 'notes', 'recordings'];
  for (const name of lists) scene[name] = list(scene, name);
  scene.tracks ??= 0;
  scene.planar = scene.dimension === 2;
  scene.up = unit_vector(scene.gravity, scene.planar);
  if (!(scene.size > 0)) scene.size = 1;
  scene.state ??= { q: [], v: [] };
  check_frames(scene);
  check_links_and_joints(scene);
  check_bodies_and_forces(scene);
  check_pulls(scene);
  check_shapes(scene);
  check_recordings(scene);
  return scene;
}
