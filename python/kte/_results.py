"""Named tuples that functions return."""
from __future__ import annotations

from typing import Any, Dict, List, NamedTuple

import numpy as np

from ._poses import Array as Array
from ._poses import Pose as Pose

__all__ = [
    "Array",
    "Coordinate",
    "Pose",
    "LinearAngular",
    "Wrench",
    "Energy",
    "MassCentre",
    "BodyInertia",
    "InverseDynamicsDerivatives",
    "ForwardDynamicsDerivatives",
    "HybridDynamics",
    "ConstrainedDynamics",
    "ConstrainedDynamicsDerivatives",
    "Contact",
    "ContactDynamics",
    "ContactDynamicsDerivatives",
    "ForceDerivatives",
    "Impact",
    "SupportPolygon",
    "Loops",
    "Note",
    "Motor",
    "Limits",
    "InverseKinematics",
    "MotionPoint",
    "Rollout",
    "Stability",
    "Equilibrium",
    "EquilibriumPath",
    "NaturalModes",
    "LinearSystem",
    "DiscreteLinearSystem",
    "Feedback",
    "Frame",
    "EventOccurrence",
    "ColumnStatistics",
    "SweepFailure",
    "SweepProgress",
    "SweepSummary",
]


class Coordinate(NamedTuple):
    """Where a coordinate is in q and v: `q[c.q]`, `v[c.v]`. `kind` is "coordinate", "3D rotation", "3D pose" ..."""

    name: str
    kind: str
    q: slice
    v: slice


class LinearAngular(NamedTuple):
    """A linear and an angular part."""

    linear: Array
    angular: Array


class Wrench(NamedTuple):
    """A force, N, and a torque, Nm."""

    force: Array
    torque: Array


class Energy(NamedTuple):
    """Energies, J."""

    kinetic: Any
    potential: Any


class MassCentre(NamedTuple):
    """Mass, kg, and centre of mass, m."""

    mass: Any
    position: Array


class BodyInertia(NamedTuple):
    """Mass, kg, first moment, kg m, and inertia, kg m^2, of bodies about a point."""

    mass: Any
    moment: Array
    inertia: Array


class InverseDynamicsDerivatives(NamedTuple):
    """Generalized forces and their derivatives."""

    tau: Array
    by_q: Array
    by_v: Array
    by_a: Array


class ForwardDynamicsDerivatives(NamedTuple):
    """Accelerations and their derivatives."""

    a: Array
    by_q: Array
    by_v: Array
    by_tau: Array


class HybridDynamics(NamedTuple):
    """Accelerations and generalized forces."""

    a: Array
    tau: Array


class ConstrainedDynamics(NamedTuple):
    """Accelerations of a chain with loops, and the forces of its closures."""

    a: Array
    loops: Dict[str, Wrench]
    rank: int
    mobility: int
    dependent: List[str]


class ConstrainedDynamicsDerivatives(NamedTuple):
    """Derivatives of accelerations and of closure forces, which are by the rows of `loop_jacobian`."""

    a: Array
    by_q: Array
    by_v: Array
    by_tau: Array
    forces: Array
    forces_by_q: Array
    forces_by_v: Array
    forces_by_tau: Array


class Contact(NamedTuple):
    """A rigid contact, in axes of its surface: force on the body, point, velocity and direction of sliding."""

    mode: str
    gap: float
    force: Array
    point: Array
    slip: Array
    direction: Array


class ContactDynamics(NamedTuple):
    """Accelerations of a chain with rigid contacts."""

    a: Array
    contacts: Dict[str, Contact]
    several: bool


class ForceDerivatives(NamedTuple):
    """Derivatives of the force of a contact."""

    by_q: Array
    by_v: Array
    by_tau: Array


class ContactDynamicsDerivatives(NamedTuple):
    """Derivatives of accelerations and contact forces."""

    a: Array
    by_q: Array
    by_v: Array
    by_tau: Array
    forces: Dict[str, ForceDerivatives]


class Impact(NamedTuple):
    """The velocities after an impact, impulses, change of the kinetic energy, and factor of restitution."""

    v: Array
    impulses: Dict[str, Array]
    energy: float
    restitution: float


class SupportPolygon(NamedTuple):
    """The convex hull of contacts with one plane."""

    contacts: List[str]
    corners: Array
    normal: Array
    area: float


class Loops(NamedTuple):
    """The closures of a chain at a configuration."""

    rows: int
    rank: int
    mobility: int
    pivot_ratio: float
    gap: float
    widest: str
    dependent: List[str]
    blocks: List[str]


class Note(NamedTuple):
    """A note on a robot's file: text, line, included file, and whether the motion differs from that of the file."""

    text: str
    line: int
    file: str
    changes_motion: bool


class Motor(NamedTuple):
    """A motor of a robot: the input of its command, its joint, and the place of that in v."""

    input: str
    joint: str
    v: int


class Limits(NamedTuple):
    """Limits over v; infinite if absent."""

    lower: Array
    upper: Array
    rate: Array
    acceleration: Array
    jerk: Array
    effort: Array


class InverseKinematics(NamedTuple):
    """A configuration for a pose, its status, and its errors, m and rad."""

    q: Array
    status: str
    position_error: float
    rotation_error: float


class MotionPoint(NamedTuple):
    """A configuration with its rates and accelerations, or many."""

    q: Array
    v: Array
    a: Array


class Rollout(NamedTuple):
    """Motions of `rollout`: times, s, and states, (n, len(t), nq) and (n, len(t), nv)."""

    t: Array
    q: Array
    v: Array


class Stability(NamedTuple):
    """The smallest eigenvalue of the derivative of forces, N/m or Nm/rad, the number of negative ones, and the largest
    asymmetry, relative to the derivative: zero if all forces have a potential."""

    stiffness: float
    unstable: int
    asymmetry: float


class Equilibrium(NamedTuple):
    """A static equilibrium: its configuration, its status, the load factor, and the largest remaining force, N or Nm."""

    q: Array
    status: str
    load: float
    residual: float
    stability: Stability
    load_steps: int
    iterations: int


class EquilibriumPath(NamedTuple):
    """Equilibria along a parameter: its values, a configuration a row, and their stability."""

    parameter: Array
    q: Array
    stiffness: Array
    unstable: np.ndarray[Any, np.dtype[np.int64]]


class NaturalModes(NamedTuple):
    """Modes about an equilibrium: frequencies, rad/s, ratios of damping, roots, 1/s, and shapes, a column a mode."""

    frequency: Array
    damping: Array
    root: np.ndarray[Any, np.dtype[np.complex128]]
    shape: np.ndarray[Any, np.dtype[np.complex128]]


class LinearSystem(NamedTuple):
    """d' = x_dot + A d + B du, near a state: d are displacements along the numbers of v, then their rates, then
    internal states; u are the `inputs`, by name, three numbers for a vector."""

    A: Array
    B: Array
    x_dot: Array
    inputs: List[str]


class DiscreteLinearSystem(NamedTuple):
    """d_(k+1) = step + A d_k + B du_k, with constant inputs for dt, s."""

    A: Array
    B: Array
    step: Array
    dt: float
    inputs: List[str]


class Feedback(NamedTuple):
    """u = u0 - K d, the cost d' X d from d on, and the poles of the closed loop."""

    K: Array
    X: Array
    poles: np.ndarray[Any, np.dtype[np.complex128]]


class Frame(NamedTuple):
    """A frame in a state; rates and forces in its own axes."""

    position: Array
    rotation: Array
    velocity: Array
    ang_velocity: Array
    acceleration: Array
    ang_acceleration: Array
    force: Array
    torque: Array


class EventOccurrence(NamedTuple):
    """An event that has happened: name, time, s, and the state after and before its reset. Of contacts: what has
    changed, such as "'foot': impact, sticks"."""

    name: str
    time: float
    q: Array
    v: Array
    q_before: Array
    v_before: Array
    what: str = ""


class ColumnStatistics(NamedTuple):
    """Statistics of a kept column of a sweep over the cases with a number, updated in the order of the cases."""

    cases: int
    least: float
    most: float
    mean: float
    deviation: float


class SweepFailure(NamedTuple):
    """A case without a result: its number, and the reason."""

    case: int
    reason: str


class SweepProgress(NamedTuple):
    """How far a sweep is: cases, of them found from an earlier run, done and failed; time, s, cases per s, time left, s."""

    total: int
    found: int
    done: int
    failed: int
    seconds: float
    rate: float
    left: float


class SweepSummary(NamedTuple):
    """What a sweep has done: counts of cases, and statistics of the kept columns."""

    cases: int
    failed: int
    statistics: Dict[str, ColumnStatistics]
