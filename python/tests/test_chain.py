import copy
import pickle
import threading

import numpy as np
import pytest

import kte


def test_pendulum_has_its_acceleration(pendulum):
    assert kte.forward_dynamics(pendulum, [0.0], [0.0], [0.0]) == pytest.approx([-9.81 / 0.5], rel=1e-15)


def test_shift_appends_and_returns_the_chain():
    chain = kte.Chain()
    assert (chain << kte.revolute_joint_3D("q", "base", "arm", axis=[0, 1, 0])) is chain
    assert chain.add(kte.inertia_3D("arm", 2, [0.1, 0, 0])) is chain
    assert len(chain) == 2 and chain.nv == chain.nq == 1
    assert chain.coordinates == ["q"] and chain.frames == ["base", "arm"] and chain.inputs == []


def test_a_list_is_appended_whole_or_not_at_all(pendulum):
    with pytest.raises(kte.BadWiring, match="reads 'nowhere'"):
        pendulum << [kte.inertia_2D("tip", 1), kte.inertia_2D("nowhere", 1)]
    assert len(pendulum) == 3
    pendulum << [kte.inertia_2D("tip", 1), (kte.inertia_2D("tip", 1),)]
    assert len(pendulum) == 5


def test_chains_are_appended_with_their_gravity(pendulum):
    whole = kte.Chain(pendulum)
    assert whole == pendulum and whole.gravity.tolist() == [0, -9.81, 0]
    with pytest.raises(kte.BadWiring, match="different gravities"):
        whole << kte.Chain(kte.base_2D("other"), gravity=[0, -1.62])


def test_the_layout_tells_where_coordinates_are():
    chain = kte.Chain(kte.free_joint_3D("trunk", "world", "body"), kte.revolute_joint_3D("knee", "body", "leg"))
    trunk, knee = chain.layout
    assert (trunk.name, trunk.kind, trunk.q, trunk.v) == ("trunk", "3D pose", slice(0, 7, 1), slice(0, 6, 1))
    assert (knee.q, knee.v) == (slice(7, 8, 1), slice(6, 7, 1))
    assert kte.neutral_configuration(chain).tolist() == [0, 0, 0, 1, 0, 0, 0, 0]


def test_representations_are_readable_and_elements_evaluate_to_themselves(pendulum, four_bar):
    assert repr(pendulum) == "<kte.Chain: 3 elements, 1 degree of freedom (q), gravity (0, -9.81, 0) m/s^2>"
    for element in pendulum.elements + four_bar.elements:
        assert eval(repr(element), vars(kte)) == element
    assert repr(kte.inertia_gen("q", 2)) == "inertia_gen('q', mass=2.0)"


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda c: pickle.loads(pickle.dumps(c))])
def test_copies_are_equal_and_independent(four_bar, duplicate):
    other = duplicate(four_bar)
    assert other == four_bar and other.gravity.tolist() == four_bar.gravity.tolist()
    other << kte.inertia_2D("A", 1)
    assert other != four_bar and len(four_bar) == 10


class Arm(kte.Chain):
    """A class of a program."""

    def __init__(self, name, length):
        super().__init__(kte.revolute_joint_2D("q", "base", "arm"), kte.inertia_2D("arm", 1, [length, 0]), gravity=[0, -9.81])
        self.name, self.lengths, self.itself = name, [length], self


class SmallArm(Arm):
    __slots__ = ("mass",)


class Guarded(Arm):
    def __getstate__(self):
        return self.name

    def __setstate__(self, state):
        self.name = state + " again"


DUPLICATES = [copy.copy, copy.deepcopy, *(lambda c, n=n: pickle.loads(pickle.dumps(c, n)) for n in range(6))]


@pytest.mark.parametrize("duplicate", DUPLICATES)
def test_copies_of_derived_classes_keep_their_class_and_attributes(duplicate):
    arm = SmallArm("left", 0.5)
    arm.mass = 3
    other = duplicate(arm)
    assert type(other) is SmallArm and other == arm and other is not arm
    assert (other.name, other.lengths, other.mass) == ("left", [0.5], 3)
    deep = duplicate is not copy.copy
    assert other.itself is (other if deep else arm) and (other.lengths is not arm.lengths) == deep
    other << kte.inertia_2D("arm", 1)
    assert other != arm
    assert duplicate(Guarded("right", 1)).name == "right again"


CLASSES = [x for x in vars(kte._kte).values() if isinstance(x, type) and not issubclass(x, Exception)]
WAYS = [repr, len, str, iter, bool, hash, copy.copy, copy.deepcopy, pickle.dumps, lambda x: x == x, lambda x: x[0], lambda x: x(0)]
WAYS += [lambda x: x * x, lambda x: kte.Chain(x), lambda x: kte.compile(x), lambda x: kte.view(x), lambda x: kte.State(x)]
WAYS += [lambda x: kte.Simulation(x, []), lambda x: kte.neutral_configuration(x), lambda x: kte.sweep(x, x, "x")]


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_objects_of_which_init_was_not_called_are_refused(kind):
    class Early(kind):
        def __init__(self):
            for name in dir(kind):
                if not name.startswith("__"):
                    with pytest.raises(TypeError, match=f"{kind.__name__}.__init__..? was not called|argument|arguments"):
                        method = getattr(self, name)
                        method()
                        raise AssertionError(f"{name} is not refused")
            self.refused = True

    refused = 0
    for made in (kind.__new__(kind), Early.__new__(Early)):
        for way in WAYS:
            try:
                way(made)
            except TypeError as e:
                refused += f"{kind.__name__}.__init__() was not called" in str(e)
            except Exception:
                pass
    assert refused >= 2  # repr of both
    with pytest.raises(TypeError):
        Early()


def test_derived_classes_that_use_themselves_early_are_told_what_to_call():
    class Arm(kte.Chain):
        def __init__(self):
            self << kte.base_3D("ground")

    with pytest.raises(TypeError, match=r"Chain.__init__\(\) was not called: .* calls super\(\).__init__\(...\) before it uses self"):
        Arm()
    with pytest.raises(TypeError, match="was not called"):
        len(kte.Chain.__new__(kte.Chain))


def test_pickled_chains_compute_the_same_bits(iiwa, random):
    q, v, tau = random.standard_normal((3, 7))
    other = pickle.loads(pickle.dumps(iiwa.chain))
    assert (kte.forward_dynamics(other, q, v, tau) == kte.forward_dynamics(iiwa, q, v, tau)).all()


def test_model_files_hold_chains(tmp_path, four_bar):
    for name in ("model.json", "model.xml", "model.kte"):
        kte.save_model(tmp_path / name, four_bar)
        assert kte.load_model(tmp_path / name) == four_bar


def test_threads_share_a_chain(iiwa, random):
    states = random.standard_normal((8, 3, 7))
    expected = [kte.forward_dynamics(iiwa, *s) for s in states]
    found = [None] * 8

    def work(i):
        for _ in range(200):
            found[i] = kte.forward_dynamics(iiwa, *states[i])

    team = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    [t.start() for t in team], [t.join() for t in team]
    assert np.array_equal(found, expected)


def test_suspicious_chains_say_why(four_bar):
    four_bar << kte.inertia_gen("crankk", 0.05)
    assert "did you mean 'crank'?" in four_bar.check()[0]


@pytest.mark.parametrize(
    "what, error, sentence",
    [
        (lambda: kte.Chain(kte.inertia_3D("a", -1)), kte.BadParameter, "mass must be finite and not negative, got -1"),
        (lambda: kte.Chain(kte.inertia_3D("a", 1, inertia=[1, 1, 3])), kte.BadParameter, "must be physical"),
        (lambda: kte.Chain(kte.revolute_joint_3D("q", "a", "b", [1, 1, 0])), kte.BadParameter, "axis"),
        (lambda: kte.Chain(kte.inertia_3D("a", 1), kte.inertia_2D("a", 1)), kte.BadWiring, "3D frame"),
        (lambda: kte.Chain(3), TypeError, "made of elements and chains, not of 3"),
        (lambda: kte.Chain(gravity=[1]), kte.BadArgument, "gravity has 1 numbers"),
        (lambda: kte.load_model("nowhere.json"), kte.MissingFile, "cannot open 'nowhere.json'"),
        (lambda: kte.load_robot("nowhere.urdf"), FileNotFoundError, "cannot open 'nowhere.urdf'"),
    ],
)
def test_what_is_refused(what, error, sentence):
    with pytest.raises(error, match=sentence) as caught:
        what()
    assert str(caught.value).startswith("kte: ")
    assert isinstance(caught.value, kte.Error) or error is TypeError


def test_classes_of_errors_are_those_of_python():
    assert issubclass(kte.BadArgument, ValueError) and issubclass(kte.UnknownName, LookupError)
    assert issubclass(kte.SingularMassMatrix, ArithmeticError) and issubclass(kte.IntegrationFailure, RuntimeError)


def test_no_chain_changes_while_another_thread_computes(iiwa, random):
    chain, q = iiwa.chain, random.standard_normal((100_000, 7))
    refused = []

    def change():
        while worker.is_alive():
            try:
                chain << kte.inertia_3D("tool", 0.0)
            except kte.BadArgument as e:
                refused.append(str(e))

    worker = threading.Thread(target=lambda: kte.coriolis_matrix(chain, q, q))
    worker.start(), change(), worker.join()
    assert "cannot be changed while another thread" in refused[0]


def test_a_misspelt_frame_that_became_a_base_is_found():
    chain = kte.Chain(kte.base_2D("ground"), kte.revolute_joint_2D("q", "ground", "tip"), kte.inertia_2D("tip", 1))
    assert chain.check() == []
    chain << kte.spring_2D("ground", "tipp", 0.1, 10.0)
    (found,) = chain.check()
    assert "reads 'tipp', which no element writes or declares" in found and "did you mean 'tip'?" in found


def test_parameters_are_read_and_replaced(pendulum):
    all = pendulum.parameters()
    assert all["tip/mass"] == 1 and all["gravity/y"] == -9.81 and all["tip/position/x"] == 0.5, all
    heavy = pendulum.with_parameters({"tip/mass": 3, "gravity/y": -1.62})
    assert heavy.parameters()["tip/mass"] == 3 and pendulum.parameters() == all
    np.testing.assert_allclose(kte.gravity_forces(heavy, [0.0]), kte.gravity_forces(pendulum, [0.0]) * 3 * 1.62 / 9.81)
    assert pendulum.with_parameters(all) == pendulum and pendulum.with_parameters({}) == pendulum
    with pytest.raises(kte.BadParameter, match="mass"):
        pendulum.with_parameters({"tip/mass": -1})
    with pytest.raises(kte.UnknownName, match="no parameter 'tip/weight'"):
        pendulum.with_parameters({"tip/weight": 1})
    with pytest.raises(TypeError, match="tip/mass must be a number, not 'heavy'"):
        pendulum.with_parameters({"tip/mass": "heavy"})
    with pytest.raises(TypeError, match="values must be a dict"):
        pendulum.with_parameters([1.0])


def test_every_parameter_of_a_robot_can_be_set(iiwa):
    all = iiwa.chain.parameters()
    assert len(all) > 100 and iiwa.chain.with_parameters(all) == iiwa.chain
    for path in list(all)[::17]:
        assert iiwa.chain.with_parameters({path: all[path]}) == iiwa.chain


def test_paths_are_of_one_element_only():
    chain = kte.Chain(
        kte.base_2D("wall"),
        kte.revolute_joint_2D("q", "base", "end"),
        kte.inertia_2D("end", 1),
        kte.spring_2D("base", "end", 0, 10.0),
        kte.spring_2D("base", "end", 0, 20.0),
        kte.spring_2D("wall", "end", 0, 30.0),
    )
    stiffness = {path: value for path, value in chain.parameters().items() if path.endswith("stiffness")}
    assert stiffness == {"wall/stiffness": 30.0}


def test_joints_are_locked(iiwa):
    q = np.linspace(-0.5, 0.5, 7)
    locked = kte.reduced(iiwa, q, iiwa.chain.coordinates[2:4])
    assert locked.nv == 5 and locked.coordinates == iiwa.chain.coordinates[:2] + iiwa.chain.coordinates[4:]
    np.testing.assert_allclose(
        kte.forward_kinematics(locked, np.delete(q, [2, 3]), "tool").position, kte.forward_kinematics(iiwa, q, "tool").position, atol=1e-15
    )
    with pytest.raises(kte.UnknownName, match="wrist"):
        kte.reduced(iiwa, q, "wrist")
