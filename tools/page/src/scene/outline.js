// What hangs on what: frames, joints and bodies as a tree of rows for the panel.

// Row: {kind: 'frame' | 'joint' | 'body', index, frame, children}
export function outline(scene) {
  const rows = scene.frames.map((_, i) => ({ kind: 'frame', index: i, frame: i, children: [] }));
  const placed = scene.frames.map(() => false);  // has something above it
  const above = scene.frames.map(() => -1);

  const hangs_below = (frame, upper) => {
    for (let i = upper; i >= 0; i = above[i]) if (i === frame) return true;
    return false;
  };
  // A frame below another, by way of `via` (a joint's row) if there is one.
  const hang = (frame, upper, via) => {
    if (placed[frame] || hangs_below(frame, upper)) {
      if (via) rows[upper].children.push(via);
      return;
    }
    placed[frame] = true;
    above[frame] = upper;
    if (via) via.children.push(rows[frame]);
    rows[upper].children.push(via ?? rows[frame]);
  };

  scene.joints.forEach((joint, i) => hang(joint.after, joint.before, { kind: 'joint', index: i, frame: joint.after, children: [] }));
  scene.links.forEach((link) => hang(link.to, link.from, null));
  scene.frames.forEach((frame, i) => {
    if (!placed[i] && (frame.parent ?? -1) >= 0) hang(i, frame.parent, null);
  });
  scene.bodies.forEach((body, i) => rows[body.frame].children.unshift({ kind: 'body', index: i, frame: body.frame, children: [] }));
  return rows.filter((_, i) => !placed[i]);
}
