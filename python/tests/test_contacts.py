import numpy as np
import pytest

import kte


@pytest.fixture
def table():
    """4 kg, 0.6 m by 0.4 m, on its corners."""
    chain = kte.Chain(gravity=[0, 0, -10])
    chain << kte.free_joint_3D("pose", "ground", "table") << kte.inertia_3D("table", mass=4, inertia=[0.1, 0, 0, 0.1, 0, 0.1])
    for k, (x, y) in enumerate([(0.3, 0.2), (-0.3, 0.2), (-0.3, -0.2), (0.3, -0.2)]):
        chain << kte.rigid_link_3D("table", f"end {k}", [x, y, -0.5])
        chain << kte.sphere_contact_3D(f"foot {k}", "ground", f"end {k}", surface_axis=[0, 0, 1], surface_radius=0, radius=0, friction=0.5)
    return chain, np.array([1, 2, 0.5, 1, 0, 0, 0.0])


def test_contact_dynamics_of_a_table(table):
    chain, q = table
    still = np.zeros(6)
    r = kte.contact_dynamics(chain, q, still, [0, 0, 0, 2, 4, 0])
    np.testing.assert_allclose(r.a, 0, atol=1e-10)
    assert {x.mode for x in r.contacts.values()} == {"sticks"}
    np.testing.assert_allclose(sum(x.force for x in r.contacts.values()), [0, 0, 40], atol=1e-10)
    np.testing.assert_allclose(kte.centre_of_pressure(chain, q, still, [0, 0, 0, 2, 4, 0]), [1.1, 1.95, 0], atol=1e-10)
    slides = kte.contact_dynamics(chain, q, [1, 0, 0, 0, 0, 0], still)
    np.testing.assert_allclose(slides.a[0], -5, atol=1e-10)
    assert slides.contacts["foot 0"].mode == "slides"
    with pytest.raises(kte.BadArgument, match="foot 0' approaches"):
        kte.contact_dynamics(chain, q, [0, 0, -1, 0, 0, 0], still)


def test_derivatives_are_those_of_contact_dynamics(table):
    chain, q = table
    v, tau = np.array([0.3, 0.4, 0, 0, 0, 0]), np.array([1, 2, 3, 0.1, 0.2, 0.3])
    r = kte.contact_dynamics_derivatives(chain, q, v, tau)
    for k in [0, 1, 5]:  # others open contacts
        step = 1e-6 * np.eye(6)[k]
        by_v = [kte.contact_dynamics(chain, q, v + x, tau).a for x in (step, -step)]
        by_tau = [kte.contact_dynamics(chain, q, v, tau + x).a for x in (step, -step)]
        np.testing.assert_allclose(r.by_v[:, k], (by_v[0] - by_v[1]) / 2e-6, atol=1e-6)
        np.testing.assert_allclose(r.by_tau[:, k], (by_tau[0] - by_tau[1]) / 2e-6, atol=1e-6)
    assert r.forces["foot 0"].by_tau.shape == (3, 6)


def test_impact(table):
    chain, q = table
    r = kte.impact(chain, q, [0.1, 0, -1, 0, 0, 0])
    np.testing.assert_allclose(r.v, 0, atol=1e-12)
    np.testing.assert_allclose(sum(r.impulses.values()), [-0.4, 0, 4], atol=1e-12)
    assert r.energy == pytest.approx(-2.02)


def test_geometry_of_contacts(table):
    chain, q = table
    j = kte.contact_jacobian(chain, q)
    assert j.shape == (12, 6)
    np.testing.assert_array_equal(kte.contact_jacobian(chain, q, "foot 2"), j[6:9])
    mass = kte.mass_matrix(chain, q)
    w = kte.delassus_matrix(chain, q, "foot 1")
    np.testing.assert_allclose(w, j[3:6] @ np.linalg.solve(mass, j[3:6].T), atol=1e-14)
    np.testing.assert_allclose(kte.operational_inertia(chain, q, "foot 1") @ w, np.eye(3), atol=1e-12)
    assert kte.operational_inertia(chain, q, frame="table").shape == (6, 6)
    np.testing.assert_allclose(kte.contact_jacobian_rate(chain, q, np.zeros(6), "foot 1"), 0)
    polygon = kte.support_polygon(chain, q)
    assert polygon.corners.shape == (4, 3) and polygon.area == pytest.approx(0.24)
    with pytest.raises(kte.NoSolution, match="cannot accelerate in all directions"):
        kte.operational_inertia(chain, q)
    with pytest.raises(kte.UnknownName, match="no contact 'hand'"):
        kte.contact_jacobian(chain, q, "hand")
