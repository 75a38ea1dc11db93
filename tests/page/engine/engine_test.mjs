// kte.wasm against kte as it is compiled here: node engine_test.mjs ENGINE_FOLDER REFERENCE.json
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, reference_file] = process.argv.slice(2);
const { load_engine } = await import(pathToFileURL(join(folder, "engine.js")));
const reference = JSON.parse(readFileSync(reference_file, "utf8"));
const wasm = readFileSync(join(folder, "kte.wasm"));
const engine = await load_engine(wasm);
const rebuild = "remake it by tools/page/engine/build.sh";

const tests = [];
const test = (name, body) => tests.push([name, body]);
function near(got, wanted, margin, what) {
  assert.equal(got.length, wanted.length, `${what}: ${got.length} numbers, not ${wanted.length}`);
  for (let i = 0; i < got.length; ++i)
    assert.ok(Math.abs(got[i] - wanted[i]) <= margin * Math.max(1, Math.abs(wanted[i])),
      `${what}, number ${i}: ${got[i]}, not ${wanted[i]}`);
}
function message_of(call) {
  try {
    call();
  } catch (e) {
    assert.ok(e instanceof Error && e.message.startsWith("kte: "), `'${e.message}'`);
    return e.message;
  }
  assert.fail("no error");
}
const case_of = (name) => reference.cases.find((c) => c.name === name);
function begin(name) {
  const c = case_of(name);
  engine.load(c.model);
  engine.track(c.frames);
  engine.start(c.q, c.v);
  return c;
}
const go_to = (t) => engine.go_to(t, Infinity);  // however long it takes
const pose_of = (c, frame, q) => engine.poses(q).subarray(7 * c.frames.indexOf(frame), 7 * c.frames.indexOf(frame) + 7);

test("it says what it was made of", () => {
  const current = execFileSync("sh", [join(folder, "sources.sh")], { encoding: "utf8" }).trim();
  const [version, sources, headers] = engine.version.split(", ");
  const [version_now, sources_now, headers_now] = current.split(", ");
  assert.equal(version, version_now, `kte.wasm is of another version of kte: ${rebuild}`);
  assert.equal(sources, sources_now, `kte.wasm is of other sources of the engine: ${rebuild}`);
  if (headers !== headers_now) console.log(`# headers of kte have changed since kte.wasm was made; to have them in it, ${rebuild}`);
});
test("it has all elements", () => {
  const missing = reference.elements.filter((type) => !engine.elements.includes(type));
  assert.deepEqual(missing, [], `kte.wasm lacks ${missing.join(", ")}: ${rebuild}`);
  const former = engine.elements.filter((type) => !reference.elements.includes(type));
  assert.deepEqual(former, [], `kte.wasm has ${former.join(", ")}, which kte has no more: ${rebuild}`);
});
test("it needs nothing of its surroundings", () =>
  assert.deepEqual(WebAssembly.Module.imports(new WebAssembly.Module(wasm)), []));
test("it is below 3 MB", () => assert.ok(wasm.length < 3e6, `${wasm.length} bytes`));

for (const c of reference.cases)
  test(`${c.name} as compiled here`, () => {
    engine.load(c.model);
    assert.deepEqual([engine.nq, engine.nv], [c.q.length, c.v.length]);
    engine.track(c.frames);
    near(engine.poses(c.q), c.poses, 2e-15, "poses");
    near(engine.accelerations(c.q, c.v), c.accelerations, 1e-12, "accelerations");
    engine.start(c.q, c.v);
    for (const call of c.calls) {
      if (call.pull !== undefined) engine.pull(call.pull, call.point, call.target, call.stiffness, call.damping);
      if (call.damp !== undefined) engine.damping(call.damp);
      if (call.to === undefined) continue;
      go_to(call.to);
      const s = engine.state();
      assert.equal(s.t, call.to);
      near(s.q, call.q, 1e-9, `q at ${call.to} s`);
      near(s.v, call.v, 1e-9, `v at ${call.to} s`);
      near([s.energy.kinetic, s.energy.potential], call.energy, 1e-9, `energies at ${call.to} s`);
      assert.equal(s.stiff, call.stiff, "stiff");
    }
    engine.pull(null);
    engine.damping(0);
  });

test("bad models are refused with their place", () => {
  assert.match(message_of(() => engine.load("")), /empty/);
  assert.match(message_of(() => engine.load("{\"kte_model\": {")), /the model:1:\d+: /);
  assert.match(message_of(() => engine.load("no JSON")), /the model:1:1: /);
  const { model } = case_of("pendulum");
  assert.match(message_of(() => engine.load(model.replace("rigid_link_2D", "rigid_lnk_2D"))),
    /the model:\d+:\d+: element 2: there is no element type 'rigid_lnk_2D'/);
  assert.match(message_of(() => engine.load(model.replace("\"mass\": \"1\"", "\"mass\": \"-1\""))),
    /the model:\d+:\d+: element 3: inertia_2D.*mass/);
  assert.match(message_of(() => engine.load(model.replace("\"base\": \"joint\"", "\"base\": \"nowhere\""))), /element 2: .*nowhere/);
  assert.match(message_of(() => engine.load("[".repeat(100000))), /the model/);
});
test("after an error all is as before", () => {
  const c = begin("pendulum");
  go_to(0.5);
  const before = engine.state();
  for (const call of [() => engine.load("{"), () => engine.track(["tip", "tpi"]), () => engine.pull("tpi"),
    () => engine.poses([1, 2]), () => engine.start([1], [1, 2]), () => engine.start([NaN], [0]), () => engine.step(NaN),
    () => engine.damping(-1), () => engine.pull("tip", [0, 0], [0, Infinity], 1, 1)]) message_of(call);
  assert.deepEqual(engine.state(), before);
  assert.equal(engine.poses(c.q).length, 7 * c.frames.length);
});
test("names that do not exist are said", () => {
  begin("pendulum");
  assert.match(message_of(() => engine.track(["tpi"])), /'tpi'.*tip/);
  assert.match(message_of(() => engine.pull("tp\u0000\u{1F600}i")), /kte: /);
});
test("a thousand errors take no memory", () => {
  const { model } = case_of("solo12");
  const broken = model.slice(0, -3);
  for (let i = 0; i < 1000; ++i) message_of(() => engine.load(broken));
  engine.load(model);
});
test("many models, one after the other", () => {
  for (let i = 0; i < 20; ++i) for (const c of reference.cases) engine.load(c.model);
});
test("without a model every call says so", async () => {
  const fresh = await load_engine(wasm);
  for (const call of [() => fresh.track(["a"]), () => fresh.start([], []), () => fresh.state(), () => fresh.step(1),
    () => fresh.pull("a"), () => fresh.damping(1)]) assert.match(message_of(call), /no model has been loaded/);
  fresh.load(case_of("pendulum").model);
  assert.match(message_of(() => fresh.step(1)), /has not been started/);
});
test("a pull brings a frame to its target", () => {
  const c = begin("iiwa14");
  engine.damping(3);
  const target = [0.5, 0.2, 0.7];
  engine.pull("tool", [0, 0, 0], target, 5000, 100);
  go_to(6);
  const at = pose_of(c, "tool", engine.state().q);
  assert.ok(Math.hypot(...target.map((x, i) => x - at[i])) < 0.05, `at ${at}`);
  engine.pull(null);
  engine.damping(0);
});
test("damping takes energy, and without it it stays", () => {
  begin("iiwa14");
  const sum = () => { const { kinetic, potential } = engine.state().energy; return kinetic + potential; };
  const start = sum();
  go_to(1);
  assert.ok(Math.abs(sum() - start) < 1e-3);
  engine.damping(1);
  go_to(2);
  assert.ok(sum() < start - 1);
  engine.damping(0);
});
test("a step that takes too long comes back early and says how far", () => {
  begin("iiwa14");
  const reached = engine.step(1000, 5);
  assert.ok(reached > 0 && reached < 1000);
  assert.equal(engine.state().t, reached);
  assert.equal(engine.go_to(reached + 0.01), reached + 0.01);
});

// ---- what acts
const length = (v) => Math.hypot(...v);
const minus = (a, b) => a.map((x, i) => x - b[i]);
const times = (s, v) => v.map((x) => s * x);
/// At an element, on number `which` of its frames or coordinates.
function load_of(acting, element, on, which = 0) {
  return acting.loads.find((load) => load.element === element && load[on] === which);
}
const spring = 4, damper = 5, motor = 6, limit = 7, stiction = 11;  // of the case "acting"
const held = 2;

test("springs, dampers, limits, motors and weights as their formulas have them", () => {
  const c = begin("acting"), [q, h] = [0.4, 0], w = 0.7;
  const acting = engine.loads([q, h], [w, 0], [3, held]);
  const tip = [0.5 * Math.cos(q), 0.5 * Math.sin(q), 0], d = minus([1, 1, 0], tip), l = length(d), e = times(1 / l, d);
  const rate = [-w * tip[1], w * tip[0], 0], l_dot = -rate.reduce((sum, x, i) => sum + x * e[i], 0);
  near(load_of(acting, spring, "frame", 1).force, times(40 * (l - 0.3), e), 1e-13, "spring on tip");
  near(load_of(acting, spring, "frame", 0).force, times(-40 * (l - 0.3), e), 1e-13, "spring on hook");
  near(load_of(acting, damper, "frame", 1).force, times(2 * l_dot, e), 1e-13, "damper on tip");
  assert.equal(load_of(acting, motor, "coordinate").force[0], 3);
  near([load_of(acting, limit, "coordinate").force[0]], [-(100 * (q - 0.3) + 3 * w)], 1e-12, "limit");
  near([load_of(acting, stiction, "coordinate").force[0]], [2 * 9.81 * 0.5 * Math.cos(h)], 1e-12, "held by friction");
  near(load_of(engine.loads([q, h], [w, 0.2], [3, 0]), stiction, "coordinate").force.slice(0, 1),
    [-(20 + 10 * Math.exp(-4))], 1e-12, "sliding");
  // m (a - g) of what is at the end of a link
  near(acting.reactions[c.frames.indexOf("end")].force, [0, 2 * 9.81, 0], 1e-12, "reaction on end");
});
test("the reaction of a link moves its end", () => {
  const c = begin("pendulum"), q = 0.4, w = -0.3, [a] = engine.accelerations([q], [w]);
  near(engine.loads([q], [w]).accelerations, [a], 1e-14, "acceleration");
  const { force, torque } = engine.loads([q], [w]).reactions[c.frames.indexOf("tip")];
  const [x, y] = [0.5 * Math.cos(q), 0.5 * Math.sin(q)];
  near(force, [-a * y - w * w * x, a * x - w * w * y + 9.81, 0], 1e-12, "reaction");
  near(torque, [0, 0, 0], 1e-12, "torque");
});
test("in space, in axes of the world", () => {
  const c = begin("elastic");
  go_to(0.2);
  const { q, v, signals } = engine.state(), acting = engine.loads(q, v, signals);
  const hook = pose_of(c, "hook", q).slice(0, 3), body = pose_of(c, "body", q).slice(0, 3);
  const d = minus([...hook], [...body]), l = length(d);
  near(load_of(acting, 5, "frame", 1).force, times(40 * (l - 0.3) / l, d), 1e-12, "spring on body");
  near(load_of(acting, 5, "frame", 0).force, times(-40 * (l - 0.3) / l, d), 1e-12, "spring on hook");
  const beam = [0, 1].map((which) => load_of(acting, 3, "frame", which).force);
  near(beam[0], times(-1, beam[1]), 1e-10, "beam");
  // Newton's law of the hanging body: what acts on it, and what it hands on to the arm
  near(engine.loads_now().reactions.flatMap(({ force }) => force), acting.reactions.flatMap(({ force }) => force), 1e-12, "now");
});
test("what is not known is NaN, and nothing else", () => {
  begin("acting");
  const all = engine.loads([0.4, 0], [0.7, 0], [3, held]), without_v = engine.loads([0.4, 0], [NaN, NaN], [3, held]);
  assert.deepEqual(load_of(without_v, spring, "frame", 1), load_of(all, spring, "frame", 1));
  assert.ok(load_of(without_v, damper, "frame", 1).force.slice(0, 2).every(Number.isNaN));
  const without_u = engine.loads([0.4, 0], [0.7, 0], [NaN, held]);
  assert.ok(Number.isNaN(load_of(without_u, motor, "coordinate").force[0]));
  assert.deepEqual(load_of(without_u, damper, "frame", 1), load_of(all, damper, "frame", 1));
  const not_free = engine.loads([0.4, 0], [0.7, 0], [3, held], 0, false);
  assert.deepEqual(load_of(not_free, damper, "frame", 1), load_of(all, damper, "frame", 1));
  for (const some of [without_v, without_u, not_free]) {
    assert.ok(Number.isNaN(load_of(some, stiction, "coordinate").force[0]));
    assert.ok(some.reactions.some(({ force }) => Number.isNaN(force[0])));
  }
  const at_rest = engine.loads([0.4, 0]);
  assert.equal(load_of(at_rest, motor, "coordinate").force[0], 3);
  assert.equal(length(load_of(at_rest, damper, "frame", 1).force), 0);
  assert.match(message_of(() => engine.loads([0.4, 0], [1])), /1 velocities and 0 signals, not 2 and 2/);
});
test("a pull is the element after those of the model", () => {
  const c = begin("pendulum");
  go_to(0.3);
  engine.pull("tip", [0.1, 0, 0], [0.4, 0.4, 0], 100, 10);
  const { q, v } = engine.state(), [a] = q, [w] = v;
  const now = engine.loads_now(), { force, torque } = load_of(now, 3, "frame");
  const arm = [0.1 * Math.cos(a), 0.1 * Math.sin(a), 0], r = [6 * arm[0], 6 * arm[1], 0], rate = [-w * r[1], w * r[0], 0];
  const f = [0.4, 0.4, 0].map((t, i) => 100 * (t - r[i]) - 10 * rate[i]);
  near(force, f, 1e-11, "pull");
  near(torque, [0, 0, arm[0] * f[1] - arm[1] * f[0]], 1e-11, "its torque at the frame");
  assert.deepEqual(load_of(engine.loads(q, v), 3, "frame"), load_of(now, 3, "frame"));
  engine.pull(null);
  assert.equal(load_of(engine.loads(q, v), 3, "frame"), undefined);
});

// Not a check: how fast it is, against the program that made the reference.
if (process.argv.includes("--speed"))
  test("speed", () => {
    for (const c of reference.cases) {
      engine.load(c.model);
      let least = Infinity;
      for (let repeat = 0; repeat < 10; ++repeat) {
        const begin = performance.now();
        for (let i = 0; i < 2000; ++i) engine.accelerations(c.q, c.v);
        least = Math.min(least, (performance.now() - begin) / 2000 * 1e6);
      }
      console.log(`# ${c.name}: ${least.toFixed(0)} ns a call of forward dynamics, ${(least / c.nanoseconds).toFixed(2)} times native`);
    }
  });

let failed = 0;
for (const [name, body] of tests) {
  try {
    await body();
    console.log(`ok - ${name}`);
  } catch (e) {
    ++failed;
    console.log(`not ok - ${name}\n# ${e.stack.split("\n").slice(0, 6).join("\n# ")}`);
  }
}
console.log(`${tests.length - failed} passed, ${failed} failed`);
process.exitCode = failed === 0 ? 0 : 1;
