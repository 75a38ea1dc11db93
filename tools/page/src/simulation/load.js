// The engine for a scene: kte in WebAssembly with the scene's model and tracks, or the reason why not.

import { load_engine } from '../../engine/engine.js';

// The name of the first frame on each track.
export function track_names(scene) {
  const names = new Array(scene.tracks).fill(null);
  for (const frame of scene.frames) if ((frame.track ?? -1) >= 0) names[frame.track] ??= frame.name;
  return names;
}

// Throws an Error with a sentence for the user.
export async function load_simulation_engine(scene) {
  if (scene.model === null || scene.model === undefined) {
    throw new Error('The mechanism has elements of its program\u2019s own, or came without its model: it can be played here, not moved or simulated.');
  }
  if (typeof WebAssembly !== 'object') throw new Error('This browser has no WebAssembly: the mechanism can be played, not moved or simulated.');
  const names = track_names(scene);
  if (names.includes(null)) throw new Error('Not every track of the scene has a frame.');
  const engine = await load_engine(await window.kte_unpack('kte-engine'));
  engine.load(scene.model);
  if (engine.nq !== scene.state.q.length || engine.nv !== scene.state.v.length) {
    throw new Error(`The model has ${engine.nq} numbers in q and ${engine.nv} in v, the scene ${scene.state.q.length} and ${scene.state.v.length}.`);
  }
  engine.track(names);
  return engine;
}
