"""Sweeps: a simulation, an operation or a function on many cases, in threads and on several machines."""
from __future__ import annotations

import functools
import hashlib
import importlib
import math
import operator
import os
import sys
from concurrent.futures import FIRST_COMPLETED, Executor, wait
from dataclasses import dataclass, fields
from itertools import islice
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _kte
from ._kte import Cases, Chain, Robot
from ._results import Array, ColumnStatistics, SweepFailure, SweepProgress, SweepSummary
from .errors import BadArgument, Error, UnknownName

__all__ = ["Case", "OperationRun", "SimulationRun", "SweepTable", "sweep"]

#: What a function of a sweep returns: the kept numbers, or a dict that has them; Any, since components of arrays are.
Kept = Any

_AHEAD = 64  # shards that workers have at a time
_A_PACK = 8  # cases in a pack, at most


def _remade(function: str, arguments: Tuple[Any, ...]) -> Any:
    return getattr(_kte, function)(*arguments)


class Case(Dict[str, float]):
    """A case of a sweep: a dict of the values of its columns, and `index`, its number."""

    def __init__(self, values: Mapping[str, float], index: int) -> None:
        super().__init__(values)
        self.index = index

    def __missing__(self, name: str) -> float:
        raise UnknownName(f"kte: the cases have no column {name!r}")


def _keep_chain(run: Any) -> None:
    """Replaces a robot by its chain, which has a pickle."""
    object.__setattr__(run, "chain", getattr(run.chain, "chain", run.chain))


@dataclass(frozen=True, eq=False)
class SimulationRun:
    """A simulation for `sweep`: of each case, from `t` for a time, s. Arguments are those of `Simulation`.

    `control` is an array, `inputs` are numbers: for functions of the state, sweep a function that calls `simulate`.
    `every` is the spacing of the rows, s, whose minima, maxima and means are taken.
    """

    chain: Union[Chain, Robot]
    q: ArrayLike
    v: Optional[ArrayLike] = None
    time: float = math.nan
    every: float = 0.01
    control: Optional[ArrayLike] = None
    inputs: Optional[Mapping[str, ArrayLike]] = None
    t: float = 0.0
    solver: str = "dormand_prince45"
    tolerance: float = 1e-9
    absolute: Optional[float] = None
    relative: Optional[float] = None
    step: float = 1e-3
    max_steps: int = 1_000_000_000
    largest_step: float = 0.0

    def __post_init__(self) -> None:
        if math.isnan(self.time):
            raise TypeError("kte: a SimulationRun needs its time, as time=10")
        for name, law in (("control", self.control), *(self.inputs or {}).items()):
            if callable(law):
                raise TypeError(
                    f"kte: {name} of a SimulationRun must be numbers; for a function of (t, q, v), sweep a function of a "
                    "case that calls kte.simulate"
                )
        _keep_chain(self)


@dataclass(frozen=True, eq=False)
class OperationRun:
    """An operation for `sweep`: inverse_dynamics, forward_dynamics, mass_matrix, gravity_forces, static_forces,
    nonlinear_effects, energy, centre_of_mass; or passes, which compute quantities of all frames and coordinates.
    """

    operation: str
    chain: Union[Chain, Robot]
    q: ArrayLike
    v: Optional[ArrayLike] = None
    a: Optional[ArrayLike] = None
    tau: Optional[ArrayLike] = None
    inputs: Optional[Mapping[str, ArrayLike]] = None

    def __post_init__(self) -> None:
        _keep_chain(self)


class SweepTable(Dict[str, Any]):
    """The results of a sweep: a dict of arrays with a number for each case.

    Columns are `case`, the number of the case, those of the cases, the kept ones, and `failed`.
    """

    def __init__(self, columns: Mapping[str, Any], failures: List[SweepFailure], summary: SweepSummary) -> None:
        super().__init__(columns)
        #: cases without a result, and why: `SweepFailure(case, reason)`
        self.failures = failures
        #: counts and statistics
        self.summary = summary

    @property
    def statistics(self) -> Dict[str, ColumnStatistics]:
        """Statistics of the kept columns: cases, least, most, mean, deviation."""
        return self.summary.statistics

    def to_pandas(self) -> Any:
        """The table as a pandas DataFrame, with the number of the case as index."""
        return importlib.import_module("pandas").DataFrame({name: x for name, x in self.items() if name != "case"}, index=self["case"])

    def __missing__(self, name: str) -> Any:
        raise UnknownName(f"kte: the sweep has no column {name!r}, but {', '.join(self)}")

    def __repr__(self) -> str:
        return f"<kte.SweepTable: {self.summary.cases} cases, {self.summary.failed} failed; columns {', '.join(self)}>"


#: Names of kept numbers, or a dict from names to quantities.
Keep = Union[None, str, Iterable[str], Mapping[str, str]]
Run = Union[SimulationRun, OperationRun, Callable[[Case], Kept]]


def _print_progress(p: SweepProgress) -> None:
    text = f"{p.done} of {p.total} cases, {p.failed} failed, {p.rate:.4g} per s, {p.left:.0f} s left"
    print(f"\r{text}   ", end="\n" if p.done == p.total else "", file=sys.stderr, flush=True)


class _Evaluation:
    """Calls a function of a sweep, and makes a list of what it returns."""

    def __init__(self, function: Callable[[Case], Kept], columns: Sequence[str], keep: Sequence[str]) -> None:
        self.function, self.columns, self.keep = function, columns, keep

    def __call__(self, index: int, values: Sequence[float]) -> List[float]:
        kept = self.function(Case(dict(zip(self.columns, values)), index))
        if isinstance(kept, Mapping):
            absent = [name for name in self.keep if name not in kept]
            if absent:
                raise UnknownName(f"kte: the function of the sweep gave no {absent[0]!r}, but {', '.join(kept)}")
            kept = [kept[name] for name in self.keep]
        _kte._refuse_masked("the result of the function of the sweep", kept)
        try:
            if kept is None:
                raise TypeError
            return np.asarray(kept, dtype=float).ravel().tolist()  # type: ignore[no-any-return]
        except (TypeError, ValueError):
            raise TypeError(f"kte: the function of the sweep must return numbers, not {kept!r}") from None


def _cases(cases: Any) -> Cases:
    if isinstance(cases, Cases):
        return cases
    if hasattr(cases, "columns") and hasattr(cases, "to_numpy"):  # a DataFrame
        return _kte.list_of_cases([str(name) for name in cases.columns], cases.to_numpy(dtype=float))
    if isinstance(cases, Mapping) and cases:
        for name, x in cases.items():
            _kte._refuse_masked(f"column {name!r} of cases", x)
        columns = [np.asarray(x, dtype=float) for x in cases.values()]
        if len({x.shape for x in columns}) > 1 or columns[0].ndim != 1:
            raise BadArgument(f"kte: cases have columns of shapes {', '.join(str(x.shape) for x in columns)}, expected (cases,)")
        return _kte.list_of_cases(list(cases), np.column_stack(columns))
    raise TypeError(f"kte: cases must be Cases, a dict of arrays or a DataFrame, not {cases!r}")


def _kept(run: Any, columns: List[str], named: Mapping[str, str]) -> Tuple[List[str], List[str]]:
    """The names of the kept numbers, and their quantities."""
    if not named:
        every = _kte._kept_names(run, columns, [])
        return every, every
    names: List[str] = []
    quantities: List[str] = []
    for name, quantity in named.items():
        numbers = _kte._kept_names(run, columns, [quantity])
        if name == quantity:
            names += numbers
        elif len(numbers) == 1:
            names.append(name)
        else:
            names += [f"{name}/{x.rsplit('/', 1)[1]}" for x in numbers]
        quantities += numbers
    return names, quantities


def _text_of(x: Any) -> str:
    """An argument of a run as a text, the same for equal numbers."""
    if isinstance(x, Mapping):
        return ", ".join(f"{name}: {_text_of(number)}" for name, number in sorted(x.items()))
    if x is None or isinstance(x, (str, bool)):
        return str(x)
    return np.array2string(np.asarray(x, dtype=float), separator=", ", threshold=sys.maxsize, floatmode="unique").replace("\n", "")


def _dependences(run: Any, quantities: Sequence[str], packs: bool) -> List[Tuple[str, str]]:
    """What the results of a run of the library depend on, by names."""
    texts = [("run", type(run).__name__), ("kept quantities", ", ".join(quantities)), ("packs", str(packs))]
    content, _ = run.chain._pickle()  # without the compiled frames
    texts.append(("chain", hashlib.sha256(content).hexdigest()))
    return texts + [(x.name, _text_of(getattr(run, x.name))) for x in fields(run) if x.name != "chain"]


class _Workers:
    """Those of a client of Dask or of an Executor: `submit` a call, `first` of futures that are done."""

    def __init__(self, client: Any) -> None:
        self.submit: Callable[..., Any]
        self.first: Callable[[Iterable[Any]], Any]
        if isinstance(client, Executor):
            self.submit = client.submit
            self.first = lambda futures: wait(futures, return_when=FIRST_COMPLETED).done
        elif type(client).__module__.partition(".")[0] == "distributed":
            dask = importlib.import_module("distributed")
            self.submit = functools.partial(client.submit, pure=False)
            self.first = lambda futures: dask.wait(list(futures), return_when="FIRST_COMPLETED").done
        else:
            raise TypeError(f"kte: client must be a client of Dask or a concurrent.futures.Executor, not {client!r}")


class _Elsewhere:
    """Shards of a sweep as tasks of workers: ranges of cases, with their values."""

    def __init__(self, workers: _Workers, cases: Cases, kept: Sequence[str], run: Any, shard_size: int) -> None:
        self.workers, self.cases, self.kept, self.run, self.shard_size = workers, cases, kept, run, shard_size
        self.results: Dict[int, Tuple[Array, List[Tuple[int, str]]]] = {}

    def _submit(self, shard: int) -> Any:
        begin = shard * self.shard_size
        values = self.cases.values(begin, min(begin + self.shard_size, len(self.cases)))
        return self.workers.submit(_kte_range, self.cases.names, list(self.kept), self.run, begin, values)

    def completed(self, shards: Sequence[int]) -> Iterator[int]:
        """The places in `shards` of those whose results are there. If one has none, the others are computed first."""
        waiting = iter(enumerate(shards))
        running: Dict[Any, int] = {}
        failures: Dict[int, Exception] = {}

        def start(count: int) -> None:
            for i, shard in islice(waiting, count):
                try:
                    running[self._submit(shard)] = i
                except Exception as error:  # as of workers that have died
                    failures[i] = error

        start(_AHEAD)
        try:
            while running:
                for future in self.workers.first(running):
                    i = running.pop(future)
                    start(1)
                    try:
                        self.results[shards[i] * self.shard_size] = future.result()
                    except Exception as error:
                        failures[i] = error
                    else:
                        yield i
        finally:
            for future in running:
                future.cancel()
        if failures:
            first = min(failures)
            begin, cause = shards[first] * self.shard_size, failures[first]
            raise Error(
                f"kte: the cases from {begin} to {min(begin + self.shard_size, len(self.cases)) - 1} were not computed: "
                f"{type(cause).__name__}: {cause}"
            ) from cause

    def fetch(self, begin: int, end: int) -> Tuple[Array, List[Tuple[int, str]]]:
        return self.results.pop(begin)


def _kte_range(columns: List[str], kept: List[str], run: Any, begin: int, values: Array) -> Any:
    return _kte._run_range(columns, kept, run, begin, values)


@overload
def sweep(
    cases: Any,
    run: Run,
    keep: Keep = ...,
    *,
    to: None = ...,
    threads: Optional[int] = ...,
    shard_size: Optional[int] = ...,
    packs: bool = ...,
    note: str = ...,
    progress: Union[bool, Callable[[SweepProgress], Any]] = ...,
    client: Any = ...,
) -> SweepTable: ...
@overload
def sweep(
    cases: Any,
    run: Run,
    keep: Keep = ...,
    *,
    to: Union[str, "os.PathLike[str]"],
    threads: Optional[int] = ...,
    shard_size: Optional[int] = ...,
    packs: bool = ...,
    note: str = ...,
    progress: Union[bool, Callable[[SweepProgress], Any]] = ...,
    client: Any = ...,
) -> SweepSummary: ...


def sweep(
    cases: Any,
    run: Run,
    keep: Keep = None,
    *,
    to: Union[None, str, "os.PathLike[str]"] = None,
    threads: Optional[int] = None,
    shard_size: Optional[int] = None,
    packs: bool = True,
    note: str = "",
    progress: Union[bool, Callable[[SweepProgress], Any]] = False,
    client: Any = None,
) -> Union[SweepTable, SweepSummary]:
    """Evaluates many cases, and keeps numbers of each.

    cases       `Cases`, as `evenly("tool/mass", 0, 5, 101)`; a dict of arrays or a DataFrame with a case a row
    run         a `SimulationRun`, an `OperationRun`, or a function of a `Case` that returns the kept numbers
    keep        the kept numbers: of runs of the library quantities, or a dict from names to quantities, by default the
                final state or all results; of functions names
    to          a file (.csv, .npy, .mcap): results go there, a `SweepSummary` is returned; a sweep that is interrupted
                continues where it was. Without a file all results are in the `SweepTable` that is returned
    threads     of runs of the library by default as many as there are cores, of functions one
    shard_size  cases that are computed and saved together; by default a 64th of all, at most 1024
    packs       of runs of the library whether cases are computed together, in packs, where they can be. Results then
                differ by rounding, and by the tolerances of the solver, from those of single calls
    note        distinguishes sweeps to the same file with the same cases and columns. A sweep continues if these, and of
                runs of the library the chain and all options, are as before; otherwise an error names what differs
    progress    True prints it, a function gets a `SweepProgress`, about twice a second
    client      a client of Dask, or a `concurrent.futures.Executor`: shards are computed by its workers

    A case fails if it raises an Exception, or a kept number is NaN: its row has `failed`, its reason is in `failures`, or
    in the file TO.failures.csv. Results do not depend on threads and workers.
    """
    varied = _cases(cases)
    named = {} if keep is None else {keep: keep} if isinstance(keep, str) else keep
    named = dict(named) if isinstance(named, Mapping) else {name: name for name in named}
    work: Any
    depends_on: List[Tuple[str, str]] = []
    if isinstance(run, (SimulationRun, OperationRun)):
        if isinstance(run, OperationRun) and run.operation == "passes" and not named:
            raise BadArgument("kte: keep must name the quantities to keep of passes, as tip/position")
        names, quantities = _kept(run, varied.names, named)
        work = run, quantities, bool(packs)
        if to is not None:
            depends_on = _dependences(run, quantities, bool(packs))
    elif callable(run):
        if not named:
            raise BadArgument("kte: keep must name the numbers that the function returns")
        names = list(named)
        work = _Evaluation(run, varied.names, list(named.values()))
    else:
        raise TypeError(f"kte: run must be a SimulationRun, an OperationRun or a function, not {run!r}")
    for name in names:
        if name in varied.names:
            raise BadArgument(f"kte: the cases have a column {name!r}: keep the result as keep={{'NAME': {name!r}}}")
    threads, shard_size = (None if x is None else operator.index(x) for x in (threads, shard_size))
    if threads is not None and threads < 1:
        raise BadArgument(f"kte: threads must be at least 1, got {threads}")
    if shard_size is not None and shard_size < 1:
        raise BadArgument(f"kte: shard_size must be at least 1, got {shard_size}")
    if threads is None:
        threads = 1 if isinstance(work, _Evaluation) else os.cpu_count() or 1
    if shard_size is None:
        shard_size = min(max(len(varied) // 64, 1 if isinstance(work, _Evaluation) else _A_PACK), 1024)

    completed = None
    if client is not None:
        elsewhere = _Elsewhere(_Workers(client), varied, names, work, shard_size)
        completed = elsewhere.completed(_kte._missing_shards(varied, names, to, shard_size, note, depends_on))
        work = elsewhere.fetch
    report = (_print_progress if progress else None) if isinstance(progress, bool) else progress
    result = _kte._run_sweep(varied, names, work, to, threads, shard_size, note, depends_on, report, completed)
    if to is not None:
        return result  # type: ignore[no-any-return]
    columns, failures, summary = result
    columns["case"] = columns["case"].astype(np.int64)
    columns["failed"] = columns["failed"].astype(bool)
    return SweepTable(columns, failures, summary)
