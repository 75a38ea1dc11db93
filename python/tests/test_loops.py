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
