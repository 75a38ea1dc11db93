"""Multibody dynamics: mechanisms of joints, links, bodies, springs, motors; robots from URDF, MJCF and SDF.

    import kte

    pendulum = kte.Chain(gravity=[0, -9.81, 0])
    pendulum << kte.revolute_joint_2D("q", "base", "joint")
    pendulum << kte.rigid_link_2D("joint", "tip", [0.5, 0]) << kte.inertia_2D("tip", mass=1)
    kte.forward_dynamics(pendulum, q=[0.0], v=[0.0], tau=[0.0])

Units are SI. The documentation is docs/python.md; conventions of axes and signs are in docs/conventions.md.
"""
from inspect import signature as _signature

from . import _html as _html
from ._element import Element as Element
from ._kte import *
from ._kte import __version__ as __version__
from ._results import *
from .contact_shapes import *
from .control import *
from .elements import *
from .errors import *
from .identification import *
from .joint_series import *
from .page import Page as Page
from .page import view as view
from .simulation import Event as Event
from .simulation import rollout as rollout
from .simulation import simulate as simulate
from .sweeps import *

for _kind in (Chain, State, Simulation):  # whose docstrings begin with their arguments
    _arguments = (_kind.__doc__ or "").partition(")\n\n")[0].partition("(")[2]
    setattr(_kind, "__signature__", _signature(eval(f"lambda {_arguments}: None".replace("\n", " "))))

#: `from kte import *` leaves out `compile`, which would hide Python's, and modules of the package.
__all__ = [n for n, x in list(vars().items()) if not n.startswith("_") and n != "compile" and not hasattr(x, "__path__") and not hasattr(x, "__spec__")]
