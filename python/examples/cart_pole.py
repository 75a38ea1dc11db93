"""A cart-pole balanced by LQR: the linear system by derivatives of forward dynamics, the Riccati equation by scipy."""
import numpy as np
from scipy.linalg import solve_continuous_are

import kte

cart_pole = kte.Chain(
    kte.prismatic_joint_2D("cart", "ground", "slider", [1, 0]),
    kte.inertia_2D("slider", mass=1),
    kte.revolute_joint_2D("pole", "slider", "rod"),
    kte.inertia_2D("rod", mass=0.1, com=[0, 0.5], inertia=0.1 * 1.0**2 / 12),
    gravity=[0, -9.81],
)
upright = np.zeros(2)

# x = (q, v), x' = (v, a); the motor moves the cart.
d = kte.forward_dynamics_derivatives(cart_pole, upright, upright, upright)
A = np.block([[np.zeros((2, 2)), np.eye(2)], [d.by_q, d.by_v]])
B = np.concatenate([np.zeros(2), d.by_tau[:, 0]])[:, None]
Q, R = np.diag([10, 10, 1, 1]), np.eye(1)
K = (np.linalg.inv(R) @ B.T @ solve_continuous_are(A, B, Q, R))[0]
print("unstable:", np.linalg.eigvals(A).real.max().round(3), "1/s; with feedback:", np.linalg.eigvals(A - np.outer(B, K)).real.max().round(3), "1/s")


def motor(t, q, v):
    return [-K @ np.concatenate([q, v]), 0.0]


motion = kte.simulate(cart_pole, [0.0, 0.3], time=8, control=motor)
print("from 0.3 rad to", motion.q[-1].round(6), "after 8 s; largest force", np.abs(motion["tau/cart"]).max().round(2), "N")
assert np.abs(motion.q[-1]).max() < 1e-2
print(kte.view(motion, "cart_pole.html", columns=["tau/cart"]))
