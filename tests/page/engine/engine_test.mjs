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
/// To a time, however long it takes.
function go_to(t) {
  while (engine.time < t) engine.step(t - engine.time);
}
const pose_of = (c, frame, q) => engine.poses(q).subarray(7 * c.frames.indexOf(frame), 7 * c.frames.indexOf(frame) + 7);

test("it says what it was made of", () => {
  const current = execFileSync("sh", [join(folder, "sources.sh")], { encoding: "utf8" }).trim();
  const [version, sources, headers] = engine.version.split(", ");
  const [version_now, sources_now, headers_now] = current.split(", ");
  assert.equal(version, version_now, `kte.wasm is of another version of kte: ${rebuild}`);
  assert.equal(sources, sources_now, `kte.wasm is of other sources of the engine: ${rebuild}`);
  if (headers !== headers_now) console.log(`# headers of kte have changed since kte.wasm was made; to have them in it, ${rebuild}`);
});
test("it has all elements", () => assert.deepEqual(engine.elements, reference.elements, rebuild));
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
