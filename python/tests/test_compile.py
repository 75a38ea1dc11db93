"""Chains as types: compiled once for all tests of this file."""
import copy
import pickle

import numpy as np
import pytest

import kte

STATES = 40


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """A folder for compiled chains."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield patch


@pytest.fixture(scope="module")
def arm():
    return kte.Chain(
        kte.revolute_joint_3D("q1", "base", "a", axis=[0, 1, 0]),
        kte.rigid_link_3D("a", "b", [0.4, 0, 0.1]),
        kte.inertia_3D("b", 2, inertia=0.1),
        kte.revolute_joint_3D("q2", "b", "tool", axis=[0, 0, 1]),
        kte.inertia_3D("tool", 1, com=[0.2, 0, 0], inertia=0.05),
        kte.joint_damping_gen("q2", 0.3),
        kte.driving_actuator_gen("q1", "motor"),
        gravity=[0, 0, -9.81],
    )


@pytest.fixture(scope="module")
def fast(arm, cache):
    return kte.compile(arm, frames=["tool"])


@pytest.fixture
def state(random):
    return random.normal(size=(3, STATES, 2))


FUNCTIONS = {
    "inverse_dynamics": 3,
    "forward_dynamics": 3,
    "mass_matrix": 1,
    "mass_matrix_inverse": 1,
    "nonlinear_effects": 2,
    "gravity_forces": 1,
    "energy": 2,
    "inverse_dynamics_derivatives": 3,
    "forward_dynamics_derivatives": 3,
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_give_the_numbers_of_the_chain(arm, fast, state, name):
    f, arguments = getattr(kte, name), state[: FUNCTIONS[name]]
    for x in (arguments[:, 0], arguments.astype(np.float32)[..., ::-1]):
        one, two = f(arm, *x), f(fast, *x)
        for a, b in zip(*((y if isinstance(y, tuple) else (y,)) for y in (one, two))):
            assert np.shape(a) == np.shape(b) and np.allclose(a, b, rtol=1e-12, atol=1e-12)
    one, two = (f(fast, *arguments, threads=n) for n in (1, 3))
    for a, b in zip(one, two):
        assert np.array_equal(a, b)


def test_frames_that_are_compiled_and_others(arm, fast, state):
    q = state[0]
    for frame in ("tool", "b"):
        assert np.allclose(kte.jacobian(fast, q, frame), kte.jacobian(arm, q, frame), atol=1e-14)
        for axes in ("world", "world_origin"):
            assert np.allclose(kte.jacobian(fast, q, frame, axes), kte.jacobian(arm, q, frame, axes), atol=1e-14)
        for a, b in zip(kte.forward_kinematics(fast, q, frame), kte.forward_kinematics(arm, q, frame)):
            assert np.allclose(a, b, atol=1e-14)


def test_it_is_a_chain(arm, fast, state):
    q, v, tau = state[:, 0]
    assert repr(fast).startswith("<kte.Chain, compiled: 7 elements") and fast == arm
    moved = kte.forward_dynamics(fast, q, v, tau, inputs={"motor": 2})
    assert np.array_equal(moved, kte.forward_dynamics(arm, q, v, tau, inputs={"motor": 2}))
    for twin in (copy.deepcopy(fast), pickle.loads(pickle.dumps(fast))):
        assert repr(twin) == repr(fast)
        assert np.array_equal(kte.forward_dynamics(twin, q, v, tau), kte.forward_dynamics(fast, q, v, tau))
    twin << kte.joint_damping_gen("q1", 1)
    assert "compiled" not in repr(twin) and not np.allclose(kte.forward_dynamics(twin, q, v, tau), kte.forward_dynamics(arm, q, v, tau))
    assert kte.simulate(fast, q, time=0.1).q.shape == (11, 2)


def test_errors_are_those_of_the_chain(fast, state):
    q, v, tau = state
    with pytest.raises(kte.BadArgument, match=r"v has shape \(3,\), expected \(2,\)"):
        kte.inverse_dynamics(fast, q[0], [0, 0, 0], v[0])
    q[7, 1] = np.nan
    for name in ("forward_dynamics", "inverse_dynamics_derivatives"):
        with pytest.raises(kte.BadArgument, match="7"):
            getattr(kte, name)(fast, q, v, tau)
    a = kte.forward_dynamics(fast, q, v, tau, errors="nan")
    assert np.isnan(a[7]).all() and np.isfinite(np.delete(a, 7, axis=0)).all()


def test_states_are_counted_in_all_of_a_batch(arm, fast, random):
    q, v, tau = random.normal(size=(3, 9000, 2))
    assert np.allclose(kte.forward_dynamics(fast, q, v, tau), kte.forward_dynamics(arm, q, v, tau), rtol=1e-11, atol=1e-11)
    q[[8765, 8999], 0] = np.nan
    with pytest.raises(kte.BadArgument, match=r"^kte: state 8765: .* q\[0\]"):
        kte.forward_dynamics(fast, q, v, tau)
    a = kte.forward_dynamics(fast, q, v, tau, errors="nan")
    assert np.flatnonzero(np.isnan(a).any(axis=1)).tolist() == [8765, 8999]


def test_chains_and_frames_that_are_refused(arm, four_bar, cache):
    with pytest.raises(kte.UnknownName, match="tol"):
        kte.compile(arm, frames="tol")
    with pytest.raises(TypeError, match="a name must be a str, not 3"):
        kte.compile(arm, frames=[3])
    with pytest.raises(kte.BadArgument, match="closed loops or rigid contacts"):
        kte.compile(four_bar)


def test_a_compiler_that_is_not_there_or_fails(arm, cache):
    with cache.context() as patch:
        patch.setenv("CXX", "no-compiler-of-this-name")
        with pytest.raises(kte.BadFile, match="no-compiler-of-this-name.*kte.compile needs a C.. compiler"):
            kte.compile(arm)
        patch.setenv("CXX", "c++ --no-such-option")
        with pytest.raises(kte.BadArgument, match="(?s)'c..' does not compile this robot.*no-such-option"):
            kte.compile(arm)
