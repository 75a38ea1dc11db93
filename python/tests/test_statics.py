"""Equilibria, their paths and small motions: those of docs/statics.md."""
import numpy as np
import pytest

import kte


def test_modes_of_a_car():
    car = kte.Chain(
        kte.base_gen("road"),
        kte.inertia_gen("wheel", 40),
        kte.inertia_gen("body", 300),
        kte.spring_gen("road", "wheel", 0, 2e5),
        kte.spring_gen("wheel", "body", 0, 2e4),
        kte.damper_gen("wheel", "body", 1500),
    )
    modes = kte.natural_modes(car, [0, 0])
    np.testing.assert_allclose(modes.frequency, [7.89906, 73.091], rtol=1e-5)
    np.testing.assert_allclose(modes.damping, [0.267924, 0.261778], rtol=1e-5)
    np.testing.assert_allclose(abs(modes.root), modes.frequency, rtol=1e-12)
    assert modes.shape.shape == (2, 2) and modes.shape.dtype == complex and (modes.root.imag > 0).all()


@pytest.fixture
def truss():
    return kte.Chain(
        kte.base_2D("ground"),
        kte.rigid_link_2D("ground", "left", [-4, 0]),
        kte.rigid_link_2D("ground", "right", [4, 0]),
        kte.prismatic_joint_2D("y", "ground", "top", [0, 1]),
        kte.spring_2D("left", "top", 5, 100),
        kte.spring_2D("right", "top", 5, 100),
    )


def test_a_truss_snaps_through(truss):
    loaded = kte.Chain(truss, kte.constant_force_2D("top", [0, -100]))
    path = kte.equilibrium_path(loaded, [3.0], step=0.02)
    before = path.q[:, 0] > 0
    assert path.parameter[before].max() == pytest.approx(0.513781, abs=1e-4) and path.q[-1] == pytest.approx([-4.06309], abs=1e-4)
    assert set(path.unstable) == {0, 1} and ((path.stiffness < 0) == (path.unstable == 1)).all() and path.parameter[-1] == 1


def test_equilibria_under_loads_and_what_nothing_holds(truss):
    r = kte.static_equilibrium(truss, [3.0], loads={"top": [0, -40, 0]})
    assert r.status == "stable" and r.load == 1 and r.residual < 1e-9 and r.stability.unstable == 0 and 2 < r.q[0] < 3
    forces = kte.static_forces(truss, r.q) - kte.external_forces(truss, r.q, {"top": [0, -40, 0]})
    assert abs(forces[0]) < 1e-9
    free = kte.Chain(kte.prismatic_joint_2D("x", "ground", "block", [1, 0]), kte.inertia_2D("block", 1))
    with pytest.raises(kte.NoSolution, match="nothing holds 'x'"):
        kte.static_equilibrium(free, [0.0], loads={"block": [1, 0, 0]})
    with pytest.raises(kte.BadArgument, match="a wrench has 2 numbers"):
        kte.static_equilibrium(truss, [3.0], loads={"top": [0, 1]})
