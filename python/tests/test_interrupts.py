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
print("ready", flush=True)
try:
    CALL
except KeyboardInterrupt:
    print(time.time(), flush=True)
"""


def seconds_to_stop(file, call, n, after, **variables):
    """From a SIGINT some seconds after the begin of a call until it raises KeyboardInterrupt."""
    text = PROGRAM.replace("FILE", repr(str(file))).replace("CALL", call).replace("N,", f"{n},")
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


def test_compilation_hears_ctrl_c_and_leaves_nothing(robots, tmp_path):
    slow = tmp_path / "slow"  # a compiler with a child
    slow.write_text("#!/bin/sh\nsh -c 'sleep 20; touch \"$0\"' " + str(tmp_path / "late") + "\n")
    slow.chmod(0o755)
    variables = {"XDG_CACHE_HOME": str(tmp_path), "CXX": str(slow)}
    assert seconds_to_stop(robots / "iiwa14.urdf", "kte.compile(robot)", 1, after=1.0, **variables) < 0.5
    assert list((tmp_path / "kte").iterdir()) == []
    listed = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True).stdout
    assert str(tmp_path / "late") not in listed
