import collections
import copy
import json
import pickle
import subprocess
import sys
import threading
import time
import types

import numpy as np
import pytest

import kte

WITH_TOLERANCES = (
    "dormand_prince45 prince_dormand87 adams bdf rodas rosenbrock23 kennedy_carpenter34 "
    "tr_bdf2 trapezoidal"
).split()
OF_FIXED_STEP = "runge_kutta4 runge_kutta5 euler midpoint semi_implicit_euler implicit_midpoint moreau_jean".split()


@pytest.mark.parametrize("solver", WITH_TOLERANCES + OF_FIXED_STEP)
def test_all_solvers_agree(pendulum, solver):
    exact = kte.simulate(pendulum, [0.0], time=1, solver="prince_dormand87", tolerance=1e-12)
    found = kte.simulate(pendulum, [0.0], time=1, solver=solver, tolerance=1e-7, step=1e-4)
    assert found.q[-1] == pytest.approx(exact.q[-1], abs=1e-2 if "euler" in solver else 1e-4)
    assert found.statistics["steps"] > 10


def test_rows_are_where_they_are_wanted(pendulum):
    even = kte.simulate(pendulum, [0.0], time=1, every=0.25)
    assert even.t.tolist() == [0, 0.25, 0.5, 0.75, 1] and even.q.shape == (5, 1) == even.v.shape and len(even) == 5
    assert kte.simulate(pendulum, [0.0], time=1, every=0.3).t.tolist() == pytest.approx([0, 0.3, 0.6, 0.9, 1])
    some = kte.simulate(pendulum, [0.0], time=1, at=[0.1, 0.5])
    assert some.t.tolist() == [0.1, 0.5]
    steps = kte.simulate(pendulum, [0.0], time=1, every=None)
    assert steps.t[0] == 0 and steps.t[-1] == 1 and len(steps) == steps.statistics["steps"] + 1
    with pytest.raises(kte.BadArgument, match="every must be positive"):
        kte.simulate(pendulum, [0.0], time=1, every=0)
    with pytest.raises(TypeError, match="every must be a number, not '0.1'"):
        kte.simulate(pendulum, [0.0], time=1, every="0.1")


def test_columns_are_those_of_recorders(pendulum):
    motion = kte.simulate(pendulum, [0.3], time=1, every=0.1)
    np.testing.assert_allclose(motion["tip/position/x"], 0.5 * np.cos(motion.q[:, 0]), atol=1e-14)
    assert list(motion.columns(["q", "q/v"])) == ["t", "q", "q/v"]
    assert list(motion[["tip/velocity"]]) == ["tip/velocity/x", "tip/velocity/y"]
    table = motion.to_pandas(["q", "tip/position"])
    assert list(table.columns) == ["t", "q", "tip/position/x", "tip/position/y"] and len(table) == 11
    with pytest.raises(kte.UnknownName, match="nothing"):
        motion["nothing"]
    assert motion["tip/position"].shape == (11, 2) and np.array_equal(motion["tip/position"][:, 1], motion["tip/position/y"])
    assert "tip/position" in motion and "energy/total" in motion and "nothing" not in motion and 3 not in motion
    assert list(motion) == list(motion.columns())
    for array in (motion.t, motion.q, motion.v, motion.u):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0


def test_a_recording_as_an_xarray_dataset(pendulum):
    pytest.importorskip("xarray")
    motion = kte.simulate(pendulum, [0.3], time=1, every=0.1)
    data = motion.to_xarray(["q", "tip/position"])
    assert data.sizes == {"t": 11} and np.array_equal(data["q"].sel(t=0.5), motion["q"][5])


def test_recordings_are_pickled_and_copied(pendulum):
    motion = kte.simulate(pendulum, [0.3], time=1, every=0.1, control=[0.5], events=kte.Event(lambda t, q, v: q[0], name="low"))
    for copied in (pickle.loads(pickle.dumps(motion)), copy.deepcopy(motion)):
        assert np.array_equal(copied.t, motion.t) and np.array_equal(copied.q, motion.q) and np.array_equal(copied.u, motion.u)
        assert copied.statistics == motion.statistics and copied.reason == motion.reason and repr(copied) == repr(motion)
        assert copied.events[0].name == "low" and np.array_equal(copied.events[0].v, motion.events[0].v)
        assert np.array_equal(copied["tip/velocity/y"], motion["tip/velocity/y"]) and copied.chain == motion.chain
        assert kte.view(copied).text == kte.view(motion).text


def test_a_misspelt_option_is_named(pendulum):
    with pytest.raises(TypeError, match="simulate.. got an unexpected keyword argument 'tol'"):
        kte.simulate(pendulum, [0.3], time=1, tol=1e-6)
    later = kte.simulate(pendulum, [0.3], time=1, every=0.5, t=2, tolerance=1e-6, largest_step=0.01)
    assert later.t.tolist() == [2, 2.5, 3] and later.statistics["steps"] >= 100


def test_control_is_a_function_of_the_program(pendulum):
    control = lambda t, q, v: -20 * (q - 1) - 5 * v + kte.gravity_forces(pendulum, q)  # noqa: E731
    motion = kte.simulate(pendulum, [0.0], time=6, control=control)
    assert motion.q[-1] == pytest.approx([1], abs=1e-5)
    np.testing.assert_allclose(motion["tau/q"], [control(0, q, v)[0] for q, v in zip(motion.q, motion.v)], atol=1e-12)
    constant = kte.simulate(pendulum, [0.0], time=1, control=[2.0])
    by_function = kte.simulate(pendulum, [0.0], time=1, control=lambda t, q, v: 2.0)
    np.testing.assert_allclose(constant.q, by_function.q, atol=1e-12)


def test_control_acts_along_the_numbers_of_v(random):
    """One small step from rest: v = M^-1 tau dt, whatever the coordinates."""
    chain = kte.Chain(
        kte.free_joint_3D("trunk", "world", "body"),
        kte.inertia_3D("body", 3, inertia=[0.1, 0.2, 0.25]),
        kte.spherical_joint_3D("neck", "body", "head", position=[0, 0, 0.3]),
        kte.inertia_3D("head", 1, inertia=0.01),
        kte.planar_joint_3D("tray", "body", "cup"),
        kte.inertia_3D("cup", 0.5, [0.1, 0, 0], inertia=0.02),
        kte.revolute_joint_3D("hip", "body", "leg", [0, 1, 0]),
        kte.inertia_3D("leg", 1, [0, 0, -0.1], inertia=0.01),
    )
    q, tau, dt = kte.neutral_configuration(chain), random.standard_normal(chain.nv), 1e-6
    q = kte.integrate(chain, q, random.standard_normal(chain.nv))
    motion = kte.simulate(chain, q, time=dt, every=None, control=tau, solver="runge_kutta4", step=dt)
    np.testing.assert_allclose(motion.v[-1] / dt, kte.forward_dynamics(chain, q, 0 * tau, tau), rtol=1e-4, atol=1e-4)
    planar = kte.Chain(kte.free_joint_2D("puck", "table", "disc"), kte.inertia_2D("disc", 2, [0.1, 0], 0.25))
    motion = kte.simulate(planar, [0, 0, 1], time=dt, every=None, control=[1, 2, 3], solver="runge_kutta4", step=dt)
    expected = kte.forward_dynamics(planar, [0, 0, 1], [0, 0, 0], [1, 2, 3])
    np.testing.assert_allclose(motion.v[-1] / dt, expected, rtol=1e-4)


def test_inputs_are_numbers_or_functions():
    chain = kte.Chain(kte.prismatic_joint_3D("x", "a", "b", [1, 0, 0]), kte.inertia_gen("x", 2), kte.driving_actuator_gen("x", "u"))
    assert kte.simulate(chain, [0.0], time=1, inputs={"u": 4}).q[-1] == pytest.approx([1], rel=1e-9)
    assert kte.simulate(chain, [0.0], time=1, inputs={"u": lambda t, q, v: 12 * t}).q[-1] == pytest.approx([1], rel=1e-9)
    for mapping in (types.MappingProxyType({"u": 4}), collections.ChainMap({"u": 4})):
        assert kte.simulate(chain, [0.0], time=1, inputs=mapping).q[-1] == pytest.approx([1], rel=1e-9)
    with pytest.raises(TypeError, match=r"inputs must be a dict from signals to numbers or functions .*, not 4"):
        kte.simulate(chain, [0.0], time=1, inputs=4)
    with pytest.raises(kte.UnknownName, match=r"no input 'y' \(there are 'u'\)"):
        kte.simulate(chain, [0.0], time=1, inputs={"y": 1})
    simulation = kte.Simulation(chain, [0.0], inputs={"u": 4})
    simulation.advance(1.0)
    simulation.set_inputs({"u": 0})
    simulation.advance(2.0)
    assert simulation.v == pytest.approx([2]) and simulation.q == pytest.approx([3]) and simulation.t == 2


def test_a_sampled_controller_sets_forces_between_steps(pendulum):
    simulation = kte.Simulation(pendulum, [0.0], control=[0.0])
    for k in range(1, 301):
        simulation.set_control(kte.gravity_forces(pendulum, simulation.q) - 20 * (simulation.q - 1) - 5 * simulation.v)
        simulation.advance(k / 100)
    assert simulation.q == pytest.approx([1], abs=1e-2)
    with pytest.raises(kte.BadArgument, match="made without control"):
        kte.Simulation(pendulum, [0.0]).set_control([1.0])


@pytest.mark.parametrize("solver", ["dormand_prince45", "adams", "runge_kutta4", "moreau_jean"])
def test_a_control_with_a_sample_time(pendulum, solver):
    times, memory = [], []

    def law(t, q, v):
        times.append(t)
        memory.append(q[0])
        return 10 * (1 - q) - 2 * v - 0.1 * np.sum(memory)

    options = dict(solver=solver, step=1e-4)
    motion = kte.simulate(pendulum, [0.3], time=0.5, every=0.02, control=law, control_every=0.05, **options)
    assert times == pytest.approx([0.05 * k for k in range(10)], abs=1e-15)
    assert motion.t == pytest.approx(np.arange(26) * 0.02)
    # In between the forces are constant: simulations from sample to sample. Both integrate to 1e-9 a step, or alike.
    q, v, past = np.array([0.3]), np.array([0.0]), []
    for k in range(10):
        past.append(q[0])
        force = 10 * (1 - q) - 2 * v - 0.1 * np.sum(past)
        part = kte.simulate(pendulum, q, v, t=0.05 * k, time=0.05, every=None, control=force, **options)
        inside = (motion.t > 0.05 * k + 1e-9) & (motion.t < 0.05 * (k + 1) + 1e-9)
        np.testing.assert_allclose(motion["tau/q"][inside], force[0], rtol=1e-6)
        q, v = part.q[-1], part.v[-1]
    np.testing.assert_allclose([motion.q[-1], motion.v[-1]], [q, v], rtol=1e-7)
    steps = kte.simulate(pendulum, [0.3], time=0.2, every=None, control=law, control_every=0.05, solver=solver, step=0.01)
    assert (np.diff(steps.t) > 0).all() and steps.t[0] == 0 and steps.t[-1] == 0.2
    assert all(np.abs(steps.t - 0.05 * k).min() < 1e-15 for k in range(5))


def test_a_sample_time_goes_on_and_is_refused_by_name(pendulum):
    times = []
    law = lambda t, q, v: times.append(t) or [0.0]  # noqa: E731
    simulation = kte.Simulation(pendulum, [0.3], control=law, control_every=0.1)
    for end in (0.15, 0.3, 0.31):
        simulation.advance(end)
    assert times == pytest.approx([0, 0.1, 0.2, 0.3], abs=1e-15)
    with pytest.raises(kte.BadArgument, match="control_every goes forward in time only"):
        simulation.advance(0.2)
    for control, every, text in (([1.0], 0.1, "needs a control that is a function"), (law, 0, "positive and finite, got 0")):
        with pytest.raises(kte.BadArgument, match=text):
            kte.simulate(pendulum, [0.3], time=1, control=control, control_every=every)


def test_events_are_found_reset_and_end_a_simulation(pendulum):
    down = lambda t, q, v: q[0] + np.pi / 2  # noqa: E731
    seen = kte.simulate(pendulum, [0.0], time=2, events=[kte.Event(down, name="down"), kte.Event(down, "rising", name="up")])
    assert [e.name for e in seen.events] == ["down", "down", "up"]
    assert seen.events[0].time == pytest.approx(0.4185793, abs=1e-6)
    wall = kte.Event(down, "falling", reset=lambda t, q, v: (q, -0.5 * v), name="wall")
    bounced = kte.simulate(pendulum, [0.0], time=1, events=wall)
    first = bounced.events[0]
    assert first.v == pytest.approx(-0.5 * first.v_before) and bounced.q.min() > -np.pi / 2 - 1e-9
    stopped = kte.simulate(pendulum, [0.0], time=9, events=kte.Event(down, terminal=True, name="end"))
    assert (stopped.reason, stopped.stopped_by) == ("terminal", "end") and stopped.t[-1] == pytest.approx(first.time)
    with pytest.raises(TypeError, match=r"reset of 'wall' must return \(q, v\)"):
        kte.simulate(pendulum, [0.0], time=1, events=kte.Event(down, reset=lambda t, q, v: q, name="wall"))
    with pytest.raises(kte.BadArgument, match="direction of an event"):
        kte.simulate(pendulum, [0.0], time=1, events=kte.Event(down, "sideways"))


def test_sticking_friction_holds():
    sled = kte.Chain(
        kte.prismatic_joint_2D("x", "ground", "block", [1, 0]),
        kte.inertia_2D("block", 1),
        kte.joint_stiction_gen("x", "rest", coulomb=3, stiction=4),
    )
    motion = kte.simulate(sled, [0.0], [2.0], time=10)
    assert motion.v[-1] == 0 and motion.q[-1] == pytest.approx([0.619734], abs=1e-5) and motion.z.shape[1] == 1


def test_exceptions_of_functions_leave_the_simulation_usable(pendulum):
    def control(t, q, v):
        if t > 0.5 and not mended:
            raise RuntimeError("no power")
        return 0.0

    mended = []
    simulation = kte.Simulation(pendulum, [0.0], control=control)
    with pytest.raises(RuntimeError, match="no power"):
        simulation.advance(1.0, every=0.1)
    assert 0 < simulation.t <= 0.6 and len(simulation.recording) > 0
    mended.append(True)
    simulation.advance(1.0)
    assert simulation.q == pytest.approx(kte.simulate(pendulum, [0.0], time=1).q[-1], abs=1e-6)
    with pytest.raises(kte.BadArgument, match=r"the result of control has shape \(2,\), expected \(1,\)"):
        kte.simulate(pendulum, [0.0], time=1, control=lambda t, q, v: [1, 2])


def test_a_failure_of_an_integration_has_its_data(pendulum):
    with pytest.raises(kte.IntegrationFailure, match="integration stopped at t") as caught:
        kte.simulate(pendulum, [0.0], time=100, max_steps=10)
    assert caught.value.reason == "too_many_steps" and caught.value.time > 0
    with pytest.raises(kte.BadArgument, match="there is no solver 'magic', but dormand_prince45"):
        kte.simulate(pendulum, [0.0], time=1, solver="magic")


def test_a_simulation_runs_once_at_a_time(pendulum):
    simulation = kte.Simulation(pendulum, [0.0], control=[0.0])
    simulation.set_control(lambda t, q, v: simulation.advance(1.0))
    with pytest.raises(kte.BadArgument, match="is running already"):
        simulation.advance(1.0)


def test_control_c_stops_a_simulation(robots):
    code = f"""
import os, signal, threading, kte
signal.signal(signal.SIGINT, signal.default_int_handler)  # jobs in the background of a shell ignore it
simulation = kte.Simulation(kte.load_robot({str(robots / "iiwa14.urdf")!r}), [0.2] * 7)
threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    simulation.advance(1e6, every=1.0)
except KeyboardInterrupt:
    stopped = simulation.t
    simulation.advance(stopped + 0.1)
    print(0 <= stopped < 1e6, abs(simulation.t - stopped - 0.1) < 1e-9)
"""
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert out.stdout == "True True\n", out.stderr


def test_other_threads_run_during_a_simulation(iiwa):
    counts = []
    thread = threading.Thread(target=lambda: kte.simulate(iiwa, np.full(7, 0.2), time=10, tolerance=1e-11))
    thread.start()
    while thread.is_alive():
        counts.append(time.sleep(0.001))
    assert len(counts) > 3


def test_pages_show_chains_robots_and_recordings(pendulum, iiwa, tmp_path):
    for what in (pendulum, iiwa, kte.simulate(pendulum, [0.0], time=1), kte.simulate(iiwa, np.zeros(7), time=0.1)):
        page = kte.view(what, tmp_path / "page.html", title="A title", columns=[])
        text = (tmp_path / "page.html").read_text(encoding="utf-8")
        assert "A title" in text and text == page.text
        assert page._repr_html_().startswith("<iframe srcdoc=")
    inline = kte.view(kte.simulate(pendulum, [0.0], time=1), columns=["tip/velocity"], height=300)
    assert inline.path is None and 'height="300"' in inline._repr_html_() and "tip/velocity" in inline.text
    inline.save(tmp_path / "copy.html")
    assert (tmp_path / "copy.html").read_text(encoding="utf-8") == inline.text
    with pytest.raises(kte.BadFile):
        kte.view(pendulum, tmp_path / "no" / "page.html")


def scene_of(page):
    start = page.text.index('id="kte-scene">') + len('id="kte-scene">')
    return json.loads(page.text[start : page.text.index("</script>", start)])


def test_pages_plot_the_columns_that_were_asked_for(iiwa, pendulum):
    motion = kte.simulate(iiwa, np.zeros(7), time=0.1)
    first = list(motion.columns())[1]
    page = scene_of(kte.view(motion, columns=[f"{first}/f", first]))
    assert page["recordings"][0]["plotted"] == [f"{first}/f", first]
    assert scene_of(kte.view(pendulum, columns=["tip/velocity/x"]))["recordings"][0]["plotted"] == ["tip/velocity/x"]
    with pytest.raises(kte.UnknownName, match="nothing"):
        kte.view(pendulum, columns=["nothing"])


def test_pages_draw_the_ground_and_the_sphere_of_a_contact():
    ball = kte.Chain(
        kte.free_joint_3D("pose", "ground", "ball"),
        kte.inertia_3D("ball", mass=1, inertia=[0.004] * 3),
        kte.sphere_contact_3D("c", "ground", "ball", radius=0.1, friction=0.5),
        gravity=[0, 0, -9.81],
    )
    for what in (ball, kte.simulate(ball, [0, 0, 0.6, 1, 0, 0, 0], time=0.1)):
        shapes = scene_of(kte.view(what))["shapes"]
        assert [(x["frame"], x["type"], x["size"]) for x in shapes] == [(0, "plane", [0, 0]), (1, "sphere", [0.1])]


def test_pages_warn_of_meshes_that_are_not_drawn(tmp_path):
    (tmp_path / "bad.stl").write_text("solid x\nfacet\n")
    mesh = '<visual><geometry><mesh filename="{}"/></geometry></visual>'
    file = tmp_path / "r.urdf"
    file.write_text(f'<robot name="r"><link name="a">{mesh.format("bad.stl") * 2}{mesh.format(tmp_path / "none.stl")}</link></robot>')
    robot = kte.load_robot(file)
    with pytest.warns(kte.RobotWarning) as warned:
        page = kte.view(robot)
    texts = sorted(str(w.message) for w in warned)
    assert len(texts) == 2
    assert texts[0].startswith("kte: mesh 'bad.stl' is not drawn: bad.stl:") and texts[1].startswith("kte: mesh 'none.stl' is not drawn: it is")
    assert all(w.filename == __file__ for w in warned)
    assert str(tmp_path) not in page.text


def test_importing_is_quick_and_does_not_import_pandas():
    code = "import sys; import kte; print('pandas' in sys.modules, 'scipy' in sys.modules)"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.split() == ["False", "False"]


def test_rigid_contacts_need_time_stepping():
    ball = kte.Chain(
        kte.base_2D("ground"),
        kte.free_joint_2D("pose", "ground", "ball"),
        kte.inertia_2D("ball", mass=1, inertia=0.004),
        kte.sphere_contact_2D("floor", "ground", "ball", surface_axis=[0, 1], surface_radius=0, radius=0.1, friction=0.2),
        gravity=[0, -9.81],
    )
    motion = kte.simulate(ball, [0, 0.1, 0], [1, 0, 0], time=2, every=0.1, solver="moreau_jean", step=1e-4)
    assert motion.q[-1][0] == pytest.approx(1.44937485697643, abs=1e-5)  # it slips, then rolls
    # Axes of the ball turn in a step: (w h)^2/4 of the force where it rolls at 7.14 rad/s; more while it slips
    force = motion["floor/force/y"]
    assert force[1] == pytest.approx(9.81, abs=2e-3)
    np.testing.assert_allclose(force[2:], 9.81, rtol=(7.15 * 1e-4) ** 2 / 4)
    with pytest.raises(kte.BadArgument, match="'floor' is 0.05"):
        kte.simulate(ball, [0, 0.05, 0], time=1, solver="moreau_jean")


def counted(law):
    def control(t, q, v):
        control.times.append(t)
        return law(t, q, v)

    control.times = []
    return control


def test_moreau_jean_calls_control_once_a_step(pendulum):
    pendulum << kte.base_2D("ground") << kte.point_contact_2D("tip on the floor", "ground", "tip", surface_axis=[0, 1])
    control = counted(lambda t, q, v: -20 * q - 2 * v)
    motion = kte.simulate(pendulum, [0.5], time=0.2, every=0.02, control=control, solver="moreau_jean", step=0.01)
    # at the start, and at the end for the last row
    np.testing.assert_allclose(control.times, [0, *np.arange(21) * 0.01], atol=1e-15)
    np.testing.assert_allclose(motion["tau/q"], -20 * motion.q[:, 0] - 2 * motion.v[:, 0], atol=1e-12)
    held = kte.simulate(pendulum, [0.5], time=0.2, at=[0.015], control=control, solver="moreau_jean", step=0.01)
    at_step = kte.simulate(pendulum, [0.5], time=0.2, at=[0.01], control=control, solver="moreau_jean", step=0.01)
    assert held["tau/q"] == at_step["tau/q"]
    # the explicit method by hand, with the acceleration of each step at its middle
    simulation = kte.Simulation(pendulum, [0.5], control=[0.0], solver="moreau_jean", step=0.01)
    for k in range(20):
        simulation.set_control(-20 * simulation.q - 2 * simulation.v)
        simulation.advance(0.01 * (k + 1))
    assert simulation.q == pytest.approx(motion.q[-1], abs=1e-13)


def test_functions_are_called_once_for_a_time_and_state(pendulum):
    pendulum << kte.base_2D("ground") << kte.driving_actuator_gen("q", "motor")
    feet = [kte.point_contact_2D(f"foot {k}", "ground", "tip", surface_axis=[0, 1], offset=[0.1 * k, 1]) for k in range(4)]
    calls = []
    law = lambda t, q, v: calls.append((t, *q, *v)) or [-q[0]]  # noqa: E731
    simulation = kte.Simulation(pendulum << feet, [0.5], control=law, inputs={"motor": lambda t, q, v: law(t, q, v)[0]})
    simulation.advance(0.5)
    repeated = [a == b for a, b in zip(calls[2::2], calls[::2])]
    assert len(calls) > 100 and not any(repeated[1:])
    assert calls[::2] == calls[1::2]  # inputs and control
    gain = [1.0]
    for solver in ("dormand_prince45", "moreau_jean"):
        one, two = (kte.Simulation(pendulum, [0.5], control=lambda t, q, v: gain[0] * q, solver=solver) for _ in range(2))
        for simulation, gains in ((one, (1, 50)), (two, (1, 1))):
            for k, gain[0] in enumerate(gains):
                simulation.advance(0.01 * (k + 1))
        difference = (one.v - two.v)[0]  # the second half has the gain of its begin
        assert difference == pytest.approx(49 * 0.5 * 0.01 / 0.25, rel=0.1), solver


def test_implicit_control_may_be_stiff(pendulum):
    def end(**options):
        control = counted(lambda t, q, v: -1e5 * (q - 0.3) - 1e3 * v)
        motion = kte.simulate(pendulum, [0.5], time=0.5, every=0.5, control=control, solver="moreau_jean", step=0.01, **options)
        return motion.q[-1, 0], len(control.times) / motion.statistics["steps"]

    stiff, calls = end(implicit_control=True)
    assert stiff == pytest.approx(0.3, abs=1e-3) and 3 < calls < 10
    explicit, calls = end()
    assert abs(explicit - 0.3) > 1 and calls < 1.1  # unstable
    with pytest.raises(kte.BadArgument, match="implicit_control is an option of moreau_jean, not of rodas"):
        kte.simulate(pendulum, [0.5], time=1, solver="rodas", implicit_control=True)


@pytest.mark.parametrize(
    "tolerance, why",
    [
        (1e-300, "relative tolerance 1e-300 of component 0 is out of reach of the arithmetic: 8.88"),
        (0, "absolute and relative tolerance are both 0"),
        (-1, "absolute tolerance must be finite and not negative, got -1"),
        (float("nan"), "absolute tolerance must be finite and not negative, got nan"),
        (float("inf"), "absolute tolerance must be finite and not negative, got inf"),
    ],
)
def test_tolerances_that_are_none_are_refused(pendulum, tolerance, why):
    with pytest.raises(kte.BadArgument, match=why):
        kte.simulate(pendulum, [0.0], time=1, tolerance=tolerance)


def test_an_absolute_tolerance_too_small_for_the_rates_is_named(pendulum):
    with pytest.raises(kte.IntegrationFailure, match=r"tolerance \S+ of component 1 is too small for its rate -19.62") as e:
        kte.simulate(pendulum, [0.0], time=1, absolute=1e-160, relative=1e-6)
    assert e.value.reason == "out_of_reach"


def test_rows_further_apart_than_the_simulation_are_its_ends(pendulum):
    for every in (0.5, 1, 1e8, 1e12, 1e308, float("inf")):
        assert kte.simulate(pendulum, [0.1], time=0.5, every=every).t.tolist() == [0, 0.5]
    assert kte.simulate(pendulum, [0.1], time=0.5, every=0.1).t.tolist() == [0, 0.1, 0.2, 0.1 * 3, 0.4, 0.5]
    assert kte.simulate(pendulum, [0.1], time=-1e-12, every=1).t.tolist() == [0, -1e-12]


def test_a_time_that_is_lost_in_rounding_is_refused(pendulum):
    with pytest.raises(kte.BadArgument, match=r"a time of 1 s is lost in the rounding of t = 1e\+30 s"):
        kte.simulate(pendulum, [0.1], time=1, t=1e30)


def test_rollouts_are_those_of_simulations(iiwa, random):
    n, steps = 11, 6
    tau = random.uniform(-5, 5, (n, steps, 7))
    q, v = random.uniform(-1, 1, (n, 7)), random.uniform(-1, 1, 7)
    found = kte.rollout(iiwa, q, v, tau, 0.01, step=0.0025)
    assert found.q.shape == (n, steps + 1, 7) and found.v.shape == (n, steps + 1, 7)
    np.testing.assert_allclose(found.t, 0.01 * np.arange(steps + 1))
    for i in (0, 7, 8, 10):
        s = kte.Simulation(iiwa, q[i], v, solver="runge_kutta4", step=0.0025, control=np.zeros(7))
        np.testing.assert_array_equal(found.q[i, 0], q[i])
        for k in range(steps):
            s.set_control(tau[i, k])
            s.advance(0.01 * (k + 1))
            np.testing.assert_allclose(found.q[i, k + 1], s.q, rtol=0, atol=1e-13)
            np.testing.assert_allclose(found.v[i, k + 1], s.v, rtol=0, atol=1e-11)
    np.testing.assert_array_equal(kte.rollout(iiwa, q, v, tau, 0.01, step=0.0025, threads=1).q, found.q)
    assert kte.rollout(iiwa, q[0], v, tau[:0], 0.01).q.shape == (0, steps + 1, 7)


def test_rollouts_of_free_bodies_one_after_the_other():
    body = kte.Chain(kte.free_joint_3D("pose", "world", "body"), kte.inertia_3D("body", 2, inertia=[1, 1, 1]), gravity=[0, 0, -10])
    q = kte.neutral_configuration(body)
    push = np.zeros((2, 4, 6))
    push[1, :, 0] = 4.0
    found = kte.rollout(body, q, np.zeros(6), push, 0.1)
    np.testing.assert_allclose(found.q[:, -1, 2], -0.5 * 10 * 0.4**2, atol=1e-14)
    np.testing.assert_allclose(found.q[:, -1, 0], [0, 0.5 * 2 * 0.4**2], atol=1e-14)


def test_bad_arguments_of_rollouts(pendulum):
    tau = np.zeros((3, 5, 1))
    for q, v, forces, every, match in (
        ([0.0, 0], [0.0], tau, 0.1, r"q has shape \(2,\), expected \(1,\) or \(3, 1\)"),
        ([0.0], [0.0], tau[0], 0.1, r"tau has shape \(5, 1\), expected \(n, T, 1\)"),
        ([0.0], [0.0], tau, 0.0, "every must be finite and positive"),
        ([0.0], [np.nan], tau, 0.1, "v has a number that is not finite"),
    ):
        with pytest.raises(kte.BadArgument, match=match):
            kte.rollout(pendulum, q, v, forces, every)
    with pytest.raises(kte.BadArgument, match="step must be positive"):
        kte.rollout(pendulum, [0.0], [0.0], tau, 0.1, step=-1)
