"""The types of the compiled part of kte."""
from os import PathLike
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Tuple, Union, overload

from numpy.typing import ArrayLike

from ._element import Element, Rotation
from ._results import (
    Array,
    BodyInertia,
    ConstrainedDynamics,
    ConstrainedDynamicsDerivatives,
    ContactDynamics,
    ContactDynamicsDerivatives,
    Coordinate,
    Energy,
    Equilibrium,
    EquilibriumPath,
    EventOccurrence,
    ForwardDynamicsDerivatives,
    Frame,
    HybridDynamics,
    Impact,
    InverseDynamicsDerivatives,
    InverseKinematics,
    Limits,
    LinearAngular,
    Loops,
    MassCentre,
    MotionPoint,
    Motor,
    LinearSystem,
    NaturalModes,
    Note,
    Pose,
    SupportPolygon,
    Wrench,
)
from .simulation import Event, Gate, Law

__version__: str

_Path = Union[str, PathLike[str]]
_Inputs = Optional[Mapping[str, ArrayLike]]
_Names = Union[str, Iterable[str]]
_Part = Union[Element, "Chain", "Robot", List[Any], Tuple[Any, ...]]
_Mechanism = Union["Chain", "Robot"]

class Chain:
    def __init__(self, *parts: _Part, gravity: Optional[ArrayLike] = ...) -> None: ...
    def __lshift__(self, part: _Part) -> Chain: ...
    def add(self, *parts: _Part) -> Chain: ...
    @property
    def gravity(self) -> Array: ...
    @gravity.setter
    def gravity(self, value: ArrayLike) -> None: ...
    @property
    def nq(self) -> int: ...
    @property
    def nv(self) -> int: ...
    @property
    def elements(self) -> List[Element]: ...
    @property
    def coordinates(self) -> List[str]: ...
    @property
    def frames(self) -> List[str]: ...
    @property
    def inputs(self) -> List[str]: ...
    @property
    def layout(self) -> List[Coordinate]: ...
    def check(self) -> List[str]: ...
    def parameters(self) -> Dict[str, float]: ...
    def _repr_html_(self) -> str: ...
    def with_parameters(self, values: Mapping[str, float]) -> Chain: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> Chain: ...
    def __deepcopy__(self, memo: Any) -> Chain: ...
    def __reduce__(self) -> Any: ...
    def _become(self, chain: Chain) -> None: ...
    def _pickle(self) -> Tuple[bytes, Optional[List[str]]]: ...
    __hash__: None  # type: ignore[assignment]

class Robot:
    @property
    def chain(self) -> Chain: ...
    @property
    def name(self) -> str: ...
    @property
    def file(self) -> str: ...
    @property
    def limits(self) -> Limits: ...
    @property
    def soft_limits(self) -> Limits: ...
    @property
    def joints(self) -> List[str]: ...
    @property
    def loops(self) -> List[str]: ...
    @property
    def contacts(self) -> List[str]: ...
    @property
    def configurations(self) -> Dict[str, Array]: ...
    @property
    def motors(self) -> List[Motor]: ...
    @property
    def warnings(self) -> List[Note]: ...
    @property
    def not_read(self) -> List[Note]: ...
    def check(self) -> List[str]: ...
    def add_motors(
        self,
        *,
        stiffness: float = ...,
        damping: float = ...,
        stop_stiffness: float = ...,
        stop_damping: float = ...,
    ) -> None: ...
    def _repr_html_(self) -> str: ...
    def __copy__(self) -> Robot: ...
    def __deepcopy__(self, memo: Any) -> Robot: ...
    def __reduce__(self) -> Any: ...
    def _put_chain(self, chain: Chain) -> None: ...

class State:
    def __init__(
        self,
        chain: _Mechanism,
        q: Optional[ArrayLike] = ...,
        v: Optional[ArrayLike] = ...,
        a: Optional[ArrayLike] = ...,
        *,
        inputs: _Inputs = ...,
    ) -> None: ...
    @property
    def q(self) -> Array: ...
    @q.setter
    def q(self, value: ArrayLike) -> None: ...
    @property
    def v(self) -> Array: ...
    @v.setter
    def v(self, value: ArrayLike) -> None: ...
    @property
    def a(self) -> Array: ...
    @a.setter
    def a(self, value: ArrayLike) -> None: ...
    @property
    def f(self) -> Array: ...
    @property
    def outputs(self) -> Dict[str, Any]: ...
    def set_inputs(self, inputs: Mapping[str, ArrayLike]) -> None: ...
    def __getstate__(self) -> Tuple[Any, ...]: ...
    def __setstate__(self, state: Tuple[Any, ...]) -> None: ...
    def do_motion(self) -> None: ...
    def do_force(self) -> None: ...
    def frame(self, name: str) -> Frame: ...

class Recording:
    @property
    def t(self) -> Array: ...
    @property
    def q(self) -> Array: ...
    @property
    def v(self) -> Array: ...
    @property
    def z(self) -> Array: ...
    @property
    def u(self) -> Array: ...
    @property
    def events(self) -> List[EventOccurrence]: ...
    @property
    def reason(self) -> str: ...
    @property
    def stopped_by(self) -> str: ...
    @property
    def statistics(self) -> Dict[str, int]: ...
    @property
    def chain(self) -> Chain: ...
    def columns(self, names: Optional[_Names] = ..., event_rows: bool = ...) -> Dict[str, Array]: ...
    def to_pandas(self, names: Optional[_Names] = ..., event_rows: bool = ...) -> Any: ...
    def to_xarray(self, names: Optional[_Names] = ..., event_rows: bool = ...) -> Any: ...
    @overload
    def __getitem__(self, names: str) -> Array: ...
    @overload
    def __getitem__(self, names: Union[List[str], Tuple[str, ...]]) -> Dict[str, Array]: ...
    def _repr_html_(self) -> str: ...
    def __contains__(self, name: object) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __getstate__(self) -> Tuple[Any, ...]: ...
    def __setstate__(self, state: Tuple[Any, ...]) -> None: ...

class Simulation:
    def __init__(
        self,
        chain: _Mechanism,
        q: ArrayLike,
        v: Optional[ArrayLike] = ...,
        *,
        t: float = ...,
        solver: str = ...,
        tolerance: float = ...,
        absolute: Optional[float] = ...,
        relative: Optional[float] = ...,
        step: float = ...,
        max_steps: int = ...,
        largest_step: float = ...,
        control: Union[None, ArrayLike, Law] = ...,
        control_every: Optional[float] = ...,
        inputs: Optional[Mapping[str, Union[ArrayLike, Law]]] = ...,
        events: Union[None, Event, Iterable[Event]] = ...,
        only_if: Optional[Mapping[str, Gate]] = ...,
        implicit_control: bool = ...,
    ) -> None: ...
    def __reduce__(self) -> Any: ...
    def advance(self, end: float, *, every: Optional[float] = ..., at: Optional[ArrayLike] = ...) -> Recording: ...
    @property
    def t(self) -> float: ...
    @property
    def q(self) -> Array: ...
    @property
    def v(self) -> Array: ...
    @property
    def recording(self) -> Optional[Recording]: ...
    @property
    def statistics(self) -> Dict[str, int]: ...
    def set_control(self, control: Union[ArrayLike, Law]) -> None: ...
    def set_inputs(self, inputs: Mapping[str, Union[ArrayLike, Law]]) -> None: ...

class Distribution:
    @property
    def name(self) -> str: ...
    def __reduce__(self) -> Any: ...

class Cases:
    @property
    def names(self) -> List[str]: ...
    def values(self, begin: int = ..., end: Optional[int] = ...) -> Array: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, i: slice) -> Cases: ...
    @overload
    def __getitem__(self, i: int) -> Dict[str, float]: ...
    def __mul__(self, other: Cases) -> Cases: ...
    def __reduce__(self) -> Any: ...

def one_of(name: str, values: ArrayLike) -> Cases: ...
def evenly(name: str, first: float, last: float, n: int) -> Cases: ...
def list_of_cases(names: Iterable[str], values: ArrayLike) -> Cases: ...
def random_cases(n: int, seed: int, columns: Union[Distribution, Iterable[Distribution]]) -> Cases: ...
def sobol_cases(n: int, columns: Union[Distribution, Iterable[Distribution]]) -> Cases: ...
def uniform(name: str, least: float, most: float) -> Distribution: ...
def log_uniform(name: str, least: float, most: float) -> Distribution: ...
def normal(name: str, mean: float, deviation: float) -> Distribution: ...
def compile(chain: _Mechanism, frames: _Names = ...) -> Chain: ...
def static_equilibrium(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    loads: Optional[Mapping[str, ArrayLike]] = ...,
    tolerance: float = ...,
    iterations: int = ...,
    must_reach: bool = ...,
) -> Equilibrium: ...
def equilibrium_path(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    parameter: str = ...,
    start: float = ...,
    end: float = ...,
    step: float = ...,
    points: int = ...,
    inputs: _Inputs = ...,
    loads: Optional[Mapping[str, ArrayLike]] = ...,
    tolerance: float = ...,
) -> EquilibriumPath: ...
def natural_modes(chain: _Mechanism, q: ArrayLike, *, inputs: _Inputs = ...) -> NaturalModes: ...
def linearize(
    chain: _Mechanism, q: ArrayLike, v: Optional[ArrayLike] = ..., *, inputs: _Inputs = ..., t: float = ...
) -> LinearSystem: ...
def _rollout_in_lanes(
    chain: _Mechanism, q: ArrayLike, v: ArrayLike, tau: ArrayLike, every: float, step: float, threads: Optional[int]
) -> Optional[Tuple[Array, Array]]: ...
def _discretize(A: ArrayLike, B: ArrayLike, x_dot: ArrayLike, dt: float) -> Tuple[Array, Array, Array]: ...
def _lqr(A: ArrayLike, B: ArrayLike, Q: ArrayLike, R: ArrayLike, N: ArrayLike, discrete: bool) -> Tuple[Any, Any, Any]: ...
def reduced(chain: _Mechanism, q: ArrayLike, locked: _Names) -> Chain: ...

class Motion:
    @property
    def duration(self) -> float: ...
    def __reduce__(self) -> Any: ...
    def __call__(self, t: ArrayLike) -> MotionPoint: ...

def trapezoidal_motion(robot: _Mechanism, start: ArrayLike, end: ArrayLike, *, limits: Optional[Limits] = ...) -> Motion: ...
def quintic_motion(
    robot: _Mechanism, start: ArrayLike, end: ArrayLike, at_least: float = ..., *, limits: Optional[Limits] = ...
) -> Motion: ...
def _refuse_masked(name: str, x: Any) -> None: ...
def _chain_from(bytes: bytes, compiled_frames: Optional[List[str]]) -> Chain: ...
def _check_element(record: Any) -> None: ...
def element_types() -> List[str]: ...
def inverse_dynamics(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def forward_dynamics(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    tau: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def mass_matrix(chain: _Mechanism, q: ArrayLike, *, threads: Optional[int] = ..., errors: str = ...) -> Array: ...
def mass_matrix_inverse(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def gravity_forces(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def static_forces(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def nonlinear_effects(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def coriolis_forces(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def coriolis_matrix(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def mass_matrix_rate(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def inverse_dynamics_derivatives(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> InverseDynamicsDerivatives: ...
def forward_dynamics_derivatives(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    tau: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> ForwardDynamicsDerivatives: ...
def inertial_parameters(chain: _Mechanism) -> Array: ...
def torque_regressor(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def hybrid_dynamics(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    known: ArrayLike,
    prescribed: _Names,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> HybridDynamics: ...
def potential_energy(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Any: ...
def kinetic_energy(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Any: ...
def energy(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Energy: ...
def centre_of_mass(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> MassCentre: ...
def centre_of_mass_velocity(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def centre_of_mass_acceleration(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def centre_of_mass_jacobian(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def centroidal_momentum(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> LinearAngular: ...
def centroidal_momentum_rate(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> LinearAngular: ...
def centroidal_momentum_matrix(
    chain: _Mechanism,
    q: ArrayLike,
    *,
    inputs: _Inputs = ...,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def subtree_inertia(
    chain: _Mechanism,
    q: ArrayLike,
    frame: str,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> BodyInertia: ...
@overload
def forward_kinematics(
    chain: _Mechanism, q: ArrayLike, frame: str, *, threads: Optional[int] = ..., errors: str = ...
) -> Pose: ...
@overload
def forward_kinematics(
    chain: _Mechanism, q: ArrayLike, frame: None = ..., *, threads: Optional[int] = ..., errors: str = ...
) -> Dict[str, Pose]: ...
def relative_pose(
    chain: _Mechanism,
    q: ArrayLike,
    frame: str,
    reference: str,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Pose: ...
def frame_velocity(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    frame: str,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> LinearAngular: ...
def frame_acceleration(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    frame: str,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> LinearAngular: ...
def jacobian(
    chain: _Mechanism,
    q: ArrayLike,
    frame: str,
    axes: str = ...,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def jacobian_rate(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    frame: str,
    axes: str = ...,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def relative_jacobian(
    chain: _Mechanism,
    q: ArrayLike,
    frame: str,
    reference: str,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def bias_acceleration(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    frame: str,
    axes: str = ...,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> LinearAngular: ...
def external_forces(
    chain: _Mechanism,
    q: ArrayLike,
    wrenches: Mapping[str, ArrayLike],
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Array: ...
def joint_reaction(
    chain: _Mechanism,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    frame: str,
    *,
    threads: Optional[int] = ...,
    errors: str = ...,
) -> Wrench: ...
def neutral_configuration(chain: _Mechanism) -> Array: ...
def integrate(chain: _Mechanism, q: ArrayLike, v: ArrayLike, dt: float = ...) -> Array: ...
def difference(chain: _Mechanism, q0: ArrayLike, q1: ArrayLike) -> Array: ...
def interpolate(chain: _Mechanism, q0: ArrayLike, q1: ArrayLike, t: float) -> Array: ...
def random_configuration(
    chain: _Mechanism, lower: ArrayLike, upper: ArrayLike, seed: int, n: Optional[int] = ...
) -> Array: ...
def assemble(chain: _Mechanism, guess: ArrayLike, held: _Names = ...) -> Array: ...
def assemblies(chain: _Mechanism, n: int, q: Optional[ArrayLike] = ..., held: _Names = ...) -> Array: ...
def consistent_velocities(chain: _Mechanism, q: ArrayLike, v: ArrayLike) -> Array: ...
def constrained_dynamics(chain: _Mechanism, q: ArrayLike, v: ArrayLike, tau: ArrayLike) -> ConstrainedDynamics: ...
def constrained_dynamics_derivatives(
    chain: _Mechanism, q: ArrayLike, v: ArrayLike, tau: ArrayLike
) -> ConstrainedDynamicsDerivatives: ...
def actuated_dynamics_derivatives(
    chain: _Mechanism, q: ArrayLike, v: ArrayLike, tau: ArrayLike, actuated: _Names
) -> ForwardDynamicsDerivatives: ...
def loops(chain: _Mechanism, q: ArrayLike) -> Loops: ...
def loop_jacobian(chain: _Mechanism, q: ArrayLike) -> Array: ...
def loop_motion(chain: _Mechanism, q: ArrayLike, actuated: _Names) -> Array: ...
def actuated_forces(chain: _Mechanism, q: ArrayLike, v: ArrayLike, a: ArrayLike, actuated: _Names) -> Array: ...
def contact_dynamics(chain: _Mechanism, q: ArrayLike, v: ArrayLike, tau: ArrayLike) -> ContactDynamics: ...
def contact_dynamics_derivatives(
    chain: _Mechanism, q: ArrayLike, v: ArrayLike, tau: ArrayLike
) -> ContactDynamicsDerivatives: ...
def impact(chain: _Mechanism, q: ArrayLike, v: ArrayLike, sequential: bool = ...) -> Impact: ...
def contact_jacobian(chain: _Mechanism, q: ArrayLike, contacts: _Names = ...) -> Array: ...
def contact_jacobian_rate(chain: _Mechanism, q: ArrayLike, v: ArrayLike, contacts: _Names = ...) -> Array: ...
def delassus_matrix(chain: _Mechanism, q: ArrayLike, contacts: _Names = ...) -> Array: ...
def operational_inertia(
    chain: _Mechanism, q: ArrayLike, contacts: _Names = ..., *, frame: Optional[str] = ...
) -> Array: ...
def support_polygon(chain: _Mechanism, q: ArrayLike, contacts: _Names = ...) -> SupportPolygon: ...
def centre_of_pressure(
    chain: _Mechanism, q: ArrayLike, v: ArrayLike, tau: ArrayLike, contacts: _Names = ...
) -> Array: ...
def save_model(path: _Path, chain: _Mechanism) -> None: ...
def load_model(path: _Path) -> Chain: ...
def load_robot(
    path: _Path,
    *,
    gravity: Optional[ArrayLike] = ...,
    root: str = ...,
    floating_base: bool = ...,
    fold_fixed: bool = ...,
    joint_dynamics: bool = ...,
    friction_smoothing: float = ...,
    quarter_turn_tolerance: float = ...,
    strict: bool = ...,
    model: str = ...,
    search_path: _Names = ...,
    contacts: Optional[Mapping[str, Any]] = ...,
) -> Robot: ...
def parse_robot(
    text: str,
    name: str = ...,
    *,
    gravity: Optional[ArrayLike] = ...,
    root: str = ...,
    floating_base: bool = ...,
    fold_fixed: bool = ...,
    joint_dynamics: bool = ...,
    friction_smoothing: float = ...,
    quarter_turn_tolerance: float = ...,
    strict: bool = ...,
    model: str = ...,
    search_path: _Names = ...,
    contacts: Optional[Mapping[str, Any]] = ...,
) -> Robot: ...
def to_urdf(robot: _Mechanism, *, lossy: bool = ...) -> str: ...
def to_mjcf(robot: _Mechanism, *, lossy: bool = ...) -> str: ...
def inverse_kinematics(
    arm: _Mechanism,
    frame: str,
    position: ArrayLike,
    rotation: Optional[Rotation] = ...,
    *,
    start: Optional[ArrayLike] = ...,
    limits: Optional[Limits] = ...,
    numeric: bool = ...,
    must_reach: bool = ...,
) -> InverseKinematics: ...
def inverse_kinematics_all(
    arm: _Mechanism, frame: str, position: ArrayLike, rotation: Rotation, *, limits: Optional[Limits] = ...
) -> List[InverseKinematics]: ...
def _write_page(
    x: Union[Chain, Robot, Recording],
    path: _Path,
    title: str,
    columns: _Names,
    mesh_bytes: int,
    recording_bytes: int,
) -> None: ...
def _product(a: Cases, b: Cases) -> Cases: ...
def _run_sweep(
    cases: Cases,
    kept: List[str],
    run: Any,
    to: Optional[_Path],
    threads: int,
    shard_size: int,
    note: str,
    depends_on: List[Tuple[str, str]],
    progress: Any,
    completed: Any,
) -> Any: ...
def _kept_names(run: Any, columns: List[str], quantities: List[str]) -> List[str]: ...
def _missing_shards(
    cases: Cases, kept: List[str], to: Optional[_Path], shard_size: int, note: str, depends_on: List[Tuple[str, str]]
) -> List[int]: ...
def _run_range(columns: List[str], kept: List[str], run: Any, begin: int, values: Array) -> Any: ...
