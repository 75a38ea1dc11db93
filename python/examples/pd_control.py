"""PD control with gravity compensation, as a function and as a sampled controller, with limits of torque."""
import pathlib

import numpy as np

import kte

file = pathlib.Path(__file__).resolve().parents[2] / "tests/data/robots/iiwa14.urdf"
arm = kte.load_robot(file)
start, goal = np.zeros(7), np.array([0.5, 0.6, -0.3, -1.2, 0.4, 0.8, 0.2])
effort = arm.limits.effort


def torque(t, q, v):
    """Gains of a critically damped oscillator of 8 rad/s for the masses at hand."""
    m = kte.mass_matrix(arm, q)
    return np.clip(m @ (64 * (goal - q) - 16 * v) + kte.nonlinear_effects(arm, q, v), -effort, effort)


motion = kte.simulate(arm, start, time=3, control=torque)
print("continuous: off by", np.abs(motion.q[-1] - goal).max(), "rad after 3 s")

# The same once a millisecond: forces are constant in between.
sampled = kte.simulate(arm, start, time=3, control=torque, control_every=1e-3, solver="runge_kutta4", step=1e-3)
print("sampled:    off by", np.abs(sampled.q[-1] - goal).max(), "rad after 3 s")
assert np.abs(motion.q[-1] - goal).max() < 1e-6 and np.abs(sampled.q[-1] - goal).max() < 1e-6
print(kte.view(motion, "pd_control.html"))
