"""Rows, events and names of columns of recordings, and means over time in sweeps."""
import base64
import pathlib
import pickle
import re

import numpy as np
import pytest

import kte

DOCS = pathlib.Path(__file__).parents[2] / "docs"
G, START, RESTITUTION = 9.81, 0.5, 0.8


@pytest.fixture
def ball():
    """A point of 2 kg on a vertical guide, above a floor; v is upwards."""
    return kte.Chain(
        kte.prismatic_joint_3D("z", "ground", "ball", axis=[0, 0, 1]),
        kte.inertia_3D("ball", mass=2),
        gravity=[0, 0, -G],
    )


@pytest.fixture
def contact_ball(ball):
    return ball << kte.sphere_contact_3D(
        "floor", "ground", "ball", surface_axis=[0, 0, 1], surface_radius=0, radius=0, friction=0, restitution=RESTITUTION
    )


def bounce(t, q, v):
    return [0.0], -RESTITUTION * v


FLOOR = kte.Event(lambda t, q, v: q[0], "falling", reset=bounce, name="floor", one_sided=True)


def flights():
    """Start, velocity at the start and height there, of the flights of the ball."""
    t, v, z = 0.0, 0.0, START
    while True:
        yield t, v, z
        time = (v + np.sqrt(v * v + 2 * G * z)) / G
        t, v, z = t + time, RESTITUTION * (G * time - v), 0.0


def height_at(times):
    out = []
    for t in times:
        begin, v, z = [f for f, _ in zip(flights(), range(12)) if f[0] <= t][-1]
        out.append(z + v * (t - begin) - G / 2 * (t - begin) ** 2)
    return np.array(out)


def mean_height(end):
    total, all_flights = 0.0, flights()
    flight = next(all_flights)
    while flight[0] < end:
        (t, v, z), flight = flight, next(all_flights)
        d = min(end, flight[0]) - t
        total += z * d + v * d**2 / 2 - G / 6 * d**3
    return total / end


def test_rows_are_those_asked_for_and_events_a_list_of_their_own(ball):
    at = [0.5, 1, 1.5]
    motion = kte.simulate(ball, [START], time=1.5, at=at, events=FLOOR)
    assert len(motion) == 3 and motion.t.tolist() == at and motion.q.shape == motion.v.shape == (3, 1)
    assert motion.z.shape == (3, 0) and motion.u.shape == (3, 0)
    np.testing.assert_allclose(motion.q[:, 0], height_at(at), atol=1e-9)
    landings = [f[0] for f, _ in zip(flights(), range(5))][1:4]
    assert [e.name for e in motion.events[:3]] == ["floor"] * 3
    np.testing.assert_allclose([e.time for e in motion.events[:3]], landings, atol=1e-9)
    assert all(e.v[0] == -RESTITUTION * e.v_before[0] for e in motion.events)
    assert repr(motion).startswith("<kte.Recording: 3 rows from t = 0.5 to 1.5 s, ")
    even = kte.simulate(ball, [START], time=1.5, every=0.25, events=FLOOR)
    assert even.t.tolist() == [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5]
    assert list(even.to_pandas(["z"]).t) == even.t.tolist()


def test_event_rows_are_in_tables_on_demand(ball):
    motion = kte.simulate(ball, [START], time=1.5, at=[0.5, 1, 1.5], events=FLOOR)
    for copied in (motion, pickle.loads(pickle.dumps(motion))):
        rows = copied.columns(["z", "z/v"], event_rows=True)
        assert len(rows["t"]) == 3 + 2 * len(motion.events) and (np.diff(rows["t"]) >= 0).all()
        first = motion.events[0]
        before, after = np.flatnonzero(rows["t"] == first.time)
        assert rows["z/v"][before] == first.v_before[0] and rows["z/v"][after] == first.v[0]
        assert copied.t.tolist() == [0.5, 1, 1.5] == copied.columns(["z"])["t"].tolist()
    assert len(motion.to_pandas(["z"], event_rows=True)) == len(rows["t"])


def test_a_row_at_an_event_has_the_state_after_it(ball):
    step = kte.Event(lambda t, q, v: t - 0.5, reset=lambda t, q, v: (q + 1, v), name="step")
    motion = kte.simulate(ball, [0.0], time=1, at=[0.25, 0.5, 0.5, 1], events=step)
    assert motion.t.tolist() == [0.25, 0.5, 0.5, 1]
    np.testing.assert_allclose(motion.q[1:3, 0], 1 - G / 2 * 0.25)
    assert motion.columns(["z"], event_rows=True)["t"].tolist() == [0.25, 0.5, 0.5, 0.5, 1]
    stop = kte.Event(lambda t, q, v: t - 0.5, terminal=True, name="stop")
    assert kte.simulate(ball, [0.0], time=1, at=[0.25, 0.5, 1], events=stop).t.tolist() == [0.25, 0.5]
    assert kte.simulate(ball, [0.0], time=1, at=[0.25, 1], events=stop).t.tolist() == [0.25]
    for every, times in [(0.4, [0, 0.4, 0.5]), (0.25, [0, 0.25, 0.5])]:  # even times have the end
        motion = kte.simulate(ball, [0.0], time=1, every=every, events=stop)
        assert motion.t.tolist() == times == motion.columns(["z"], event_rows=True)["t"].tolist()
    steps = kte.simulate(ball, [0.0], time=1, every=None, events=step)
    assert (steps.t == 0.5).sum() == 2 and len(steps) == len(steps.columns(["z"], event_rows=True)["t"])


def test_pages_show_the_states_before_and_after_events(ball, tmp_path):
    motion = kte.simulate(ball, [START], time=1.5, at=[0.5, 1, 1.5], events=FLOOR)
    kte.view(motion, tmp_path / "page.html", columns=["z/v", "energy/total"])
    page = (tmp_path / "page.html").read_text()
    assert int(re.search(r'"count": ?(\d+)', page)[1]) == 3 + 2 * len(motion.events)
    data = re.search(r'"energy/total", ?"unit": ?"J", ?"data": ?"([^"]+)"', page)[1]
    energies = np.frombuffer(base64.b64decode(data), dtype=np.float32)
    np.testing.assert_allclose(energies, motion.columns(["energy/total"], event_rows=True)["energy/total"], rtol=1e-6)


@pytest.mark.parametrize("solver", ["dormand_prince45", "moreau_jean"])
def test_means_of_sweeps_are_over_time(contact_ball, solver):
    run = kte.SimulationRun(contact_ball, [START], time=1.5, every=1e-3, solver=solver, step=1e-4)
    kept = kte.sweep(kte.one_of("v/z", [0.0]), run, ["mean:z", "min:z", "max:z", "mean:z/v"])
    assert kept["mean:z"][0] == pytest.approx(mean_height(1.5), rel=1e-5 if solver == "dormand_prince45" else 1e-2)
    assert kept["max:z"][0] == START and abs(kept["min:z"][0]) < 1e-4
    end = height_at([1.5])[0]
    assert kept["mean:z/v"][0] == pytest.approx((end - START) / 1.5, abs=1e-3)  # the integral of v


@pytest.mark.parametrize("solver", ["dormand_prince45", "moreau_jean"])
def test_sweeps_have_the_contact_forces_of_the_solver(contact_ball, solver):
    run = kte.SimulationRun(contact_ball, [0.1], time=3.0, every=0.5, solver=solver)
    kept = kte.sweep(kte.one_of("v/z", [0.0]), run, ["floor/force/z", "max:floor/force/z", "z/a"])
    motion = kte.simulate(contact_ball, [0.1], time=3.0, every=0.5, solver=solver)
    assert kept["floor/force/z"][0] == motion["floor/force/z"][-1] == pytest.approx(2 * G)
    assert kept["max:floor/force/z"][0] == motion.columns(["floor/force/z"], event_rows=True)["floor/force/z"].max()
    assert kept["z/a"][0] == motion["z/a"][-1] == pytest.approx(0, abs=1e-9)


def test_the_mean_of_a_sine_and_of_a_last_interval_that_is_shorter(ball):
    spring = ball << kte.joint_stiffness_gen("z", stiffness=2.0)  # w = 1/s about -m g / k
    rest = -2 * G / 2
    run = kte.SimulationRun(spring, [rest + 1], time=2.0, every=0.15)
    kept = kte.sweep(kte.one_of("v/z", [0.0]), run, ["mean:z"])["mean:z"][0]
    t = np.append(np.arange(0, 2, 0.15), 2)
    z = rest + np.cos(t)
    assert kept == pytest.approx(((z[1:] + z[:-1]) / 2 * np.diff(t)).sum() / 2, rel=1e-8)
    assert kept == pytest.approx(rest + np.sin(2) / 2, abs=2e-3)
    still = kte.sweep(kte.one_of("v/z", [0.0]), kte.SimulationRun(spring, [rest + 1], time=0.0), ["mean:z"])
    assert still["mean:z"][0] == rest + 1


def everything():
    """A chain with the objects that docs/recorders.md names, and a configuration."""
    chain = kte.Chain(
        kte.prismatic_joint_3D("q", "ground", "slide", axis=[1, 0, 0]),
        kte.spherical_joint_3D("ball", "slide", "tip"),
        kte.inertia_3D("tip", mass=1, inertia=[1, 0, 0, 1, 0, 1]),
        kte.free_joint_3D("x", "ground", "body"),
        kte.inertia_3D("body", mass=1, inertia=[1, 0, 0, 1, 0, 1]),
        kte.driving_actuator_gen("q", "motor"),
        kte.joint_lugre_gen("q", "bristle", 100, 1, 0.1, 1, 1.5, 0.1),
        kte.sphere_contact_3D("foot", "ground", "body", surface_axis=[0, 0, 1], surface_radius=0, radius=0.1, friction=0.5),
    )
    q = kte.neutral_configuration(chain)
    q[next(c.q.start for c in chain.layout if c.name == "x") + 2] = 1  # above the ground
    return chain, q


def names_of_docs():
    """Object, names of quantities: of the table in docs/recorders.md."""
    text = (DOCS / "recorders.md").read_text()
    table = text[text.index("| object | quantities |") :].split("\n\n")[0]
    for row in table.splitlines()[2:]:
        what, names = row.strip("| ").split(" | ")
        yield what, re.findall(r"`([^`]+)`", names.split(": in ")[0])


def test_every_name_of_a_column_selects_it(ball):
    ball << kte.external_force_3D("ball", "thrust", "torque")
    inputs = {"thrust": [1, 2, 30], "torque": [0, 0, 0]}
    motion = kte.simulate(ball, [1.0], time=1, every=0.5, inputs=inputs, control=[0.5])
    chain, q = everything()
    other = kte.simulate(chain, q, time=0.1, every=0.1, control=np.zeros(chain.nv), inputs={"motor": [1.0]})
    for m in (motion, other):
        columns = m.columns()
        assert {"t", "tau/z" if m is motion else "tau/ball/x"} <= set(columns)
        for name, numbers in columns.items():
            assert np.array_equal(m[name], numbers), name
            assert list(m.columns([name])) == (["t", name] if name != "t" else ["t"])
    assert motion["thrust/z"].tolist() == [30, 30, 30] and motion["thrust"].shape == (3, 3)
    assert list(motion[["t", "z"]]) == ["t", "z"] and list(motion[["z"]]) == ["z"]


def test_docs_list_the_names_of_columns():
    chain, q = everything()
    motion = kte.simulate(chain, q, time=0.1, every=0.1, inputs={"motor": [1.0]})
    renamed = {"a rotation in space": {"x": "ball"}, "a pose or frame in space": {}, "an internal state": {"x": "bristle"}}
    documented = []
    for what, names in names_of_docs():
        if what in ("a pose or frame in the plane", "an input", "a closure"):
            continue
        for name in names:
            item, slash, rest = name.partition("/")
            documented.append(renamed.get(what, {}).get(item, item) + slash + rest)
    assert {"energy/total", "ball/torque", "x/ang_velocity", "foot/mode", "q/f", "bristle/v"} <= set(documented)
    found = motion.columns(documented + ["motor"])
    assert set(motion.columns()) <= set(found) | {
        f"{f}/{x}" for f in ("ground", "slide", "tip", "body") for x in
        [f"position/{c}" for c in "xyz"] + [f"rotation/{c}" for c in "wxyz"]
    }
    for line in re.findall(r"energy/\w+", (DOCS.parent / "README.md").read_text() + (DOCS / "kte.md").read_text()):
        assert line in found


def test_energies_are_columns_of_recordings_and_sweeps(ball):
    motion = kte.simulate(ball, [1.0], [2.0], time=0.5, every=0.25)
    kinetic, potential = motion.v[:, 0] ** 2, 2 * G * motion.q[:, 0]
    np.testing.assert_allclose(motion["energy/kinetic"], kinetic)
    np.testing.assert_allclose(motion["energy/potential"], potential)
    np.testing.assert_allclose(motion["energy/total"], kinetic + potential)
    assert list(motion.columns(["z", "energy/total", "z/v"])) == ["t", "z", "energy/total", "z/v"]
    assert np.array_equal(motion.columns(["z", "energy/total", "z/v"])["z/v"], motion.v[:, 0])
    run = kte.SimulationRun(ball, [1.0], [2.0], time=0.5, every=1e-3)
    for packs in (True, False):
        kept = kte.sweep(kte.evenly("ball/mass", 1, 2, 2), run, ["energy/total", "z"], packs=packs)
        np.testing.assert_allclose(kept["energy/total"], [kte.energy(ball, [1.0], [2.0]).kinetic / 2 + G, motion["energy/total"][-1]])
    kept = kte.sweep(kte.evenly("v/z", 2, 3, 2), run, ["mean:energy/potential"])["mean:energy/potential"]
    assert kept[0] == pytest.approx(2 * G * (1 + 0.5 - G / 6 * 0.25), rel=1e-6)
    passes = kte.sweep(kte.evenly("q/z", 0, 1, 2), kte.OperationRun("passes", ball, [0.0]), ["energy/potential"])
    np.testing.assert_allclose(passes["energy/potential"], [0, 2 * G])
    for name in ("t", "mean:t"):
        with pytest.raises(kte.UnknownName, match="cannot keep 't', the time: 'run/end_time'"):
            kte.sweep(kte.evenly("q/z", 0, 1, 2), run, [name])


def test_nothing_replaces_the_time():
    chain = kte.Chain(kte.prismatic_joint_3D("t", "ground", "body", axis=[1, 0, 0]), kte.inertia_3D("body", mass=1))
    motion = kte.simulate(chain, [5.0], [1.0], time=1, every=0.5)
    assert motion["t"].tolist() == motion.columns()["t"].tolist() == [0, 0.5, 1]
    assert motion["coordinate:t"].tolist() == [5, 5.5, 6] and "coordinate:t/v" in motion.columns()
    assert motion["t/v"].tolist() == [1, 1, 1]
    slash = kte.Chain(
        kte.prismatic_joint_3D("a", "ground", "b", axis=[1, 0, 0]), kte.prismatic_joint_3D("a/v", "b", "c", axis=[0, 1, 0])
    )
    slash << kte.inertia_3D("c", mass=1)
    motion = kte.simulate(slash << kte.inertia_gen("a", 1.0), [0.0, 0.0], time=1, every=1.0)
    with pytest.raises(kte.BadArgument, match="two quantities have the column 'a/v'"):
        motion.columns()
    assert list(motion.columns(["a", "a/v"])) == ["t", "a", "a/v"]


def test_notebooks_show_tables(pendulum, iiwa):
    motion = kte.simulate(pendulum, [0.0], time=0.1)
    table = kte.sweep(kte.evenly("x", 0, 1, 100), lambda c: {"<k>": c["x"]}, "<k>")
    assert "revolute_joint_2D" in pendulum._repr_html_() and "mass 1" in pendulum._repr_html_()
    assert "<td>q1</td><td>coordinate</td><td>-2.96706</td>" in iiwa._repr_html_()
    assert "<th>column</th>" in motion._repr_html_() and motion._repr_html_().count("<tr>") == len(list(motion)) + 1
    shown = table._repr_html_()
    assert "&lt;k&gt;" in shown and "and 60 more" in shown and shown.count("<tr>") == 42
