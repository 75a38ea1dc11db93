"""Sweeps: cases, functions, simulations and operations, files, and workers elsewhere."""
import os
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import kte

DATA = Path(__file__).resolve().parents[2] / "tests" / "data" / "sweep_cases.csv"


def distributions():
    return [kte.uniform("u", -1, 3), kte.log_uniform("l", 0.1, 10), kte.normal("n", 5, 2)]


def product(c):
    if c.index % 40 == 7:
        raise kte.BadArgument("kte: not this one")
    return [c["x"] * c["y"], np.nan if c.index == 5 else c["x"] - c["y"]]


CASES = kte.random_cases(50, 1, [kte.uniform("x", 0, 1)]) * kte.one_of("y", [1, 2])


@pytest.mark.parametrize("client", [None, ThreadPoolExecutor(2)], ids=["here", "executor"])
def test_a_file_has_the_bytes_of_the_same_sweep_in_cpp(tmp_path, client):
    """tests/sweep/python_test.cpp compares C++ with the same file."""
    cases = kte.random_cases(8, 7, [kte.uniform("u", -1, 3)]) * kte.sobol_cases(4, [kte.uniform("s", 0, 1), kte.uniform("t", 1, 9)])
    keep = ["sum", "product"]
    summary = kte.sweep(cases, lambda c: [c["u"] + c["s"], c["s"] * c["t"]], keep, to=tmp_path / "x.csv", client=client)
    assert summary.cases == 32 and summary.failed == 0 and list(summary.statistics) == keep
    assert (tmp_path / "x.csv").read_bytes() == DATA.read_bytes()
    assert not (tmp_path / "x.csv.parts").exists()


def test_cases_are_dicts_arrays_and_pickles():
    cases = kte.evenly("a", 0, 1, 3) * kte.one_of("b", np.float32([1, 2]))
    assert len(cases) == 6 and cases.names == ["a", "b"] and cases[-1] == {"a": 1.0, "b": 2.0}
    assert cases.values(1, 3).tolist() == [[0, 2], [0.5, 1]]
    for c in (cases, CASES, kte.sobol_cases(4, distributions()), kte.list_of_cases(["p", "q"], np.eye(2))):
        copy = pickle.loads(pickle.dumps(c))
        assert copy.names == c.names and np.array_equal(copy.values(), c.values()) and repr(copy) == repr(c)
    assert np.array_equal(cases[4:0:-2].values(), cases.values()[4:0:-2]) and cases[:2].names == ["a", "b"] and len(cases[6:]) == 0
    with pytest.raises(IndexError, match="6 cases"):
        cases[6]
    with pytest.raises(kte.BadArgument, match=r"values has shape \(2, 3\), expected \(cases, 2\)"):
        kte.list_of_cases(["p", "q"], np.zeros((2, 3)))
    with pytest.raises(kte.BadArgument, match="distribution of 'x': mean and deviation"):
        kte.normal("x", 0, -1)
    for make in (lambda: kte.evenly("x", 0, 1, -1), lambda: kte.random_cases(1, -1, kte.uniform("x", 0, 1))):
        with pytest.raises(kte.BadArgument, match="(n|seed) must be from 0 to 2.64 - 1, got -1"):
            make()
    with pytest.raises(TypeError, match="columns must be distributions, .* not 'x'"):
        kte.sobol_cases(4, ["x"])
    with pytest.raises(TypeError, match="'float' object"):
        kte.evenly("x", 0, 1, 2.5)
    with pytest.raises(kte.BadArgument, match=r"columns of shapes \(2,\), \(3,\), expected \(cases,\)"):
        kte.sweep({"a": [1, 2], "b": [1, 2, 3]}, lambda c: 1, "k")


@pytest.mark.parametrize("threads", [1, 3])
def test_a_function_has_a_row_for_each_case_in_order(threads):
    table = kte.sweep(CASES, product, ["p", "d"], threads=threads, shard_size=7)
    x, y = CASES.values().T
    failing = [5, 7, 47, 87]
    assert list(table) == ["case", "x", "y", "p", "d", "failed"]
    assert np.array_equal(table["case"], np.arange(100)) and np.array_equal(np.flatnonzero(table["failed"]), failing)
    good = ~table["failed"]
    assert np.array_equal(table["p"][good], (x * y)[good]) and table["p"][5] == x[5] * y[5] and np.isnan(table["p"][7])
    assert [f.case for f in table.failures] == failing
    assert table.failures[:2] == [(5, "'d' is not a number"), (7, "kte: not this one")]
    assert table.statistics["p"].cases == 97 and table.summary.failed == 4
    with pytest.raises(kte.UnknownName, match="no column 'q', but case, x"):
        table["q"]


def test_results_of_functions_and_their_errors():
    cases = {"a": [1, 2, 3], "b": np.arange(3)}
    assert kte.sweep(cases, lambda c: c["a"] + c["b"], "sum")["sum"].tolist() == [1, 3, 5]
    assert kte.sweep(cases, lambda c: {"b": 0, "k": c["a"]}, "k")["k"].tolist() == [1, 2, 3]
    assert kte.sweep(cases, lambda c: {"a": 2 * c["a"]}, {"twice": "a"})["twice"].tolist() == [2, 4, 6]
    for f, reason in [
        (lambda c: [1, 2], "2 numbers for 1 columns"),
        (lambda c: "one", "TypeError: kte: the function of the sweep must return numbers, not 'one'"),
        (lambda c: None, "must return numbers, not None"),
        (lambda c: {"x": 1}, "kte: the function of the sweep gave no 'k', but x"),
        (lambda c: c["z"], "kte: the cases have no column 'z'"),
        (lambda c: 1 / 0, "ZeroDivisionError: division by zero"),
    ]:
        table = kte.sweep(cases, f, "k")
        assert len(table.failures) == 3 and reason in table.failures[0].reason
    with pytest.raises(kte.BadArgument, match="keep must name"):
        kte.sweep(cases, lambda c: 1)
    with pytest.raises(kte.BadArgument, match=r"have a column 'a': keep the result as keep=\{'NAME': 'a'\}"):
        kte.sweep(cases, lambda c: 1, "a")
    with pytest.raises(TypeError, match="cases must be"):
        kte.sweep([1, 2], lambda c: 1, "k")
    with pytest.raises(KeyboardInterrupt):
        kte.sweep(cases, lambda c: (_ for _ in ()).throw(KeyboardInterrupt), "k")


def test_pandas_in_and_out():
    pandas = pytest.importorskip("pandas")
    table = kte.sweep(pandas.DataFrame({"a": [1.0, 2.0]}), lambda c: 2 * c["a"], "double").to_pandas()
    assert table.columns.tolist() == ["a", "double", "failed"] and table["double"].tolist() == [2, 4]


def swinging(pendulum, length, mass, speed):
    chain = kte.Chain(*pendulum.elements[:1], kte.rigid_link_2D("joint", "tip", [length, 0]), gravity=[0, -9.81])
    return kte.simulate(chain << kte.inertia_2D("tip", mass=mass), [0.1], [speed], time=1)


def test_simulations_are_those_of_simulate(pendulum):
    cases = kte.sobol_cases(
        20, [kte.uniform("tip/position/x", 0.5, 1), kte.uniform("tip/mass", 1, 2), kte.normal("v/q", 0, 1)]
    )
    keep = {"q": "q", "tip": "frame:tip/position", "high": "max:tip/position/y", "mean": "mean:q/v", "steps": "run/steps"}
    run = kte.SimulationRun(pendulum, [0.1], time=1)
    one, two = (kte.sweep(cases, run, keep, threads=n) for n in (1, 2))
    assert not one["failed"].any()
    for name in one:
        assert np.array_equal(one[name], two[name])
    for i in (0, 7, 19):
        motion = swinging(pendulum, *cases.values()[i])
        assert one["q"][i] == motion["q"][-1] and one["tip/y"][i] == motion["tip/position/y"][-1]
        assert one["high"][i] == motion["tip/position/y"].max() and one["steps"][i] == motion.statistics["steps"]
        speeds = motion["q/v"]
        assert np.isclose(one["mean"][i], ((speeds[1:] + speeds[:-1]) / 2 * np.diff(motion.t)).sum(), rtol=1e-13)


def test_simulations_with_forces_inputs_and_other_failures():
    chain = kte.Chain(kte.revolute_joint_3D("q", "a", "b", axis=[0, 0, 1]), kte.inertia_3D("b", 1, inertia=[5, 5, 1]))
    chain << kte.driving_actuator_gen("q", "motor")
    cases = kte.one_of("tau/q", [0, 1]) * kte.one_of("motor", [2, 3]) * kte.one_of("b/inertia/zz", [1, 4, -1])
    table = kte.sweep(cases, kte.SimulationRun(chain, [0.0], time=2, control=[0.0], every=0.5), ["q", "min:q/v", "run/end_time"])
    good = ~table["failed"]
    force, inertia = table["tau/q"] + table["motor"], table["b/inertia/zz"]
    assert np.allclose(table["q"][good], (2 * force / inertia)[good], rtol=1e-8) and (table["min:q/v"][good] == 0).all()
    assert (table["run/end_time"][good] == 2).all() and np.array_equal(~good, inertia == -1)
    assert "inertia" in table.failures[0].reason
    for column, error in [("b/weight", "no parameter 'b/weight'.*; columns may also be q/NAME"), ("v/p", "no parameter")]:
        with pytest.raises(kte.UnknownName, match=error):
            kte.sweep(kte.one_of(column, [1]), kte.SimulationRun(chain, [0.0], time=1))
    with pytest.raises(kte.BadArgument, match="no solver 'rk4', but dormand_prince45"):
        kte.sweep(kte.one_of("motor", [1]), kte.SimulationRun(chain, [0.0], time=1, solver="rk4"))
    with pytest.raises(TypeError, match="needs its time"):
        kte.SimulationRun(chain, [0.0])
    with pytest.raises(kte.BadArgument, match=r"q has shape \(2,\), expected \(1,\)"):
        kte.sweep(kte.one_of("motor", [1]), kte.SimulationRun(chain, [0.0, 1.0], time=1))


def test_operations_are_those_of_the_chain(iiwa, random):
    q, v, tau = random.normal(size=(3, 7))
    cases = kte.evenly("q/q3", -1, 1, 5) * kte.evenly("link7/mass", 1, 2, 3)
    assert pickle.loads(pickle.dumps(kte.OperationRun("energy", iiwa, [0.0] * 7))).chain == iiwa.chain
    table = kte.sweep(cases, kte.OperationRun("forward_dynamics", iiwa, q, v, tau=tau))
    assert list(table)[3:-1] == [f"a/q{i}" for i in range(1, 8)]
    matrix = kte.sweep(cases, kte.OperationRun("mass_matrix", iiwa, q), "M/q1/q3")["M/q1/q3"]
    work = kte.sweep(cases, kte.OperationRun("energy", iiwa, q, v))["kinetic"]
    passes = kte.sweep(cases, kte.OperationRun("passes", iiwa, q, v, a=tau), ["q2/f", "tool/position"])
    for i in (0, 7, 14):
        c = cases[i]
        q[2] = c["q/q3"]
        varied = kte.Chain(gravity=iiwa.chain.gravity)
        for e in iiwa.chain.elements:
            if e.type == "inertia_3D" and e.ports["frame"] == "link7":
                e.parameters["mass"] = [c["link7/mass"]]
            varied << e
        assert [table[f"a/q{k}"][i] for k in range(1, 8)] == kte.forward_dynamics(varied, q, v, tau).tolist()
        assert matrix[i] == kte.mass_matrix(varied, q)[0, 2] and work[i] == kte.energy(varied, q, v).kinetic
        height = kte.forward_kinematics(varied, q, "tool").position[2]
        assert np.isclose(passes["tool/position/z"][i], height, rtol=1e-13)
        assert np.isclose(passes["q2/f"][i], -kte.inverse_dynamics(varied, q, v, tau)[1], rtol=1e-12)
    with pytest.raises(kte.UnknownName, match="no result 'b', but 'a/q1'"):
        kte.sweep(cases, kte.OperationRun("forward_dynamics", iiwa, q), "b")
    with pytest.raises(kte.BadArgument, match="no operation 'jacobian', but inverse_dynamics"):
        kte.sweep(cases, kte.OperationRun("jacobian", iiwa, q))
    with pytest.raises(kte.BadArgument, match="mass_matrix has no argument 'tau'"):
        kte.sweep(cases, kte.OperationRun("mass_matrix", iiwa, q, tau=tau))


@pytest.mark.parametrize("how", [dict(tolerance=1e-10), dict(solver="runge_kutta4", step=2e-3)], ids=["adaptive", "fixed"])
def test_simulations_in_packs_are_those_one_by_one(pendulum, how):
    cases = kte.random_cases(43, 3, [kte.uniform("tip/mass", 1, 2), kte.uniform("q/q", -1, 1), kte.uniform("tau/q", -1, 1)])
    run = kte.SimulationRun(pendulum, [0.0], time=1.5, control=[0.0], **how)
    keep = {"q": "q", "v": "q/v", "tip": "frame:tip/position", "end": "run/end_time", "events": "run/events"}
    together = kte.sweep(cases, run, keep)
    alone = kte.sweep(cases, run, keep, packs=False)
    for again in (kte.sweep(cases, run, keep, shard_size=3), kte.sweep(cases, run, keep, shard_size=1, threads=2)):
        for name in together:
            assert np.array_equal(together[name], again[name])
    for name in together:
        np.testing.assert_allclose(together[name], alone[name], rtol=0, atol=1e-12 if "step" in how else 1e-8)
    assert not np.array_equal(together["v"], alone["v"])  # they are packs
    default = kte.sweep(cases, run)
    assert list(default)[4:6] == ["q", "q/v"] and np.array_equal(default["q/v"], together["v"])


def test_cases_that_fail_in_packs_have_the_reasons_of_single_ones(pendulum):
    cases = kte.one_of("tip/mass", [1, -1, 2]) * kte.evenly("q/q", 0, 1, 9)
    run = kte.SimulationRun(pendulum, [0.0], time=1)
    together, alone = kte.sweep(cases, run), kte.sweep(cases, run, packs=False)
    assert together.failures == alone.failures and len(together.failures) == 9
    short = kte.SimulationRun(pendulum, [0.0], time=1, max_steps=3)
    assert kte.sweep(cases, short).failures == kte.sweep(cases, short, packs=False).failures


def test_simulations_with_events_rows_or_rotations_are_computed_one_by_one(pendulum):
    stopped = kte.Chain(pendulum, kte.joint_limit_gen("q", lower=-0.5, upper=0.5, stiffness=1e3))
    body = kte.Chain(kte.free_joint_3D("pose", "world", "body"), kte.inertia_3D("body", 1, inertia=[1, 2, 3]))
    for run, column, keep in [
        (kte.SimulationRun(stopped, [0.0], time=1), "tip/mass", "q"),
        (kte.SimulationRun(pendulum, [0.0], time=1), "tip/mass", "max:q"),
        (kte.SimulationRun(pendulum, [0.0], time=1, solver="adams"), "tip/mass", "q"),
        (kte.SimulationRun(body, kte.neutral_configuration(body), time=1), "v/pose/5", "pose/rotation"),
    ]:
        cases = kte.evenly(column, 1, 2, 5)
        together, alone = kte.sweep(cases, run, keep), kte.sweep(cases, run, keep, packs=False)
        for name in together:
            assert np.array_equal(together[name], alone[name])


@pytest.mark.parametrize("operation, keep", [("forward_dynamics", "a/q3"), ("inverse_dynamics", "tau/q3"), ("mass_matrix", "M/q1/q3")])
def test_operations_in_packs_are_those_one_by_one(iiwa, random, operation, keep):
    q, v = random.normal(size=(2, 7))
    cases = kte.random_cases(21, 3, [kte.uniform("q/q3", -1, 1)])
    run = kte.OperationRun(operation, iiwa, q, v)
    together, alone = kte.sweep(cases, run, keep)[keep], kte.sweep(cases, run, keep, packs=False)[keep]
    np.testing.assert_allclose(together, alone, rtol=1e-12, atol=1e-12)
    assert np.array_equal(together, kte.sweep(cases, run, keep, shard_size=5)[keep])
    assert not np.array_equal(together, alone)
    odd = kte.list_of_cases(["q/q3"], [[0.1], [np.inf], [0.3]])
    assert [f.case for f in kte.sweep(odd, run, keep).failures] == [1]
    assert kte.sweep(odd, run, keep).failures == kte.sweep(odd, run, keep, packs=False).failures


@pytest.mark.parametrize("extension", ["csv", "npy", "mcap"])
def test_an_interrupted_sweep_continues(tmp_path, extension):
    path, whole = tmp_path / f"run.{extension}", tmp_path / f"whole.{extension}"
    kte.sweep(CASES, product, ["p", "d"], to=whole, shard_size=10)
    seen = []

    def until_60(c):
        if c.index == 60:
            raise KeyboardInterrupt
        seen.append(c.index)
        return product(c)

    with pytest.raises(KeyboardInterrupt):
        kte.sweep(CASES, until_60, ["p", "d"], to=path, shard_size=10)
    assert Path(f"{path}.parts").is_dir() and not path.exists()
    seen.clear()
    reports = []
    summary = kte.sweep(CASES, lambda c: seen.append(c.index) or product(c), ["p", "d"], to=path, shard_size=10, progress=reports.append)
    assert min(seen) >= 60 and summary.failed == 4 and path.read_bytes() == whole.read_bytes()
    assert Path(f"{path}.failures.csv").read_bytes() == Path(f"{whole}.failures.csv").read_bytes()
    assert reports[-1].done == reports[-1].total == 100 and reports[-1].found >= 60
    if extension == "npy":
        assert np.load(path)["x"].tolist() == CASES.values()[:, 0].tolist()
    if extension == "csv":
        with pytest.raises(kte.BadArgument, match="unknown|format|extension"):
            kte.sweep(CASES, product, ["p", "d"], to=tmp_path / "run.xyz")


def test_an_interrupted_sweep_of_another_run_is_refused_with_what_differs(tmp_path, pendulum):
    path = tmp_path / "run.csv"
    cases = kte.evenly("q/q", 0, 1, 40)

    def sweep(run, keep=("q", "q/v"), **options):
        return kte.sweep(cases, run, keep, to=path, shard_size=10, threads=1, **options)

    def interrupted(progress):
        raise KeyboardInterrupt

    def run_of(chain=pendulum, **options):
        return kte.SimulationRun(chain, [0.0], **{"time": 0.5, "control": [0.25], **options})

    with pytest.raises(KeyboardInterrupt):
        sweep(run_of(), progress=interrupted)
    parts = Path(f"{path}.parts")
    assert list(parts.glob("*.shard"))
    heavier = kte.Chain(*pendulum.elements[:2], kte.inertia_2D("tip", mass=2), gravity=[0, -9.81])
    for run, keep, options, what in [
        (run_of(heavier), ("q", "q/v"), {}, "another value of chain"),
        (run_of(time=0.75), ("q", "q/v"), {}, r"time is '0\.75', not '0\.5'"),
        (run_of(control=[0.5]), ("q", "q/v"), {}, r"control is '\[0\.5\]', not '\[0\.25\]'"),
        (run_of(solver="runge_kutta4"), ("q", "q/v"), {}, "solver is 'runge_kutta4', not 'dormand_prince45'"),
        (run_of(), {"q": "q", "q/v": "q/a"}, {}, "kept quantities is 'q, q/a', not 'q, q/v'"),
        (run_of(), ("q", "q/v"), {"packs": False}, "packs is 'False', not 'True'"),
        (run_of(), ("q", "q/v"), {"note": "2"}, "note is '2', not ''"),
        (kte.OperationRun("passes", pendulum, [0.0]), ("q", "q/v"), {}, "run is 'OperationRun', not 'SimulationRun'"),
    ]:
        with pytest.raises(kte.BadArgument, match=rf"run.csv.parts' has shards of another sweep \(.*{what}.*: remove this folder"):
            sweep(run, keep, **options)
    same = kte.Chain(*pendulum.elements, gravity=[0, -9.81])
    assert sweep(run_of(same, time=np.float64(0.5), control=np.array([0.25]))).failed == 0 and not parts.exists()


def test_ctrl_c_stops_simulations(tmp_path):
    code = f"""
import os, signal, threading, kte
signal.signal(signal.SIGINT, signal.default_int_handler)  # jobs in the background of a shell ignore it
chain = kte.Chain(kte.revolute_joint_2D("q", "a", "b"), kte.inertia_2D("b", 1, com=[1, 0]), gravity=[0, -9.81])
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    kte.sweep(kte.evenly("q/q", 0, 1, 4), kte.SimulationRun(chain, [0.0], time=1e6), to={str(tmp_path / "x.csv")!r})
except KeyboardInterrupt:
    print("stopped")
"""
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert out.stdout == "stopped\n", out.stderr


def dies_once(folder, c):
    """Kills the process that computes case 60, the first time."""
    mark = Path(folder) / "died"
    if c.index == 60 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), 9)
    return product(c)


def test_dask_gives_the_numbers_of_threads_also_if_a_worker_is_killed(tmp_path, pendulum):
    distributed = pytest.importorskip("distributed")
    import functools

    cases = kte.random_cases(40, 3, [kte.uniform("tip/mass", 1, 2), kte.uniform("q/q", -1, 1)])
    run = kte.SimulationRun(pendulum, [0.0], time=0.5)
    here = kte.sweep(cases, run, threads=2, shard_size=8), kte.sweep(CASES, product, ["p", "d"])
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster:
        with distributed.Client(cluster) as client:
            there = (
                kte.sweep(cases, run, shard_size=8, client=client),
                kte.sweep(CASES, functools.partial(dies_once, tmp_path), ["p", "d"], shard_size=10, client=client),
            )
    assert (tmp_path / "died").exists()
    for a, b in zip(here, there):
        assert list(a) == list(b) and a.failures == b.failures
        for name in a:
            assert np.array_equal(a[name], b[name], equal_nan=a[name].dtype == float)


def test_a_shard_without_results_is_an_error_and_the_others_are_kept(tmp_path):
    class Broken(ThreadPoolExecutor):
        def submit(self, f, columns, kept, run, begin, values):
            if begin == 20:
                f = {}.__getitem__
                return super().submit(f, "no worker")
            return super().submit(f, columns, kept, run, begin, values)

    path = tmp_path / "x.csv"
    with pytest.raises(kte.Error, match="cases from 20 to 29 were not computed: KeyError"):
        kte.sweep(CASES, product, ["p", "d"], to=path, shard_size=10, client=Broken(2))
    assert len(list(Path(f"{path}.parts").glob("*.shard"))) == 9
    with pytest.raises(TypeError, match="client must be a client of Dask"):
        kte.sweep(CASES, product, ["p", "d"], client="tcp://host")
