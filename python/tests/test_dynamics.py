import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import kte

from conftest import ROBOTS

IIWA = kte.load_robot(ROBOTS / "iiwa14.urdf")
SOLO = kte.Chain(
    kte.free_joint_3D("trunk", "world", "body"),
    kte.inertia_3D("body", 3, inertia=[0.1, 0.2, 0.25]),
    kte.revolute_joint_3D("hip", "body", "leg", [0, 1, 0], position=[0.2, 0.1, 0]),
    kte.inertia_3D("leg", 1, [0, 0, -0.1], inertia=0.01),
    gravity=[0, 0, -9.81],
)
numbers = st.floats(-3, 3)
states = arrays.arrays(float, (3, 7), elements=numbers)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(states)
def test_forward_dynamics_inverts_inverse_dynamics(x):
    q, v, a = x
    tau = kte.inverse_dynamics(IIWA, q, v, a)
    np.testing.assert_allclose(kte.forward_dynamics(IIWA, q, v, tau), a, atol=1e-9)
    m, bias = kte.mass_matrix(IIWA, q), kte.nonlinear_effects(IIWA, q, v)
    np.testing.assert_allclose(m @ a + bias, tau, atol=1e-11)
    np.testing.assert_allclose(kte.mass_matrix_inverse(IIWA, q) @ m, np.eye(7), atol=1e-9)
    np.testing.assert_allclose(kte.gravity_forces(IIWA, q) + kte.coriolis_forces(IIWA, q, v), bias, atol=1e-11)
    np.testing.assert_allclose(kte.coriolis_matrix(IIWA, q, v) @ v, kte.coriolis_forces(IIWA, q, v), atol=1e-11)
    np.testing.assert_allclose(kte.torque_regressor(IIWA, q, v, a) @ kte.inertial_parameters(IIWA), tau, atol=1e-10)
    assert kte.kinetic_energy(IIWA, q, v) == pytest.approx(0.5 * v @ m @ v, abs=1e-11)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(states)
def test_velocities_are_jacobians_times_v(x):
    q, v, a = x
    velocity = kte.frame_velocity(IIWA, q, v, "tool")
    np.testing.assert_allclose(kte.jacobian(IIWA, q, "tool") @ v, np.concatenate(velocity), atol=1e-12)
    bias = np.concatenate(kte.bias_acceleration(IIWA, q, v, "tool", "world"))
    np.testing.assert_allclose(kte.jacobian_rate(IIWA, q, v, "tool", "world") @ v, bias, atol=1e-10)
    np.testing.assert_allclose(kte.centre_of_mass_jacobian(IIWA, q) @ v, kte.centre_of_mass_velocity(IIWA, q, v), atol=1e-12)
    np.testing.assert_allclose(
        kte.centroidal_momentum_matrix(IIWA, q) @ v, np.concatenate(kte.centroidal_momentum(IIWA, q, v)), atol=1e-11
    )
    world = kte.jacobian(IIWA, q, "tool", "world")
    pose = kte.forward_kinematics(IIWA, q, "tool")
    np.testing.assert_allclose(world[:3] @ v, pose.rotation @ velocity.linear, atol=1e-12)
    acceleration = kte.frame_acceleration(IIWA, q, v, a, "tool")
    np.testing.assert_allclose((world @ a + bias)[:3], pose.rotation @ acceleration.linear, atol=1e-10)


def test_derivatives_are_those_of_differences(random):
    q, v, tau = random.standard_normal((3, 7))
    d, h = kte.forward_dynamics_derivatives(IIWA, q, v, tau), 1e-6
    np.testing.assert_allclose(d.a, kte.forward_dynamics(IIWA, q, v, tau), atol=1e-10)
    for i, e in enumerate(np.eye(7)):
        by_q = (kte.forward_dynamics(IIWA, q + h * e, v, tau) - kte.forward_dynamics(IIWA, q - h * e, v, tau)) / (2 * h)
        by_v = (kte.forward_dynamics(IIWA, q, v + h * e, tau) - kte.forward_dynamics(IIWA, q, v - h * e, tau)) / (2 * h)
        np.testing.assert_allclose(d.by_q[:, i], by_q, rtol=1e-5, atol=1e-4)
        np.testing.assert_allclose(d.by_v[:, i], by_v, rtol=1e-5, atol=1e-4)
    np.testing.assert_allclose(d.by_tau, kte.mass_matrix_inverse(IIWA, q), atol=1e-9)
    i = kte.inverse_dynamics_derivatives(IIWA, q, v, d.a)
    np.testing.assert_allclose(i.by_a, kte.mass_matrix(IIWA, q), atol=1e-10)
    np.testing.assert_allclose(-d.by_tau @ i.by_q, d.by_q, rtol=1e-6, atol=1e-6)


FUNCTIONS = {
    "inverse_dynamics": "qva",
    "forward_dynamics": "qva",
    "mass_matrix": "q",
    "mass_matrix_inverse": "q",
    "gravity_forces": "q",
    "static_forces": "q",
    "nonlinear_effects": "qv",
    "coriolis_forces": "qv",
    "coriolis_matrix": "qv",
    "mass_matrix_rate": "qv",
    "inverse_dynamics_derivatives": "qva",
    "forward_dynamics_derivatives": "qva",
    "torque_regressor": "qva",
    "potential_energy": "q",
    "kinetic_energy": "qv",
    "energy": "qv",
    "centre_of_mass": "q",
    "centre_of_mass_velocity": "qv",
    "centre_of_mass_acceleration": "qva",
    "centre_of_mass_jacobian": "q",
    "centroidal_momentum": "qv",
    "centroidal_momentum_rate": "qva",
    "centroidal_momentum_matrix": "q",
    "forward_kinematics": "qf",
    "frame_velocity": "qvf",
    "frame_acceleration": "qvaf",
    "jacobian": "qf",
    "jacobian_rate": "qvf",
    "bias_acceleration": "qvf",
    "joint_reaction": "qvaf",
    "subtree_inertia": "qf",
}


def configurations(chain, count, random):
    v = random.standard_normal((count, chain.nv))
    return np.array([kte.integrate(chain, kte.neutral_configuration(chain), x) for x in v])


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("chain, frame", [(IIWA.chain, "tool"), (SOLO, "leg")])
def test_many_states_give_the_results_of_each(name, chain, frame, random):
    count = 37
    function = getattr(kte, name)
    given = {"q": configurations(chain, count, random), "v": random.standard_normal((count, chain.nv))}
    given["a"] = random.standard_normal((count, chain.nv))
    some = [given[x] for x in FUNCTIONS[name] if x != "f"]
    last = [frame] if "f" in FUNCTIONS[name] else []
    all_results = function(chain, *some, *last, threads=3)
    for k in range(count):
        one = function(chain, *(x[k] for x in some), *last)
        for part, of_all in zip(one, all_results) if isinstance(one, tuple) else [(one, all_results)]:
            np.testing.assert_allclose(of_all[k], part, rtol=1e-9, atol=1e-9)


def test_one_state_of_an_argument_serves_all(random):
    q, v, tau = random.standard_normal((3, 5, 7))
    expected = [kte.forward_dynamics(IIWA, x, v[0], tau[0]) for x in q]
    np.testing.assert_allclose(kte.forward_dynamics(IIWA, q, v[0], tau[0]), expected, rtol=1e-10)
    assert kte.forward_dynamics(IIWA, q[:0], v[0], tau[0]).shape == (0, 7)
    assert kte.mass_matrix(IIWA, q[:1]).shape == (1, 7, 7)


@pytest.mark.parametrize(
    "layout",
    [
        lambda x: np.asfortranarray(x),
        lambda x: x.astype(np.float32),
        lambda x: np.repeat(np.repeat(x, 2, axis=0), 3, axis=1)[::2, ::3],
        lambda x: x[::-1][::-1],
        lambda x: x.tolist(),
        lambda x: x.astype(">f8"),
        lambda x: np.frombuffer(b"0" + x.tobytes(), offset=1).reshape(x.shape),
    ],
)
def test_arrays_of_any_layout_are_read(layout, random):
    x = random.standard_normal((6, 7)).astype(np.float32).astype(float)
    expected = kte.inverse_dynamics(IIWA, x, x, x)
    assert np.array_equal(kte.inverse_dynamics(IIWA, layout(x), layout(x), layout(x)), expected)
    one = kte.gravity_forces(IIWA, x[2])
    assert np.array_equal(kte.gravity_forces(IIWA, layout(x)[2]), one)


def test_integers_are_numbers_and_others_are_not():
    zero = [0] * 7
    assert kte.inverse_dynamics(IIWA, zero, zero, np.zeros(7, int)).shape == (7,)
    for bad in ([0j] * 7, ["0"] * 7, [None] * 7, np.zeros(7, bool), np.zeros(7, "M8[s]")):
        with pytest.raises(TypeError, match="kte: q must be real numbers"):
            kte.gravity_forces(IIWA, bad)


def masked(x):
    x = np.asarray(x, float)
    return np.ma.array(x, mask=x == x.flat[0])


@pytest.mark.parametrize(
    "name, call",
    [
        ("q", lambda: kte.gravity_forces(IIWA, masked(np.zeros(7)))),
        ("q", lambda: kte.gravity_forces(IIWA, np.ma.array(np.zeros(7)))),  # without masked numbers
        ("q", lambda: kte.gravity_forces(IIWA, masked(np.zeros((4, 7))))),
        ("q", lambda: kte.gravity_forces(IIWA, [masked(np.zeros(7))] * 4)),
        ("q", lambda: kte.gravity_forces(IIWA, [0.0] * 6 + [np.ma.masked])),
        ("tau", lambda: kte.forward_dynamics(IIWA, np.zeros(7), np.zeros(7), masked(np.ones(7)))),
        ("a wrench", lambda: kte.external_forces(IIWA, np.zeros(7), {"tool": masked([1, 2, 3])})),
        ("rotation", lambda: kte.inverse_kinematics(IIWA, "tool", [0.5, 0, 0.5], masked(np.eye(3)))),
        ("limits.lower", lambda: kte.quintic_motion(IIWA, np.zeros(7), np.ones(7), limits=IIWA.limits._replace(lower=masked(np.ones(7))))),
        ("t", lambda: kte.quintic_motion(IIWA, np.zeros(7), 0.1 * np.ones(7), 1)(masked([0, 1]))),
        ("gravity", lambda: kte.Chain(gravity=masked([0, 0, -9.81]))),
        ("position", lambda: kte.rigid_link_3D("a", "b", masked([0, 0, 1]))),
        ("position", lambda: kte.rigid_link_3D("a", "b", [np.ma.masked, 0, 1])),
        ("rotation", lambda: kte.rigid_link_2D("a", "b", [0, 1], masked(np.eye(2)))),
        ("mass", lambda: kte.inertia_gen("q", np.ma.masked)),
        ("half", lambda: kte.box_contact_3D("crate", "a", "b", masked([1, 2, 3]))),
        ("axis1", lambda: kte.universal_joint_3D("p", "y", "a", "b", masked([1, 0, 0]), [0, 1, 0])),
        ("control", lambda: kte.simulate(IIWA, np.zeros(7), time=1, control=masked(np.ones(7)))),
        ("the result of control", lambda: kte.simulate(IIWA, np.zeros(7), time=1, control=lambda t, q, v: masked(v))),
        ("at", lambda: kte.simulate(IIWA, np.zeros(7), time=1, at=masked([0.5, 1]))),
        ("values", lambda: kte.one_of("x", masked([1, 2]))),
        ("values", lambda: kte.list_of_cases(["x", "y"], masked(np.eye(2)))),
        ("column 'x' of cases", lambda: kte.sweep({"x": masked([1, 2])}, lambda c: 1, "k")),
    ],
)
def test_masked_arrays_are_refused_by_name(name, call):
    with pytest.raises(TypeError, match=f"^kte: {name} must be numbers without a mask, not a masked array"):
        call()


def test_a_masked_result_of_a_sweep_fails_its_case():
    table = kte.sweep({"x": [1, 2]}, lambda c: {"k": np.ma.masked if c["x"] == 1 else 3.0}, "k")
    assert table["failed"].tolist() == [True, False] and "the result of the function of the sweep must be numbers without" in table.failures[0].reason


def test_lists_that_hold_themselves_are_no_numbers():
    endless = []
    endless.append(endless)
    with pytest.raises((TypeError, ValueError)):
        kte.gravity_forces(IIWA, endless)


@pytest.mark.parametrize(
    "shape, expected",
    [((6,), r"\(6,\), expected \(7,\) or \(..., 7\)"), ((), r"\(\), expected"), ((2, 7, 3), r"\(2, 7, 3\), expected")],
)
def test_wrong_shapes_say_what_is_expected(shape, expected):
    with pytest.raises(kte.BadArgument, match="kte: q has shape " + expected):
        kte.gravity_forces(IIWA, np.zeros(shape))
    with pytest.raises(kte.BadArgument, match="v has 3 states, q has 2"):
        kte.nonlinear_effects(IIWA, np.zeros((2, 7)), np.zeros((3, 7)))
    with pytest.raises(kte.BadArgument, match="v has 3 x 2 states, q has 2 x 3"):
        kte.nonlinear_effects(IIWA, np.zeros((2, 3, 7)), np.zeros((3, 2, 7)))


def test_arrays_of_objects_cannot_be_written():
    state = kte.State(IIWA, np.zeros(7))
    for array in (state.q, state.v, state.a, IIWA.chain.gravity, *IIWA.limits):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


@pytest.mark.parametrize("threads", [1, 2])
def test_states_may_have_any_leading_axes(random, threads):
    q, v = random.uniform(-1, 1, (3, 4, 5, 7)), random.uniform(-1, 1, 7)
    for order in (q, np.asfortranarray(q), q[::-1, :, ::2], q[:0]):
        tau = kte.inverse_dynamics(IIWA, order, v, v, threads=threads)
        assert tau.shape == order.shape and kte.mass_matrix(IIWA, order).shape == (*order.shape, 7)
        assert np.array_equal(tau.reshape(-1, 7), kte.inverse_dynamics(IIWA, order.reshape(-1, 7), v, v))
    assert kte.potential_energy(IIWA, q).shape == (3, 4, 5)
    assert kte.forward_kinematics(IIWA, q, "tool").rotation.shape == (3, 4, 5, 3, 3)


@pytest.mark.parametrize("name", ["forward_dynamics", "inverse_dynamics", "forward_dynamics_derivatives"])
def test_states_without_a_result_are_named_or_nan(name):
    q = np.zeros((40, 7))
    q[23, 4] = np.nan
    function, zero = getattr(kte, name), np.zeros(7)
    with pytest.raises(kte.BadArgument, match=r"state 23: .*q\[4\]"):
        function(IIWA, q, zero, zero)
    result = function(IIWA, q, zero, zero, errors="nan")
    found = result if isinstance(result, np.ndarray) else result.a
    assert np.isnan(found[23]).all() and np.isfinite(np.delete(found, 23, 0)).all()
    with pytest.raises(kte.BadArgument, match="errors must be 'raise' or 'nan'"):
        function(IIWA, q, zero, zero, errors="ignore")


def test_results_do_not_depend_on_threads(random):
    q, v, tau = random.standard_normal((3, 3000, 7))
    expected = kte.forward_dynamics(IIWA, q, v, tau, threads=1)
    assert np.array_equal(kte.forward_dynamics(IIWA, q, v, tau, threads=5), expected)
    expected = kte.mass_matrix_inverse(IIWA, q, threads=1)
    assert np.array_equal(kte.mass_matrix_inverse(IIWA, q, threads=5), expected)
    with pytest.raises(kte.BadArgument, match="threads must be at least 1"):
        kte.mass_matrix(IIWA, q, threads=0)


def test_inputs_are_of_one_call():
    chain = kte.Chain(
        kte.revolute_joint_3D("q", "base", "arm"),
        kte.inertia_gen("q", 2),
        kte.driving_actuator_gen("q", "motor"),
        kte.external_force_3D("arm", "wind", "couple"),
    )
    zero = [0.0]
    assert chain.inputs == ["motor", "wind", "couple"]
    assert kte.forward_dynamics(chain, zero, zero, zero, inputs={"motor": 3})[0] == 1.5
    assert kte.forward_dynamics(chain, zero, zero, zero)[0] == 0
    assert kte.forward_dynamics(chain, zero, zero, zero, inputs={"couple": [0, 0, 1]})[0] == 0.5
    assert kte.forward_dynamics(chain, [zero] * 4, zero, zero, inputs={"motor": 3}).tolist() == [[1.5]] * 4
    for inputs, error in [({"moter": 1}, kte.UnknownName), ({"q": 1}, kte.UnknownName), ({"wind": 1}, kte.BadArgument), (3, TypeError)]:
        with pytest.raises(error, match="kte: "):
            kte.forward_dynamics(chain, zero, zero, zero, inputs=inputs)


def test_wrenches_and_hybrid_dynamics(random):
    q, v, known = random.standard_normal((3, 7))
    f = np.arange(6.0)
    np.testing.assert_allclose(kte.external_forces(IIWA, q, {"tool": f}), kte.jacobian(IIWA, q, "tool").T @ f, atol=1e-12)
    r = kte.hybrid_dynamics(IIWA, q, v, known, ["q2", "q5"])
    assert r.a[1] == known[1] and r.a[4] == known[4] and r.tau[0] == known[0]
    np.testing.assert_allclose(kte.inverse_dynamics(IIWA, q, v, r.a), r.tau, atol=1e-10)
    with pytest.raises(kte.BadArgument, match="a wrench has 4 numbers, expected 3"):
        kte.external_forces(IIWA, q, {"tool": [1, 2, 3, 4]})
    with pytest.raises(kte.UnknownName, match="'tol'"):
        kte.jacobian(IIWA, q, "tol")
    with pytest.raises(kte.BadArgument, match="axes must be"):
        kte.jacobian(IIWA, q, "tool", axes="mine")


def test_a_massless_coordinate_is_singular():
    chain = kte.Chain(kte.revolute_joint_3D("elbow", "base", "arm"))
    with pytest.raises(kte.SingularMassMatrix, match="'elbow' moves no mass"):
        kte.forward_dynamics(chain, [0.0], [0.0], [0.0])


def test_configurations_form_a_group(random):
    q, r = configurations(SOLO, 2, random)
    np.testing.assert_allclose(kte.integrate(SOLO, q, kte.difference(SOLO, q, r)), r, atol=1e-14)
    np.testing.assert_allclose(kte.interpolate(SOLO, q, r, 1), r, atol=1e-14)
    many = kte.random_configuration(SOLO, -1, 1, seed=5, n=6).reshape(2, 3, -1)
    rates = kte.difference(SOLO, q, many)
    assert rates.shape == (2, 3, SOLO.nv) and np.array_equal(rates[1, 2], kte.difference(SOLO, q, many[1, 2]))
    again = kte.integrate(SOLO, q, rates)
    np.testing.assert_allclose(kte.difference(SOLO, again, many), np.zeros_like(rates), atol=1e-13)
    assert np.array_equal(kte.interpolate(SOLO, q, many, 0.3)[0, 1], kte.interpolate(SOLO, q, many[0, 1], 0.3))
    a = kte.random_configuration(SOLO, -1, 1, seed=3)
    assert np.array_equal(a, kte.random_configuration(SOLO, -1, np.ones(8), seed=3)) and np.linalg.norm(a[3:7]) == pytest.approx(1)


def test_states_run_the_passes(random):
    q, v = random.standard_normal((2, 7))
    s = kte.State(IIWA, q, v)
    s.do_motion(), s.do_force()
    np.testing.assert_allclose(-s.f, kte.nonlinear_effects(IIWA, q, v), atol=1e-11)
    np.testing.assert_allclose(s.frame("tool").position, kte.forward_kinematics(IIWA, q, "tool").position, atol=1e-14)
    poses = kte.forward_kinematics(IIWA, q)
    assert set(poses) == set(IIWA.chain.frames)
    np.testing.assert_allclose(poses["tool"].rotation, s.frame("tool").rotation, atol=1e-14)
    s.q = q + 1
    assert np.array_equal(s.q, q + 1) and np.array_equal(s.v, v)


def test_states_refuse_what_no_pass_has_computed(pendulum):
    s = kte.State(pendulum, [0.5])
    changes = [lambda: None] + [lambda name=name: setattr(s, name, [0.1]) for name in "qva"] + [lambda: s.set_inputs({})]
    for change in changes:
        change()
        for what, read in [("frame 'tip'", lambda: s.frame("tip")), ("outputs", lambda: s.outputs), ("do_force", s.do_force)]:
            with pytest.raises(kte.BadArgument, match=rf"{what} of a State is not computed .* call do_motion\(\) first"):
                read()
        s.do_motion()
        with pytest.raises(kte.BadArgument, match=r"f of a State .* call do_motion\(\) and do_force\(\) first"):
            s.f
        assert np.isfinite(s.frame("tip").position).all() and np.isnan([s.frame("tip").force, s.frame("tip").torque]).all()
        s.do_force()
        assert np.isfinite([*s.frame("tip").force, *s.frame("tip").torque, *s.f]).all()
    with pytest.raises(kte.UnknownName, match="tap"):
        kte.State(pendulum).frame("tap")


def test_states_have_a_copy_of_their_chain(pendulum):
    s = kte.State(pendulum, [0.5])
    pendulum << kte.rigid_link_2D("tip", "end", [1, 0])
    s.do_motion(), s.do_force()
    with pytest.raises(kte.UnknownName, match="end"):
        s.frame("end")


def test_sensors_are_outputs():
    chain = kte.Chain(kte.revolute_joint_3D("q", "base", "arm"), kte.inertia_gen("q", 2), kte.position_measure_gen("q", "angle"))
    s = kte.State(chain, [0.25])
    s.do_motion()
    assert s.outputs == {"angle": 0.25}


def test_base_parameters_of_a_planar_arm(random):
    """Two links in a plane: 8 parameters, 6 combinations (Khalil and Dombre, 2002, chapter 9)."""
    body = dict(com=[0.2, 0.05], inertia=0.03)
    length = 0.7
    arm = kte.Chain(
        kte.revolute_joint_2D("q0", "base", "a"),
        kte.inertia_2D("a", 2.0, **body),
        kte.rigid_link_2D("a", "A", [length, 0]),
        kte.revolute_joint_2D("q1", "A", "b"),
        kte.inertia_2D("b", 1.5, **body),
        gravity=[0, -9.81],
    )
    q, v, a = random.uniform(-1, 1, (3, 100, 2))
    y = kte.torque_regressor(arm, q, v, a)
    base = kte.base_parameters(y)
    pi = kte.inertial_parameters(arm)
    assert base.columns == [1, 2, 3, 5, 6, 7]
    combined = base.combinations @ pi
    np.testing.assert_allclose(y[..., base.columns] @ combined, kte.inverse_dynamics(arm, q, v, a), atol=1e-13)
    # m c_x of the first link with m l of the second, I_zz with m l^2
    np.testing.assert_allclose(combined[0], pi[1] + length * pi[4], rtol=1e-13)
    np.testing.assert_allclose(combined[2], pi[3] + length**2 * pi[4], rtol=1e-13)
    np.testing.assert_allclose(combined[3:], pi[[5, 6, 7]], rtol=1e-13)
    with pytest.raises(kte.BadArgument, match="too few"):
        kte.base_parameters(y[0])
    with pytest.raises(kte.BadArgument, match="not finite"):
        kte.base_parameters(np.where(y == y, np.nan, y))
    with pytest.raises(kte.BadArgument, match="shape"):
        kte.base_parameters([1.0])


def test_functions_have_signatures():
    import inspect

    assert str(inspect.signature(kte.forward_dynamics)) == "(chain, q, v, tau, *, inputs=None, threads=None, errors='raise')"
    assert str(inspect.signature(kte.Chain)) == "(*parts, gravity=None)"
    assert "solver='dormand_prince45'" in str(inspect.signature(kte.Simulation))
    functions = [x for x in vars(kte).values() if inspect.isroutine(x) and getattr(x, "__module__", "") == "kte._kte"]
    assert len(functions) > 80
    for f in functions:
        inspect.signature(f)
        assert f.__doc__ and not f.__doc__.startswith(f.__name__ + "("), f


def test_a_star_import_hides_no_builtins():
    import builtins

    assert not set(kte.__all__) & set(dir(builtins)) and {"Chain", "forward_dynamics", "simulate"} < set(kte.__all__)
    assert all(hasattr(kte, n) for n in kte.__all__) and not {"errors", "sweeps", "np", "Any"} & set(kte.__all__)
