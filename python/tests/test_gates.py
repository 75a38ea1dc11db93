"""Contacts that land only where a function of the program is true."""
import pickle

import numpy as np
import pytest

import kte

G = 9.81
HALF, STANCE, SWING, PERIOD = 0.27102868049882, -1.09238358988360, -0.37737394890719, 0.73434639115872


def walker():
    """Goswami's compass: two legs of 1 m on a hinge, with the x axis down a slope of 3 degrees."""
    parts = [
        kte.base_2D("slope"),
        kte.prismatic_joint_2D("x", "slope", "slide", [1, 0]),
        kte.prismatic_joint_2D("y", "slide", "hip", [0, 1]),
        kte.inertia_2D("hip", 10),
    ]
    for leg in ("left", "right"):
        parts.append(kte.revolute_joint_2D(leg, "hip", leg + " leg"))
        parts.append(kte.inertia_2D(leg + " leg", 5, com=[0, -0.5]))
        parts.append(kte.rigid_link_2D(leg + " leg", leg + " tip", [0, -1]))
        parts.append(kte.point_contact_2D(leg + " foot", "slope", leg + " tip", friction=2))
    angle = np.radians(3)
    return kte.Chain(parts, gravity=[G * np.sin(angle), -G * np.cos(angle)])


def walk(**options):
    q = [0, np.cos(HALF), HALF, -HALF]
    v = [-STANCE * np.cos(HALF), -STANCE * np.sin(HALF), STANCE, SWING]
    return kte.simulate(walker(), q, v, solver="prince_dormand87", tolerance=1e-12, **options)


IN_FRONT = {"left foot": lambda t, q, v: q[2] > 0, "right foot": lambda t, q, v: q[3] > 0}


@pytest.mark.parametrize("control", [None, np.zeros(4)], ids=["alone", "with control"])
def test_a_walker_keeps_its_cycle_because_the_swinging_foot_passes(control):
    motion = walk(time=2.5, only_if=IN_FRONT, control=control)
    told = [e.what for e in motion.events]
    assert told[:3] == ["'right foot': passes", "'left foot': lifts; 'right foot': impact, sticks", "'left foot': passes"]
    strikes = [e for e in motion.events if "impact" in e.what]
    np.testing.assert_allclose([e.time for e in strikes], PERIOD * np.array([1, 2, 3]), rtol=1e-12)
    np.testing.assert_allclose(strikes[1].q[2:], [HALF, -HALF], atol=1e-12)
    assert "passes" not in walk(time=0.3).events[0].what


def test_recordings_of_gated_contacts_are_pickled():
    motion = walk(time=1, only_if=IN_FRONT)
    copied = pickle.loads(pickle.dumps(motion))
    assert copied.chain == motion.chain
    for name in ("left tip/position/y", "left foot/force/y", "left/a"):
        assert np.array_equal(copied[name], motion[name])


def ball():
    return kte.Chain(
        kte.base_2D("ground"),
        kte.free_joint_2D("pose", "ground", "ball"),
        kte.inertia_2D("ball", 1, inertia=0.01),
        kte.point_contact_2D("foot", "ground", "ball", restitution=0.5),
        gravity=[0, -G],
    )


@pytest.mark.parametrize("solver", ["dormand_prince45", "moreau_jean"])
def test_gates_know_the_time_the_position_and_the_velocity(solver):
    asked = []

    def gate(answer):
        def of(t, q, v):
            asked.append((t, *q, *v))
            return answer(t, q, v)

        return {"foot": of}

    fall, end = np.sqrt(2 / G), 0.6
    through = [end, 1 - G / 2 * end**2, 0]
    error = 1e-8 if solver != "moreau_jean" else 2e-3 * G * fall  # the way of two steps
    for lands in (lambda t, q, v: t > 0.5, lambda t, q, v: q[0] < 0, lambda t, q, v: v[1] > 0, lambda t, q, v: np.bool_(False)):
        motion = kte.simulate(ball(), [0, 1, 0], [1, 0, 0], time=end, only_if=gate(lands), solver=solver)
        np.testing.assert_allclose(motion.q[-1], through, atol=error)
    t, x, y = np.array(asked)[:, :3].T
    np.testing.assert_allclose(t, fall, atol=error)
    np.testing.assert_allclose([x, y], [t, 0 * t], atol=error)
    motion = kte.simulate(ball(), [0, 1, 0], [1, 0, 0], time=end, only_if=gate(lambda t, q, v: t > 0.3), solver=solver)
    up = end - fall
    np.testing.assert_allclose(motion.q[-1][1], 0.5 * G * fall * up - G / 2 * up**2, atol=2 * error)


def test_what_is_refused():
    start = [0, 1, 0]
    for gates, error, text in [
        ({"fot": lambda t, q, v: True}, kte.UnknownName, r"no rigid contact 'fot' \(there are 'foot'\)"),
        ({"foot": True}, TypeError, r"only_if of 'foot' must be a function of \(t, q, v\), not True"),
        ({"foot": lambda t, q, v: None}, TypeError, "only_if of 'foot' must return whether the contact lands, not None"),
        ({"foot": lambda t, q, v: 1 / 0}, ZeroDivisionError, "division"),
        ([1], TypeError, "only_if must be a dict from contacts to functions"),
    ]:
        with pytest.raises(error, match=text):
            kte.simulate(ball(), start, time=1, only_if=gates)
