import numpy as np
import pytest

import kte


@pytest.fixture
def closed(four_bar):
    q = kte.assemble(four_bar, [1.1, -0.5, 1.5], held="crank")
    return four_bar, q, kte.consistent_velocities(four_bar, q, [2, 0, 0])


def test_loops_are_assembled(closed):
    chain, q, v = closed
    assert q[0] == 1.1
    report = kte.loops(chain, q)
    assert report.gap < 1e-14 and (report.rows, report.rank, report.mobility) == (2, 2, 1)
    np.testing.assert_allclose(kte.loop_jacobian(chain, q) @ v, 0, atol=1e-14)
    with pytest.raises(kte.CannotAssemble, match="'rod' stays open"):
        kte.assemble(kte.Chain(chain, kte.distance_2D("rod", "A", "base", 5.0)), q)


def test_constrained_dynamics_agrees_with_actuated_forces(closed):
    chain, q, v = closed
    tau = np.array([3.0, 0, 0])
    r = kte.constrained_dynamics(chain, q, v, tau)
    np.testing.assert_allclose(kte.forward_dynamics(chain, q, v, tau), r.a, atol=1e-12)
    np.testing.assert_allclose(kte.actuated_forces(chain, q, v, r.a, "crank"), [3], atol=1e-12)
    assert r.mobility == 1 and set(r.loops) == {"pin"}
    g = kte.loop_motion(chain, q, ["crank"])
    np.testing.assert_allclose(g[:, 0] * v[0], v, atol=1e-13)


def test_loops_stay_closed_in_simulations(closed):
    chain, q, v = closed
    motion = kte.simulate(chain, q, v, time=2, every=0.1)
    assert max(kte.loops(chain, x).gap for x in motion.q) < 1e-13
    energies = kte.energy(kte.Chain(chain.elements[:-1], gravity=chain.gravity), motion.q, motion.v)
    np.testing.assert_allclose(energies.kinetic + energies.potential, energies.kinetic[0] + energies.potential[0], atol=1e-6)
    with pytest.raises(kte.BadArgument, match="pin"):
        kte.simulate(chain, [0, 0, 0], time=1)


def test_what_holds_a_mechanism_at_rest(closed):
    """Without motion, and without accelerations: forces against gravity, by virtual work."""
    chain, q, v = closed
    none = np.zeros(3)
    g = kte.loop_motion(chain, q, "crank")
    np.testing.assert_allclose(kte.actuated_forces(chain, q, none, none, "crank"), g.T @ kte.gravity_forces(chain, q), rtol=1e-13)
    with pytest.raises(kte.BadArgument, match="do not keep 'pin' closed"):
        kte.actuated_forces(chain, q, none, [1e-3, 0, 0], "crank")


def test_assemblies_and_a_flat_guess(four_bar):
    """From a linkage that lies flat no direction brings the ends nearer: it starts beside the guess."""
    for held in ((), "crank"):
        q = kte.assemble(four_bar, [0, 0, 0], held=held)
        assert kte.loops(four_bar, q).gap < 1e-14 and (not held or q[0] == 0)
    both = kte.assemblies(four_bar, 50, [1.1, 0, 0], held="crank")
    assert both.shape == (2, 3) and (both[:, 0] == 1.1).all()
    joint = 0.4 * np.exp(1.1j)  # the rocker, from the diagonal and the law of cosines
    diagonal = joint - 1
    angle = np.arccos((abs(diagonal) ** 2 + 0.8**2 - 1.1**2) / (2 * 0.8 * abs(diagonal)))
    np.testing.assert_allclose(np.sort(np.mod(both[:, 2], 2 * np.pi)), np.sort(np.mod(np.angle(diagonal) + [angle, -angle], 2 * np.pi)), atol=1e-13)
    with pytest.raises(kte.BadArgument, match="n must not be negative, got -1"):
        kte.assemblies(four_bar, -1)


def test_derivatives_on_the_loops(closed):
    chain, q, v = closed
    tau, h = np.array([3.0, 0, 0]), 1e-5
    r = kte.constrained_dynamics_derivatives(chain, q, v, tau)
    forces = lambda tau: kte.constrained_dynamics(chain, q, v, tau)
    np.testing.assert_allclose(r.a, forces(tau).a, atol=1e-12)
    np.testing.assert_allclose(np.abs(r.forces), np.abs(forces(tau).loops["pin"].force[:2]), atol=1e-12)
    for k, step in enumerate(h * np.eye(3)):
        np.testing.assert_allclose(r.by_tau[:, k], (forces(tau + step).a - forces(tau - step).a) / (2 * h), atol=1e-8)

    def crank(angle, rate):
        at = kte.assemble(chain, [angle, *q[1:]], held="crank")
        return kte.constrained_dynamics(chain, at, kte.loop_motion(chain, at, "crank")[:, 0] * rate, tau).a[0]

    y = kte.actuated_dynamics_derivatives(chain, q, kte.loop_motion(chain, q, "crank")[:, 0] * 2, tau, "crank")
    assert y.a[0] == pytest.approx(crank(q[0], 2), rel=1e-12)
    assert y.by_q[0, 0] == pytest.approx((crank(q[0] + h, 2) - crank(q[0] - h, 2)) / (2 * h), rel=1e-7)
    assert y.by_v[0, 0] == pytest.approx((crank(q[0], 2 + h) - crank(q[0], 2 - h)) / (2 * h), rel=1e-7)


def test_messages_name_functions_of_python(closed):
    chain, q, v = closed
    with pytest.raises(kte.BadArgument, match="kte.actuated_forces does$"):
        kte.inverse_dynamics(chain, q, v, v)
    with pytest.raises(kte.BadArgument, match="use kte.consistent_velocities$"):
        kte.simulate(chain, q, [1, 1, 1], time=1)
    failed = kte.sweep(kte.evenly("q/crank", 0.5, 1, 2), kte.SimulationRun(chain, q, time=1), "crank").failures
    assert all("kte.assemble finds one" in f.reason for f in failed)


def test_a_peaucellier_linkage_draws_a_line():
    crank, long, side = 1.0, 4.0, 2.5

    def bar(name, base, length, coordinate, **placement):
        body = kte.inertia_2D(name, mass=1, com=[length / 2, 0], inertia=length**2 / 12)
        return [kte.revolute_joint_2D(coordinate, base, name, **placement), body, kte.rigid_link_2D(name, name + "_end", [length, 0])]

    chain = kte.Chain(
        bar("crank", "base", crank, "q", position=[crank, 0]),
        bar("o1", "base", long, "a1"),
        bar("o2", "base", long, "a2"),
        bar("s1", "crank_end", side, "b1"),
        bar("s2", "crank_end", side, "b2"),
        bar("s3", "o1_end", side, "c1"),
        bar("s4", "o2_end", side, "c2"),
        kte.coincident_points_2D("upper", "s1_end", "o1_end"),
        kte.coincident_points_2D("lower", "s2_end", "o2_end"),
        kte.coincident_points_2D("pen", "s3_end", "s4_end"),
    )
    end = crank + crank * np.exp(0.5j)
    pen = (long**2 - side**2) / end.conjugate()  # the inverse of the crank's end in a circle about the base
    middle = (end + pen) / 2
    up = middle + 1j * end / abs(end) * np.sqrt(long**2 - abs(middle) ** 2)
    down = 2 * middle - up
    angles = [0.5, *np.angle([up, down]), *(np.angle([up - end, down - end]) - 0.5), *(np.angle([pen - up, pen - down]) - np.angle([up, down]))]
    q = kte.assemble(chain, angles + 0.05 * np.sin(np.arange(7)), held="q")
    assert kte.loops(chain, q).mobility == 1
    motion = kte.simulate(chain, q, kte.loop_motion(chain, q, "q")[:, 0], time=3)
    drawn = kte.forward_kinematics(chain, motion.q, "s3_end").position
    np.testing.assert_allclose(drawn[:, 0], (long**2 - side**2) / (2 * crank), atol=1e-11)
    assert np.ptp(drawn[:, 1]) > 1
