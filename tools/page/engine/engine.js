// kte in a page: runtime chains of model files, simulated by kte.wasm. README.md has a description of all calls.

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/// An engine of the bytes of kte.wasm.
export async function load_engine(wasm_bytes) {
  const module = await WebAssembly.compile(wasm_bytes);
  return new Engine(module, await WebAssembly.instantiate(module, imports_of(module)));
}

// kte.wasm needs nothing of its surroundings; what its C library might want of a system fails.
function imports_of(module) {
  const not_supported = 52;  // ENOSYS of WASI
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module))
    (imports[from] ??= {})[name] = name === "proc_exit" ? () => { throw new Error("kte: the engine has stopped"); } : () => not_supported;
  return imports;
}

class Engine {
  #module;
  #kte = null;  // the functions of kte.wasm; null after it has broken down
  tracks = 0;

  constructor(module, instance) {
    this.#module = module;
    this.#begin(instance);
  }
  #begin(instance) {
    this.#kte = instance.exports;
    this.#kte._initialize();
  }

  /// Reads a model file's text in JSON; the simulation of the last one is gone. After an error the last model stays.
  load(model_json) {
    if (!this.#kte) this.#begin(new WebAssembly.Instance(this.#module, imports_of(this.#module)));
    this.#call("kte_load", this.#put_text(model_json));
    this.tracks = 0;
  }
  /// Numbers of a configuration and of velocities; 0 without a model.
  get nq() { return this.#run("kte_nq"); }
  get nv() { return this.#run("kte_nv"); }

  /// Chooses the frames of `poses`, in this order.
  track(names) {
    for (const name of names) this.#call("kte_name", this.#put_text(name));
    this.#call("kte_track");
    this.tracks = names.length;
  }
  /// Of each tracked frame x y z w x y z, its position and quaternion in the world, as a Float64Array.
  poses(q) {
    this.#call("kte_poses", this.#put_numbers(q));
    return this.#take(0, 7 * this.tracks);
  }
  /// Forward dynamics at q and v.
  accelerations(q, v) {
    this.#put_numbers([...q, ...v]);
    this.#call("kte_accelerations", q.length, v.length);
    return this.#take(0, this.nv);
  }

  /// Begins a simulation at t = 0.
  start(q, v) {
    this.#put_numbers([...q, ...v]);
    this.#call("kte_start", q.length, v.length);
  }
  /// Goes on by dt, s, but works no longer than about these milliseconds: returns the time that it has reached.
  step(dt, milliseconds = 12) { return this.go_to(this.time + dt, milliseconds); }
  /// The same to a time.
  go_to(t, milliseconds = 12) {
    const latest = performance.now() + milliseconds;
    do this.#call("kte_step", t);
    while (this.time < t && performance.now() < latest);
    return this.time;
  }
  /// The time of the simulation, s.
  get time() { return this.#run("kte_time"); }
  /// { t, q, v, signals, energy: { kinetic, potential }, stiff }: signals as `loads` takes them; the energy of the
  /// mechanism alone, J; whether a method for stiff systems is at work.
  state() {
    this.#call("kte_state");
    const nq = this.nq, nv = this.nv;
    const [t, kinetic, potential, stiff, signals] = this.#take(0, 5);
    return { t, q: this.#take(5, nq), v: this.#take(5 + nq, nv), signals: this.#take(5 + nq + nv, signals), energy: { kinetic, potential }, stiff: stiff !== 0 };
  }

  /// What acts in the mechanism at q, v and signals: the numbers of inputs, of vectors (three each) and of internal states,
  /// in the order in which they come first in the model. What is not known is NaN, and so are loads that depend on it.
  /// Without v and signals at rest, with inputs as in the file. free = false: something else acted as well, and so
  /// accelerations are not known.
  ///
  ///   loads      [{ element, frame or coordinate: which of those of the element, force, torque }]
  ///   reactions  [{ force, torque }] of each tracked frame: of the joint or link that moves it on what is beyond
  ///   accelerations  of all coordinates
  ///
  /// On frames in axes of the world, at their origin; on coordinates of one number force[0], N or Nm, on others in the axes
  /// of the frame that moves by them. A pull is the element after those of the model.
  loads(q, v = [], signals = [], t = 0, free = true) {
    this.#put_numbers([...q, ...v, ...signals]);
    this.#call("kte_loads", q.length, v.length, signals.length, t, free ? 1 : 0);
    return this.#take_loads();
  }
  /// The same of the simulation as it is now, damping included.
  loads_now() {
    this.#call("kte_loads_now");
    return this.#take_loads();
  }
  #take_loads() {
    const [count] = this.#take(0, 1), nv = this.nv, end = 9 * count + 6 * this.tracks, numbers = this.#take(1, end + nv);
    const load_at = (i) => ({ force: [...numbers.subarray(i, i + 3)], torque: [...numbers.subarray(i + 3, i + 6)] });
    const loads = Array.from({ length: count }, (_, i) => {
      const [element, on_frame, which] = numbers.subarray(9 * i, 9 * i + 3);
      return { element, [on_frame ? "frame" : "coordinate"]: which, ...load_at(9 * i + 3) };
    });
    const accelerations = numbers.slice(end);
    return { loads, accelerations, reactions: Array.from({ length: this.tracks }, (_, k) => load_at(9 * count + 6 * k)) };
  }

  /// Pulls a point of a frame (in its axes, m) to a target in the world by a spring (N/m) with damping (N s/m). Called
  /// again it moves the target. A frame null ends it.
  pull(frame, point = [0, 0, 0], target = [0, 0, 0], stiffness = 0, damping = 0) {
    const [x, y, z = 0] = point, [u, v, w = 0] = target;
    if (frame !== null) this.#call("kte_name", this.#put_text(frame));
    this.#call("kte_pull", x, y, z, u, v, w, stiffness, damping);
  }
  /// Damps all coordinates by -c times their velocities, N s/m and Nm s/rad.
  damping(c) { this.#call("kte_damping", c); }

  /// What kte.wasm was made of.
  get version() { return this.#text(this.#run("kte_version")); }
  /// The elements that models may have.
  get elements() {
    const bytes = this.#run("kte_elements");
    return decoder.decode(new Uint8Array(this.#kte.memory.buffer, this.#room(0), bytes)).trim().split(" ");
  }

  // ---- calls
  #run(name, ...args) {
    if (!this.#kte) throw new Error("kte: the engine has broken down: load a model");
    try {
      return this.#kte[name](...args);
    } catch (e) {
      this.#kte = null;
      throw new Error(`kte: the engine has broken down (${e.message}): load a model`);
    }
  }
  #call(name, ...args) {
    if (this.#run(name, ...args) !== 0) throw new Error(this.#text(this.#run("kte_message")));
  }
  // ---- the buffer of arguments and results
  #room(bytes) {
    const at = this.#run("kte_buffer", bytes);
    if (at === 0) throw new Error("kte: not enough memory");
    return at;
  }
  #put_text(text) {
    const bytes = encoder.encode(text);
    const at = this.#room(bytes.length);
    new Uint8Array(this.#kte.memory.buffer, at, bytes.length).set(bytes);
    return bytes.length;
  }
  #put_numbers(numbers) {
    const at = this.#room(8 * numbers.length);
    new Float64Array(this.#kte.memory.buffer, at, numbers.length).set(numbers);
    return numbers.length;
  }
  #take(first, count) {
    return new Float64Array(this.#kte.memory.buffer, this.#room(0) + 8 * first, count).slice();
  }
  #text(at) {
    const bytes = new Uint8Array(this.#kte.memory.buffer, at);
    return decoder.decode(bytes.subarray(0, bytes.indexOf(0)));
  }
}
