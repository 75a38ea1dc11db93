"""A cart-pole balanced by LQR: its motion near the upright position, a feedback for it, and a simulation from far off."""
import numpy as np

import kte

cart_pole = kte.Chain(
    kte.prismatic_joint_2D("cart", "ground", "slider", [1, 0]),
    kte.inertia_2D("slider", mass=1),
    kte.revolute_joint_2D("pole", "slider", "rod"),
    kte.inertia_2D("rod", mass=0.1, com=[0, 0.5], inertia=0.1 * 1.0**2 / 12),
    kte.driving_actuator_gen("cart", "motor"),
    gravity=[0, -9.81],
)
upright = np.zeros(2)

linear = kte.linearize(cart_pole, upright)  # d' = A d + B du, with d = (q, v) here
gain = kte.lqr(linear, Q=[10, 10, 1, 1], R=1)
print("unstable:", np.linalg.eigvals(linear.A).real.max().round(3), "1/s; with feedback:", gain.poles.real.max().round(3), "1/s")


def motor(t, q, v):
    return float((-gain.K @ kte.displacement(cart_pole, upright, [0, 0], q, v))[0])


motion = kte.simulate(cart_pole, [0.0, 0.3], time=8, inputs={"motor": motor})
print("from 0.3 rad to", motion.q[-1].round(6), "after 8 s; largest force", np.abs(motion["motor"]).max().round(2), "N")
assert np.abs(motion.q[-1]).max() < 1e-2
print(kte.view(motion, "cart_pole.html", columns=["motor"]))
