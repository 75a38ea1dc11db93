"""Linear systems and feedback: those of docs/control.md."""
import numpy as np
import pytest

import kte


@pytest.fixture
def cart_pole():
    return kte.Chain(
        kte.prismatic_joint_2D("slide", "ground", "cart", [1, 0]),
        kte.inertia_2D("cart", 1.0),
        kte.revolute_joint_2D("angle", "cart", "pole"),
        kte.inertia_2D("pole", 0.1, com=[0, 0.5]),
        kte.driving_actuator_gen("slide", "motor"),
        gravity=[0, -9.81],
    )


def test_a_cart_pole_is_linearized_in_closed_form(cart_pole):
    m, mp, length, g = 1.0, 0.1, 0.5, 9.81
    linear = kte.linearize(cart_pole, [0, 0])
    a, b = np.zeros((4, 4)), np.zeros((4, 1))
    a[:2, 2:] = np.eye(2)
    a[2, 1], a[3, 1] = mp * g / m, (m + mp) * g / (m * length)
    b[2, 0], b[3, 0] = 1 / m, 1 / (m * length)
    np.testing.assert_allclose(linear.A, a, atol=1e-14)
    np.testing.assert_allclose(linear.B, b, atol=1e-14)
    assert linear.inputs == ["motor"] and not linear.x_dot.any()
    pushed = kte.linearize(cart_pole, [0, 0], inputs={"motor": 2.0})
    np.testing.assert_allclose(pushed.x_dot, 2 * b[:, 0], atol=1e-14)


def test_a_regulator_balances_the_pole(cart_pole):
    linear = kte.linearize(cart_pole, [0, 0])
    gain = kte.lqr(linear, [10, 10, 1, 1], 0.1)
    np.testing.assert_allclose(np.sort_complex(gain.poles), np.sort_complex(np.linalg.eigvals(linear.A - linear.B @ gain.K)), atol=1e-9)
    x, a, b = gain.X, linear.A, linear.B
    riccati = a.T @ x + x @ a - x @ b @ b.T @ x / 0.1 + np.diag([10.0, 10, 1, 1])
    assert abs(riccati).max() < 1e-10 * abs(x).max()

    def law(t, q, v):
        return float((-gain.K @ kte.displacement(cart_pole, [0, 0], [0, 0], q, v))[0])

    m = kte.simulate(cart_pole, [0.5, 0.4], time=10, inputs={"motor": law})
    assert abs(m.q[-1]).max() < 1e-3 and abs(m.q[0] - [0.5, 0.4]).max() == 0

    sampled = kte.discretize(linear, 0.02)
    term, exponential = np.eye(4), np.eye(4)
    for k in range(1, 20):
        term = term @ a * (0.02 / k)
        exponential = exponential + term
    np.testing.assert_allclose(sampled.A, exponential, atol=1e-15)
    slow = kte.lqr(sampled, np.diag([10, 10, 1, 1]), [[0.1]])
    assert (abs(slow.poles) < 1).all() and slow.K.shape == (1, 4)
    same = kte.lqr((linear.A, linear.B), [10, 10, 1, 1], 0.1)
    np.testing.assert_array_equal(same.K, gain.K)


def test_a_free_body_has_twelve_displacements():
    body = kte.Chain(kte.free_joint_3D("pose", "world", "body"), kte.inertia_3D("body", 2, inertia=[1, 2, 3]))
    q0, w = kte.neutral_configuration(body), np.array([0, 0, 0, 0.1, 0.2, 0.3])
    linear = kte.linearize(body, q0, w)
    assert linear.A.shape == (12, 12) and linear.B.shape == (12, 0)
    d = 1e-6 * np.arange(1.0, 7)
    moved = kte.integrate(body, q0, d)
    np.testing.assert_allclose(kte.displacement(body, q0, w, moved, w), [*d, *np.zeros(6)], atol=1e-16)
    many = kte.displacement(body, q0, w, np.stack([moved, q0]), w)
    assert many.shape == (2, 12) and not many[1].any()


def test_what_cannot_be_regulated_is_refused(cart_pole):
    alone = kte.Chain(kte.revolute_joint_2D("angle", "ground", "pole"), kte.inertia_2D("pole", 1, com=[0, 1]), gravity=[0, -9.81])
    linear = kte.linearize(alone, [0])
    with pytest.raises(kte.BadArgument, match="dt must be finite and positive, got -1"):
        kte.discretize(linear, -1)
    with pytest.raises(TypeError, match="system must be a LinearSystem"):
        kte.discretize((linear.A, linear.B), 0.1)
    with pytest.raises(TypeError, match=r"a pair \(A, B\), not 1"):
        kte.lqr(1, [1], [1])
    with pytest.raises(kte.NoSolution, match="mode"):
        kte.lqr((linear.A, np.zeros((2, 1))), [1, 1], 1)
    with pytest.raises(kte.BadArgument, match="Q"):
        kte.lqr(kte.linearize(cart_pole, [0, 0]), [1, 1], 1)
    with pytest.raises(kte.UnknownName, match="no input 'engine'"):
        kte.linearize(cart_pole, [0, 0], inputs={"engine": 1})
    with pytest.raises(kte.BadArgument, match="shape"):
        kte.linearize(cart_pole, [0, 0, 0])
