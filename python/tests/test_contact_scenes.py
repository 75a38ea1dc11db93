"""Scenes of rigid contact with known solutions."""
import numpy as np
import pytest

import kte

G = 9.81


def box(friction, half=(0.2, 0.1), inertia=0.01, on="ground"):
    """1 kg on a free joint, after the elements that move the frame `on`."""
    half = np.asarray(half)
    return [
        kte.free_joint_2D("pose", "ground", "box"),
        kte.inertia_2D("box", mass=1, inertia=inertia),
        *kte.box_contact_2D("box", on, "box", half, friction=friction),
    ]


def chain(*parts):
    return kte.Chain(kte.base_2D("ground"), *parts, gravity=[0, -G])


def test_a_ball_rolls_in_a_bowl():
    """(7/5) (R - r) theta'' = -g sin(theta): the period of a pendulum, 4 sqrt(7 (R - r)/(5 g)) K(sin(theta_0/2))."""
    radius, bowl, angle = 0.1, 1.0, 0.1
    d = bowl - radius
    ball = chain(
        kte.free_joint_2D("pose", "ground", "ball"),
        kte.inertia_2D("ball", mass=2, inertia=0.4 * 2 * radius**2),
        kte.sphere_contact_2D("c", "ground", "ball", radius=radius, surface_axis=[0, 0], surface_radius=-bowl, friction=1),
    )
    a, b = 1.0, np.cos(angle / 2)
    for _ in range(6):
        a, b = (a + b) / 2, np.sqrt(a * b)  # the mean of K = pi/(2 a)
    period = 2 * np.pi / a * np.sqrt(1.4 * d / G)
    start = [d * np.sin(angle), -d * np.cos(angle), 0]
    motion = kte.simulate(ball, start, time=period, every=period / 2, tolerance=1e-10)
    np.testing.assert_allclose(motion.q[:, 0], [start[0], -start[0], start[0]], atol=1e-8)
    assert not motion.events


def test_a_block_rocks():
    """Housner 1963: each impact leaves 1 - 3/2 sin^2(alpha) of the rate."""
    half = np.array([0.2, 1.0])
    inertia, tilt, alpha = half @ half / 3, 0.05, np.arctan2(*half)
    corner = np.array([[np.cos(tilt), -np.sin(tilt)], [np.sin(tilt), np.cos(tilt)]]) @ -half
    motion = kte.simulate(chain(*box(2.0, half, inertia)), [*(-corner), tilt], time=1)
    first, second = motion.events
    ratio = 1 - 1.5 * np.sin(alpha) ** 2
    assert first.v[2] / first.v_before[2] == pytest.approx(ratio, rel=1e-13)
    assert second.v[2] / second.v_before[2] == pytest.approx(ratio, rel=1e-13)
    fallen = 2 * G * np.sqrt(half @ half) * (np.cos(alpha - tilt) - np.cos(alpha))
    assert first.v_before[2] ** 2 == pytest.approx(fallen / (4 / 3 * half @ half), rel=1e-8)


def test_a_rod_slips_where_friction_ends():
    length, angle, friction = 1.0, 0.2, 0.3
    ends = [kte.point_contact_2D(f"c{s}", "ground", "rod", friction=friction, offset=[s * length / 2, 0]) for s in (-1, 1)]
    rod = chain(kte.free_joint_2D("pose", "ground", "rod"), kte.inertia_2D("rod", mass=1, inertia=length**2 / 12), *ends)
    motion = kte.simulate(rod, [0, length / 2 * np.cos(angle), np.pi / 2 - angle], time=0.5)
    slips = motion.events[0]
    assert slips.what == "'c-1': slides"
    t = np.pi / 2 - slips.q[2]  # from the vertical; sticking: t' = sqrt(3 g/L (cos t_0 - cos t)), t'' = 3 g/(2 L) sin t
    rate2, rate_rate = 3 * G / length * (np.cos(angle) - np.cos(t)), 1.5 * G / length * np.sin(t)
    along = length / 2 * (rate_rate * np.cos(t) - rate2 * np.sin(t))
    normal = G - length / 2 * (rate_rate * np.sin(t) + rate2 * np.cos(t))
    assert abs(along) / normal == pytest.approx(friction, rel=1e-9)


def test_a_disc_rolls_about_its_centre_at_rest():
    """Euler's disc: precession^2 = 4 g/(r sin(tilt)), while the centre is at rest."""
    radius, tilt = 0.1, 0.4
    rate = np.sqrt(4 * G / (radius * np.sin(tilt)))
    moment = radius**2 / 4
    disc = kte.Chain(
        kte.free_joint_3D("pose", "ground", "disc"),
        kte.inertia_3D("disc", mass=1, inertia=[moment, moment, 2 * moment]),
        kte.disc_contact_3D("rim", "ground", "disc", normal=[0, 0, 1], axis=[0, 0, 1], radius=radius, friction=5),
        gravity=[0, 0, -G],
    )
    start = np.array([0, 0, radius * np.sin(tilt), np.cos(tilt / 2), np.sin(tilt / 2), 0, 0])
    motion = kte.simulate(disc, start, [0, 0, 0, 0, rate * np.sin(tilt), 0], time=2 * np.pi / rate, every=None)
    np.testing.assert_allclose(motion.q[:, :3], start[:3] * np.ones((len(motion), 1)), atol=1e-8)
    normal = kte.forward_kinematics(disc, motion.q[-1], "disc").rotation[:, 2]
    np.testing.assert_allclose(normal, [0, -np.sin(tilt), np.cos(tilt)], atol=1e-7)


@pytest.mark.parametrize("solver, error", [("dormand_prince45", 1e-12), ("moreau_jean", 1e-6)])
def test_a_block_on_a_belt_that_signals_move(solver, error):
    belt = kte.position_control_2D("p", "v", "a", "ground", "belt")
    speed, friction = 1.0, 0.25
    signals = {"p": lambda t, q, v: [speed * t, 0, 0], "v": [speed, 0, 0], "a": [0, 0, 0]}
    motion = kte.simulate(chain(belt, *box(friction, on="belt")), [0, 0.1, 0], time=0.6, inputs=signals, solver=solver)
    assert motion.q[-1][0] == pytest.approx(speed * 0.6 - speed**2 / (2 * friction * G), abs=error)
    if solver != "moreau_jean":
        assert motion.events[0].what == "'box/corner 3': sticks; 'box/corner 4': sticks"
        assert motion.events[0].time == pytest.approx(speed / (friction * G), rel=1e-12)


def test_a_block_lifts_from_a_table_that_shakes():
    """It lifts where the table falls faster: A w^2 cos(w t) = -g."""
    amplitude, w = 0.04, 20.0
    signals = {
        "p": lambda t, q, v: [0, amplitude * (1 - np.cos(w * t)), 0],
        "v": lambda t, q, v: [0, amplitude * w * np.sin(w * t), 0],
        "a": lambda t, q, v: [0, amplitude * w**2 * np.cos(w * t), 0],
    }
    table = kte.position_control_2D("p", "v", "a", "ground", "table")
    motion = kte.simulate(chain(table, *box(0.5, on="table")), [0, 0.1, 0], time=0.4, inputs=signals)
    lifts = motion.events[0]
    assert "lifts" in lifts.what and lifts.time == pytest.approx(np.arccos(-G / (amplitude * w**2)) / w, rel=1e-9)
    before, after = motion.t < lifts.time, (motion.t > lifts.time) & (motion.t < motion.events[1].time)
    np.testing.assert_allclose(motion.q[before, 1], 0.1 + amplitude * (1 - np.cos(w * motion.t[before])), atol=1e-12)
    t = motion.t[after] - lifts.time
    np.testing.assert_allclose(motion.q[after, 1], lifts.q[1] + lifts.v[1] * t - G / 2 * t**2, atol=1e-9)


@pytest.mark.parametrize(
    "force, acceleration, text",
    [([6, 0, 0], [6 - 0.5 * G, 0], "slides"), ([0, 15, 0], [0, 15 - G], "lifts"), ([4, 0, 0], [0, 0], "")],
    ids=["slides", "lifts", "sticks"],
)
def test_a_controller_moves_a_block_between_two_advances(force, acceleration, text):
    simulation = kte.Simulation(chain(*box(0.5)), [0, 0.1, 0], control=np.zeros(3))
    simulation.advance(0.5)
    simulation.set_control(force)
    moved = simulation.advance(1.0)
    np.testing.assert_allclose(simulation.q[:2], np.array([0, 0.1]) + np.array(acceleration) * 0.5**2 / 2, atol=1e-12)
    assert (text in moved.events[0].what) if text else not moved.events


def test_a_reset_settles_contacts():
    kick = kte.Event(lambda t, q, v: t - 0.1, "rising", reset=lambda t, q, v: (q, [1, 0, 0]), name="kick")
    motion = kte.simulate(chain(*box(0.5)), [0, 0.1, 0], time=1, events=kick)
    assert motion.q[-1][0] == pytest.approx(1 / (2 * 0.5 * G), rel=1e-12)
    assert motion.events[-1].time == pytest.approx(0.1 + 1 / (0.5 * G), rel=1e-12)
    drop = kte.Event(lambda t, q, v: t - 0.1, "rising", reset=lambda t, q, v: ([0, 0.05, 0], v), name="drop")
    with pytest.raises(kte.BadArgument, match="after the reset of 'drop' cannot be: contact 'box/corner 3' is 0.05.* inside"):
        kte.simulate(chain(*box(0.5)), [0, 0.1, 0], time=1, events=drop)


def test_a_reset_releases_friction_that_holds():
    """Friction F stops 1 kg from v after v/F."""
    slide = kte.Chain(kte.prismatic_joint_2D("x", "ground", "m", [1, 0]), kte.inertia_2D("m", mass=1))
    slide << kte.joint_stiction_gen("x", "mode", coulomb=2, stiction=2)
    kick = kte.Event(lambda t, q, v: t - 1, "rising", reset=lambda t, q, v: (q, [1.0]))
    motion = kte.simulate(slide, [0.0], time=2, events=kick)
    assert motion.q[-1][0] == pytest.approx(0.25, rel=1e-9) and motion.v[-1][0] == 0


def test_all_fixed_step_solvers_come_to_rest():
    slides = chain(*box(0.5))
    for solver in ("implicit_midpoint", "runge_kutta4", "semi_implicit_euler", "moreau_jean"):
        motion = kte.simulate(slides, [0, 0.1, 0], [1, 0, 0], time=0.25, solver=solver, step=1e-3, every=0.05)
        assert motion.q[-1][0] == pytest.approx(1 / (2 * 0.5 * G), abs=1e-3) and np.abs(motion.v[-1]).max() < 1e-12


def test_what_is_refused():
    falls = chain(*box(0.5))
    with pytest.raises(kte.BadArgument, match="contacts act forward in time only"):
        kte.simulate(falls, [0, 1, 0], time=-1)
    with pytest.raises(kte.BadArgument, match="end time must be finite, got nan"):
        kte.simulate(falls, [0, 1, 0], time=np.nan)
    with pytest.raises(kte.BadArgument, match="of contacts or of a frame, not of both"):
        kte.operational_inertia(falls, [0, 0.1, 0], "box/corner 3", frame="box")
    with pytest.raises(TypeError, match="half must be numbers"):
        kte.box_contact_2D("box", "ground", "box", "wide")
    for half in ([-1, 2, 1], [0, 2, 1], [np.nan, 2, 1]):
        with pytest.raises(kte.BadParameter, match="half the lengths of a box must be finite and positive"):
            kte.box_contact_3D("box", "ground", "box", half)


def test_a_sweep_names_contacts_without_blanks():
    """`_` stands for the blanks in names of the chain, because columns of tables have none."""
    friction = [0.2, 0.4]
    cases = kte.list_of_cases(["box/corner_3/friction", "box/corner_4/friction"], np.transpose([friction, friction]))
    run = kte.SimulationRun(chain(*box(0.1)), [0, 0.1, 0], [1, 0, 0], time=1)
    table = kte.sweep(cases, run, {"x": "frame:box/position/x"})
    np.testing.assert_allclose(table["x"], 1 / (2 * G * np.array(friction)), rtol=1e-12)
