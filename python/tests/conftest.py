"""Mechanisms that tests share."""
from pathlib import Path

import numpy as np
import pytest

import kte

ROBOTS = Path(__file__).resolve().parents[2] / "tests" / "data" / "robots"


@pytest.fixture
def robots():
    """The folder of robot files."""
    return ROBOTS


@pytest.fixture
def iiwa():
    return kte.load_robot(ROBOTS / "iiwa14.urdf")


@pytest.fixture
def pendulum():
    return kte.Chain(
        kte.revolute_joint_2D("q", "base", "joint"),
        kte.rigid_link_2D("joint", "tip", [0.5, 0]),
        kte.inertia_2D("tip", mass=1),
        gravity=[0, -9.81],
    )


@pytest.fixture
def four_bar():
    bar = dict(mass=1, com=[0.3, 0], inertia=0.02)
    return kte.Chain(
        kte.revolute_joint_2D("crank", "base", "a"),
        kte.inertia_2D("a", **bar),
        kte.rigid_link_2D("a", "A", [0.4, 0]),
        kte.revolute_joint_2D("coupler", "A", "b"),
        kte.inertia_2D("b", **bar),
        kte.rigid_link_2D("b", "B1", [1.1, 0]),
        kte.revolute_joint_2D("rocker", "base", "r", position=[1, 0]),
        kte.inertia_2D("r", **bar),
        kte.rigid_link_2D("r", "B2", [0.8, 0]),
        kte.coincident_points_2D("pin", "B1", "B2"),
        gravity=[0, -9.81],
    )


@pytest.fixture
def random():
    return np.random.default_rng(1)
