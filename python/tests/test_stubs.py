"""The types of the package: mypy, and its comparison of stubs with the module."""
import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

import kte

pytestmark = pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="needs mypy")
FOLDER = Path(kte.__file__).parent.parent

PROGRAM = """
import numpy as np
import kte
chain = kte.Chain(kte.revolute_joint_3D("q", "a", "b", axis=[0, 0, 1]), gravity=[0, 0, -9.81]) << kte.inertia_3D("b", 1)
a = kte.forward_dynamics(chain, [0.0], np.zeros(1), [1.0])
reveal_type(a)
reveal_type(kte.forward_kinematics(chain, [0.0], "b").position)
motion = kte.simulate(chain, [0.0], time=1, control=lambda t, q, v: -q, events=kte.Event(lambda t, q, v: float(q[0])))
kte.view(motion, "page.html")
push = kte.driving_actuator_gen("q", "motor")
kte.simulate(chain << push, [0.0], time=1, inputs={"motor": lambda t, q, v: 12 * t})
kte.simulate(chain, [0.0], time=1, inputs={"motor": lambda t, q, v: np.sin(q[0]), "wind": [2, 0, 0]})
laws = {"motor": lambda t, q, v: 2.0 * t}
kte.Simulation(chain, [0.0], inputs=laws).set_inputs({"motor": lambda t, q, v: t, "wind": np.zeros(3)})
kte.simulate(chain, [0.0], time=1, inputs=laws, only_if={"foot": lambda t, q, v: q[0] > 0})
def torque(t: float, q: kte.Array, v: kte.Array) -> float: return -2.0 * t
kte.simulate(chain, [0.0], time=1, inputs={"motor": torque}, control=lambda t, q, v: [1.0])
kte.sweep(kte.evenly("x", 0, 1, 3), lambda c: np.sin(c["x"]), "k")
kte.simulate(chain, [0.0], time=1, events=kte.Event(lambda t, q, v: q[0], reset=lambda t, q, v: (q, -v)))
table = kte.sweep(kte.evenly("x", 0, 1, 3), lambda c: {"k": 2 * c["x"]}, "k")
reveal_type(table)
kte.simulate(chain, [0.0], time=1, inputs={"motor": lambda t: 2.0})  # an error
kte.revolute_joint_3D("q", "a")  # an error
kte.forward_dynamics(chain, [0.0], [0.0])  # an error
"""


def run(*arguments, cwd):
    command = [sys.executable, "-m", *arguments]
    return subprocess.run(command, cwd=cwd, env={"MYPYPATH": str(FOLDER), "PYTHONPATH": str(FOLDER)}, capture_output=True, text=True)


def test_the_package_and_a_program_have_types(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    result = run("mypy", "--strict", "program.py", cwd=tmp_path)
    errors = [line for line in result.stdout.splitlines() if ": error:" in line]
    lines = [i for i, line in enumerate(PROGRAM.splitlines(), 1) if line.endswith("# an error")]
    assert sorted({int(e.split(":")[1]) for e in errors}) == lines, result.stdout
    revealed = [line for line in result.stdout.splitlines() if "Revealed type" in line]
    assert ["ndarray[Any, numpy.dtype[" in line for line in revealed] == [True, True, False] and "SweepTable" in revealed[2]
    assert run("mypy", "--strict", "-p", "kte", cwd=tmp_path).returncode == 0


def test_stubs_have_all_names_of_the_module(tmp_path):
    result = run("mypy.stubtest", "kte._kte", cwd=tmp_path)
    expected = ("metaclass differs", "__signature__ is not present", *(f"{x}.__init__" for x in ("Cases", "Distribution", "Motion", "Recording", "Robot")))  # those of pybind11
    errors = [x for x in result.stdout.splitlines() if x.startswith("error:") and not any(e in x for e in expected)]
    assert not errors, errors


def test_everything_has_a_docstring():
    undocumented = [n for n, x in vars(kte).items() if not n.startswith("_") and callable(x) and not x.__doc__]
    for kind in (kte.Chain, kte.Robot, kte.State, kte.Simulation, kte.Recording):
        undocumented += [n for n, x in vars(kind).items() if not n.startswith("_") and not x.__doc__]
    assert not undocumented
