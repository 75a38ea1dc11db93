"""A pendulum: the exact period, a simulation, its energy, and a page."""
import numpy as np

import kte

pendulum = kte.Chain(gravity=[0, -9.81])
pendulum << kte.revolute_joint_2D("q", "base", "joint")
pendulum << kte.rigid_link_2D("joint", "tip", [0.5, 0])  # m
pendulum << kte.inertia_2D("tip", mass=1)  # kg
print(pendulum)
print("acceleration when let go from the horizontal:", kte.forward_dynamics(pendulum, [0.0], [0.0], [0.0]), "rad/s^2")

# Let go near the bottom it swings with the period 2 pi sqrt(l/g).
bottom = -np.pi / 2
crossing = kte.Event(lambda t, q, v: q[0] - bottom, "rising", name="through the bottom")
motion = kte.simulate(pendulum, [bottom + 1e-3], time=5, every=0.01, events=crossing, tolerance=1e-11)
period = np.diff([e.time for e in motion.events]).mean()
print(f"period {period:.6f} s, of small oscillations {2 * np.pi * np.sqrt(0.5 / 9.81):.6f} s")

# From the horizontal: energy is kept, and quantities of the recording have names.
motion = kte.simulate(pendulum, [0.0], time=10, every=0.01)
energy = kte.energy(pendulum, motion.q, motion.v)
print(f"energy changes by {np.ptp(energy.kinetic + energy.potential):.1e} J in 10 s")
print(motion.to_pandas(["q", "tip/position"]).head(3))
print(kte.view(motion, "pendulum.html", columns=["tip/velocity"]))
