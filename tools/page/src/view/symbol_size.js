// The size of joints' symbols, from the distances between the frames that links and joints connect.

export function symbol_size(scene, world) {
  const lengths = [];
  const distance = (i, j) => Math.hypot(world[7 * i] - world[7 * j], world[7 * i + 1] - world[7 * j + 1], world[7 * i + 2] - world[7 * j + 2]);
  for (const link of scene.links) lengths.push(distance(link.from, link.to));
  for (const joint of scene.joints) lengths.push(distance(joint.before, joint.after));
  scene.frames.forEach((frame, i) => {
    if ((frame.parent ?? -1) >= 0) lengths.push(distance(i, frame.parent));
  });
  const seen = lengths.filter((x) => x > 1e-6 * scene.size).sort((a, b) => a - b);
  const typical = seen.length ? seen[seen.length >> 1] : scene.size;
  return Math.min(0.045 * scene.size, Math.max(0.2 * typical, 0.012 * scene.size));
}
