"""What notebooks show of objects: tables."""
from __future__ import annotations

import html
from typing import Any, Iterable, List, Sequence

import numpy as np

from ._kte import Chain, Recording, Robot
from .sweeps import SweepTable

_MOST_ROWS = 40


def _cell(x: Any) -> str:
    return f"{x:.6g}" if isinstance(x, (float, np.floating)) else str(x)


def _table(caption: str, heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    all_rows = list(rows)
    shown = [[_cell(x) for x in row] for row in all_rows[:_MOST_ROWS]]
    if len(all_rows) > _MOST_ROWS:
        shown.append([f"and {len(all_rows) - _MOST_ROWS} more", *[""] * (len(heads) - 1)])
    line = "".join
    head = line(f"<th>{html.escape(x)}</th>" for x in heads)
    body = line(f"<tr>{line(f'<td>{html.escape(x)}</td>' for x in row)}</tr>" for row in shown)
    return f"<div>{html.escape(caption)}</div><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _of_chain(self: Chain) -> str:
    def numbers(values: List[float]) -> str:
        return _cell(values[0]) if len(values) == 1 else f"({', '.join(map(_cell, values))})"

    rows = [
        (i, e.type, ", ".join(e.ports.values()), ", ".join(f"{name} {numbers(x)}" for name, x in e.parameters.items()))
        for i, e in enumerate(self.elements)
    ]
    return _table(repr(self), ("", "element", "connections", "parameters"), rows)


def _of_robot(self: Robot) -> str:
    x = self.limits
    rows = [
        (c.name, c.kind, *(x.lower[c.v], x.upper[c.v], x.rate[c.v], x.effort[c.v])) if c.kind == "coordinate" else (c.name, c.kind, *[""] * 4)
        for c in self.chain.layout
    ]
    flat = [[float(n[0]) if isinstance(n, np.ndarray) else n for n in row] for row in rows]
    return _table(repr(self), ("coordinate", "kind", "lower", "upper", "rate", "effort"), flat)


def _of_recording(self: Recording) -> str:
    rows = [(name, x[0], x[-1], x.min(), x.max()) for name, x in self.columns().items() if len(x) > 0]
    return _table(repr(self), ("column", "first", "last", "least", "most"), rows)


def _of_sweep(self: SweepTable) -> str:
    return _table(repr(self), list(self), zip(*self.values()))


for kind, function in ((Chain, _of_chain), (Robot, _of_robot), (Recording, _of_recording), (SweepTable, _of_sweep)):
    function.__doc__ = "What a notebook shows."
    setattr(kind, "_repr_html_", function)
