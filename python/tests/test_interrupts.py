"""Ctrl-C stops what computes for a long time without the GIL."""
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import kte

PROGRAM = """
import signal, time
import numpy as np
import kte
robot = kte.load_robot(FILE)
signal.signal(signal.SIGINT, signal.default_int_handler)  # jobs in the background of a shell ignore it
many = np.random.default_rng(1).standard_normal((N, 7))


def beam(n):  # links with springs
    chain, base = kte.Chain(), "base"
    for i in range(n):
        chain << kte.revolute_joint_3D(f"q{i}", base, f"a{i}", axis=[0, 1, 0]) << kte.joint_stiffness_gen(f"q{i}", 100.0)
        chain << kte.rigid_link_3D(f"a{i}", f"b{i}", [0.1, 0, 0]) << kte.inertia_3D(f"b{i}", mass=0.1)
        base = f"b{i}"
    return chain


prepared = PREPARED
print("ready", flush=True)
try:
    CALL
except KeyboardInterrupt:
    print(time.time(), flush=True)
"""


def seconds_to_stop(file, call, n, after, prepared="None", **variables):
    """From a SIGINT some seconds after the begin of a call until it raises KeyboardInterrupt."""
    text = PROGRAM.replace("FILE", repr(str(file))).replace("CALL", call).replace("N,", f"{n},")
    text = text.replace("PREPARED", prepared.replace("FILE", repr(str(file))))
    environment = {**os.environ, "PYTHONPATH": str(Path(kte.__file__).parents[1]), **variables}
    command = [sys.executable, "-c", text]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as child:
        try:
            assert child.stdout.readline() == "ready\n"
            time.sleep(after)
            child.send_signal(signal.SIGINT)
            sent = time.time()
            rest = child.communicate(timeout=60)[0]
            assert rest, "the call ended before the signal, or ignored it"
            return float(rest) - sent
        finally:
            child.kill()


@pytest.mark.parametrize(
    "call, n",
    [
        ("kte.forward_dynamics(robot, many, many, many, threads=2)", 2_000_000),  # packs
        ("kte.forward_dynamics(robot, many, many, many, threads=1)", 2_000_000),
        ("kte.inverse_dynamics_derivatives(robot, many, many, many, threads=2)", 200_000),
        ("kte.simulate(robot, [0.1] * 7, time=1e4, every=1)", 1),
        ("kte.sweep(kte.evenly('q/q1', 0, 1, 10**8), kte.OperationRun('energy', robot, [0.1] * 7), 'potential')", 1),
    ],
)
def test_calls_hear_ctrl_c(robots, call, n):
    assert seconds_to_stop(robots / "iiwa14.urdf", call, n, after=0.05) < 0.5


@pytest.mark.parametrize(
    "prepared, call",
    [
        ("beam(200)", "kte.static_equilibrium(prepared, [0.0] * 200, loads={'b199': [0, 0, -100]})"),
        ("beam(10)", "kte.equilibrium_path(prepared, [0.0] * 10, loads={'b9': [0, 0, -1]}, step=1e-7, points=10**8)"),
        ("beam(300)", "kte.natural_modes(prepared, [0.0] * 300)"),
        ("beam(200)", "kte.inverse_kinematics(prepared, 'b199', [300, 0, 0], start=[0.1] * 200, numeric=True)"),
        ("kte.load_robot(FILE.replace('iiwa14', 'four_bar'))", "kte.assemblies(prepared, 10**8, held=['q1'])"),
    ],
    ids=lambda x: x.split("(")[0],
)
def test_iterations_and_eigenvalues_hear_ctrl_c(robots, prepared, call):
    assert seconds_to_stop(robots / "iiwa14.urdf", call, 1, after=0.3, prepared=prepared) < 2


@pytest.fixture(scope="module")
def huge(tmp_path_factory):
    """A URDF of 50,000 joints."""
    file = tmp_path_factory.mktemp("huge") / "huge.urdf"
    link = "<link name='{}'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>"
    joint = "<joint name='j{}' type='continuous'><parent link='root'/><child link='{}'/></joint>"
    parts = [link.format(f"l{i}") + joint.format(i, f"l{i}") for i in range(50_000)]
    file.write_text("<robot name='r'>" + link.format("root") + "".join(parts) + "</robot>")
    return file


@pytest.mark.parametrize(
    "prepared, call, after",
    [
        ("None", "kte.load_robot(FILE)", 0.1),
        ("open(FILE).read()", "kte.parse_robot(prepared)", 0.1),
        ("beam(1000)", "[kte.save_model('SAVED.xml', prepared) for _ in range(1000)]", 0.3),
        ("kte.save_model('SAVED.xml', beam(10_000))", "kte.load_model('SAVED.xml')", 0.1),
        ("beam(1000)", "[kte.to_urdf(prepared, lossy=True) for _ in range(1000)]", 0.3),
    ],
    ids=["load_robot", "parse_robot", "save_model", "load_model", "to_urdf"],
)
def test_readers_and_writers_hear_ctrl_c(robots, huge, tmp_path, prepared, call, after):
    prepared, call = (
        text.replace("SAVED", str(tmp_path / "saved")).replace("FILE", repr(str(huge))) for text in (prepared, call)
    )
    assert seconds_to_stop(robots / "iiwa14.urdf", call, 1, after, prepared=prepared) < 0.5


def test_compilation_hears_ctrl_c_and_leaves_nothing(robots, tmp_path):
    slow = tmp_path / "slow"  # a compiler with a child
    slow.write_text("#!/bin/sh\nsh -c 'sleep 20; touch \"$0\"' " + str(tmp_path / "late") + "\n")
    slow.chmod(0o755)
    variables = {"XDG_CACHE_HOME": str(tmp_path), "CXX": str(slow)}
    assert seconds_to_stop(robots / "iiwa14.urdf", "kte.compile(robot)", 1, after=1.0, **variables) < 0.5
    assert list((tmp_path / "kte").iterdir()) == []
    listed = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True).stdout
    assert str(tmp_path / "late") not in listed
