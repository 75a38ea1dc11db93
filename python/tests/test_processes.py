"""Chains, states and runs in other processes: pickles, pools, and what workers raise."""
import copy
import multiprocessing
import os
import pickle
import signal
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import kte

DUPLICATES = [copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))]
WAYS = ["spawn", "fork", "forkserver"]


def accelerations(arguments):
    chain, states = arguments
    return kte.forward_dynamics(chain, states, states, states, threads=2)


def position(state):
    state.do_motion()
    return state.frame("tip").position


def swing(chain):
    return kte.simulate(chain, [0.1], time=0.2, every=0.1)


def refused(text):
    raise kte.IntegrationFailure(text)


def square(case):
    if case["x"] == 2 and case["die"]:
        os.kill(os.getpid(), signal.SIGKILL)
    return case["x"] ** 2


@pytest.mark.parametrize("duplicate", DUPLICATES)
def test_states_are_copied_and_pickled_with_their_inputs_and_passes(duplicate):
    chain = kte.Chain(
        kte.revolute_joint_2D("q", "base", "joint"),
        kte.driving_actuator_gen("q", "motor"),
        kte.rigid_link_2D("joint", "tip", [0.5, 0]),
        kte.inertia_2D("tip", mass=1),
        gravity=[0, -9.81, 0],
    )
    for passes in range(3):
        state = kte.State(chain, [0.3], [0.2], [0.1], inputs={"motor": 2.0})
        if passes > 0:
            state.do_motion()
        if passes > 1:
            state.do_force()
        other = duplicate(state)
        assert (other.q, other.v, other.a) == (state.q, state.v, state.a)
        if passes == 0:
            with pytest.raises(kte.BadArgument, match="do_motion"):
                other.frame("tip")
        else:
            assert (other.frame("tip").acceleration == state.frame("tip").acceleration).all()
            assert np.isnan(other.frame("tip").force).any() == (passes == 1)
        other.do_motion(), other.do_force(), state.do_motion(), state.do_force()
        assert other.f == state.f and state.f != 0
        other.q = [1.0]
        assert state.q == [0.3]


class Named(kte.State):
    pass


def test_states_of_derived_classes_keep_their_attributes(pendulum):
    state = Named(pendulum, [0.3])
    state.name = "start"
    for duplicate in DUPLICATES:
        other = duplicate(state)
        assert type(other) is Named and other.name == "start" and other.q == [0.3]


@pytest.mark.parametrize("duplicate", DUPLICATES)
def test_motions_are_copied_and_pickled(iiwa, duplicate):
    limits = iiwa.limits._replace(acceleration=np.full(7, 10.0), jerk=np.full(7, 100.0))
    for motion in (
        kte.trapezoidal_motion(iiwa, np.zeros(7), np.full(7, 0.5), limits=limits),
        kte.quintic_motion(iiwa.chain, np.zeros(7), np.full(7, 0.5), 2.5, limits=limits),
    ):
        other = duplicate(motion)
        assert other.duration == motion.duration
        assert all((a == b).all() for a, b in zip(other([0.1, 0.2]), motion([0.1, 0.2])))


def test_simulations_say_why_they_are_not_copied(pendulum):
    for duplicate in DUPLICATES:
        with pytest.raises(TypeError, match="a Simulation, which is between steps of its solver, can be neither copied nor pickled"):
            duplicate(kte.Simulation(pendulum, [0.1]))


@pytest.mark.parametrize("way", WAYS)
def test_processes_compute_what_this_one_does(iiwa, pendulum, way):
    states = np.linspace(-1, 1, 14000).reshape(2000, 7)
    here = accelerations((iiwa, states))  # in threads, before the fork
    with multiprocessing.get_context(way).Pool(2) as pool:
        for there in pool.map(accelerations, [(iiwa, states), (iiwa.chain, states)]):
            assert (there == here).all()
        assert (pool.map(position, [kte.State(pendulum, [0.3])])[0] == position(kte.State(pendulum, [0.3]))).all()
        assert (pool.map(swing, [pendulum])[0].q == swing(pendulum).q).all()
        with pytest.raises(kte.IntegrationFailure, match="no step"):
            pool.map(refused, ["no step"])


@pytest.mark.parametrize("way", WAYS)
def test_sweeps_by_processes(iiwa, way):
    cases = kte.one_of("x", [1.0, 2.0, 3.0])
    context = multiprocessing.get_context(way)
    with ProcessPoolExecutor(2, mp_context=context) as processes:
        table = kte.sweep(cases * kte.one_of("die", [0.0]), square, "y", client=processes)
        assert table["y"].tolist() == [1, 4, 9]
        run = kte.SimulationRun(iiwa, [0.1] * 7, time=0.1)
        q = kte.evenly("q/q1", 0, 1, 20)
        assert (kte.sweep(q, run, "q1", client=processes)["q1"] == kte.sweep(q, run, "q1")["q1"]).all()
        with pytest.raises(kte.Error, match="were not computed: BrokenProcessPool"):
            kte.sweep(cases * kte.one_of("die", [1.0]), square, "y", client=processes)


def test_a_pool_that_breaks_while_cases_are_submitted_is_named():
    class Breaks(ProcessPoolExecutor):
        def submit(self, *arguments, **options):
            raise RuntimeError("the pool is broken")

    with Breaks(1) as processes, pytest.raises(kte.Error, match="the cases from 0 to 0 were not computed: RuntimeError: the pool is broken"):
        kte.sweep(kte.one_of("x", [1.0, 2.0]) * kte.one_of("die", [0.0]), square, "y", client=processes)
