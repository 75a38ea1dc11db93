"""Copies and pickles of chains and motions. Objects of a program's classes keep their class and attributes."""
from __future__ import annotations

import copy
from typing import Any, Dict, List, Optional, Tuple, Type

from . import _kte
from ._kte import Chain


def _made(kind: Type[Chain], chain: Chain) -> Chain:
    """An object of a class, of which `__init__` is not called, with an equal chain."""
    made = kind.__new__(kind)
    Chain.__init__(made)
    made._become(chain)
    return made


def copied(chain: Any, memo: Optional[Dict[int, Any]] = None) -> Any:
    """A copy; with a memo a deep one."""
    made, state = _made(type(chain), chain), chain.__getstate__()
    if memo is not None:
        memo[id(chain)] = made
        state = copy.deepcopy(state, memo)
    if hasattr(made, "__setstate__"):
        made.__setstate__(state)
    elif state is not None:
        for attributes in state if isinstance(state, tuple) else (state,):  # with __slots__ there are two dicts
            for name, value in (attributes or {}).items():
                setattr(made, name, value)
    return made


def reduced(chain: Any) -> Tuple[Any, ...]:
    """What `__reduce__` returns."""
    return _remade, (type(chain), *chain._pickle()), chain.__getstate__()


def called(function: str, arguments: Tuple[Any, ...], keywords: Dict[str, Any]) -> Any:
    """The result of a function of the package, which pickles hold by its name."""
    return getattr(_kte, function)(*arguments, **keywords)


def _remade(kind: Type[Chain], numbers: bytes, compiled_frames: Optional[List[str]]) -> Chain:
    return _made(kind, _kte._chain_from(numbers, compiled_frames))
