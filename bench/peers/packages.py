"""kte beside Pinocchio and MuJoCo in Python: times of calls and batches, imports, memory, and how much results differ.

    python3 -m venv peers && peers/bin/pip install pin mujoco
    PYTHONPATH=build/release/python peers/bin/python bench/peers/packages.py

Calls alternate between the packages; times are medians of CPU time. Peers are left out where they are not installed.
"""
import importlib
import pathlib
import statistics
import subprocess
import sys
import time

import numpy as np

import kte

URDF = pathlib.Path(__file__).resolve().parents[2] / "tests/data/robots/iiwa14.urdf"
STATES, ROUNDS, CALLS = 10_000, 9, 2_000
IMPORTS = """
import sys, time
def megabytes(): return int(next(x for x in open("/proc/self/status") if x.startswith("VmRSS")).split()[1]) / 1024
before, start = megabytes(), time.process_time()
__import__(sys.argv[1])
print((time.process_time() - start) * 1e3, megabytes() - before)
"""


def installed(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        print(f"{name} is not installed: left out")
        return None


pin, mujoco = installed("pinocchio"), installed("mujoco")
chain = kte.load_robot(URDF, joint_dynamics=False).chain
q, v, a = np.random.default_rng(1).uniform(-1, 1, (3, STATES, chain.nv))
functions = {
    "inverse dynamics": {"kte": lambda i: kte.inverse_dynamics(chain, q[i], v[i], a[i])},
    "forward dynamics": {"kte": lambda i: kte.forward_dynamics(chain, q[i], v[i], a[i])},
    "mass matrix": {"kte": lambda i: kte.mass_matrix(chain, q[i])},
    "derivatives of forward dynamics": {"kte": lambda i: kte.forward_dynamics_derivatives(chain, q[i], v[i], a[i])},
    "Jacobian of the tool": {"kte": lambda i: kte.jacobian(chain, q[i], "tool")},
}
batches = {"inverse dynamics": kte.inverse_dynamics, "forward dynamics": kte.forward_dynamics}
if pin:
    model = pin.buildModelFromUrdf(str(URDF))
    data = model.createData()
    tool = model.getFrameId("tool")
    functions["inverse dynamics"]["pin"] = lambda i: pin.rnea(model, data, q[i], v[i], a[i])
    functions["forward dynamics"]["pin"] = lambda i: pin.aba(model, data, q[i], v[i], a[i])
    functions["mass matrix"]["pin"] = lambda i: pin.crba(model, data, q[i])
    functions["derivatives of forward dynamics"]["pin"] = lambda i: pin.computeABADerivatives(model, data, q[i], v[i], a[i])
    functions["Jacobian of the tool"]["pin"] = lambda i: pin.computeFrameJacobian(model, data, q[i], tool)
if mujoco:
    arm = mujoco.MjModel.from_xml_path(str(URDF))
    arm.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT
    state = mujoco.MjData(arm)

    def of_mujoco(function, forces, result):
        def call(i):
            state.qpos[:], state.qvel[:], forces[:] = q[i], v[i], a[i]
            function(arm, state)
            return result

        return call

    functions["inverse dynamics"]["mujoco"] = of_mujoco(mujoco.mj_inverse, state.qacc, state.qfrc_inverse)
    functions["forward dynamics"]["mujoco"] = of_mujoco(mujoco.mj_forward, state.qfrc_applied, state.qacc)


def seconds(f):
    start = time.process_time()
    f()
    return time.process_time() - start


def medians(tasks, rounds=ROUNDS):
    times = {name: [] for name in tasks}
    for _ in range(rounds):
        for name, task in tasks.items():
            times[name].append(seconds(task))
    return {name: statistics.median(x) for name, x in times.items()}


for name, by in functions.items():
    found = medians({p: lambda f=f: [f(i) for i in range(CALLS)] for p, f in by.items()})
    print(f"{name}, us a call:", {p: round(t / CALLS * 1e6, 2) for p, t in found.items()})
for name, of_all in batches.items():
    tasks = {"kte": lambda: of_all(chain, q, v, a, threads=1)}
    tasks.update({p: lambda f=f: [f(i).copy() for i in range(STATES)] for p, f in functions[name].items() if p != "kte"})
    print(f"{name} of {STATES} states, ms:", {p: round(t * 1e3, 1) for p, t in medians(tasks).items()})
    ours = of_all(chain, q, v, a)
    for p, f in functions[name].items():
        if p != "kte":
            theirs = np.array([f(i).copy() for i in range(STATES)])
            off = np.abs(theirs - ours).max(axis=1) / np.abs(ours).max(axis=1)
            print(f"{name}: {p} differs from kte by {off.max():.1e} of the largest number")
for name in ["kte", *(["pinocchio"] if pin else []), *(["mujoco"] if mujoco else []), "numpy"]:
    runs = [subprocess.run([sys.executable, "-c", IMPORTS, name], capture_output=True, text=True, check=True).stdout.split() for _ in range(5)]
    times, sizes = zip(*((float(t), float(m)) for t, m in runs))
    print(f"import {name}: {statistics.median(times):.0f} ms CPU, {statistics.median(sizes):.0f} MB")
