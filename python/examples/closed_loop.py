"""A four-bar: assembled from a guess, its closure forces, and its motion with the loop closed to rounding."""
import numpy as np

import kte

bar = dict(mass=1, com=[0.3, 0], inertia=0.02)
four_bar = kte.Chain(gravity=[0, -9.81]).add(
    kte.revolute_joint_2D("crank", "base", "a"),
    kte.inertia_2D("a", **bar),
    kte.rigid_link_2D("a", "A", [0.4, 0]),
    kte.revolute_joint_2D("coupler", "A", "b"),
    kte.inertia_2D("b", **bar),
    kte.rigid_link_2D("b", "B1", [1.1, 0]),
    kte.revolute_joint_2D("rocker", "base", "r", position=[1, 0]),
    kte.inertia_2D("r", **bar),
    kte.rigid_link_2D("r", "B2", [0.8, 0]),
    kte.coincident_points_2D("pin", "B1", "B2"),
)
q = kte.assemble(four_bar, [1.1, -0.5, 1.5], held="crank")
v = kte.consistent_velocities(four_bar, q, [2, 0, 0])
r = kte.constrained_dynamics(four_bar, q, v, np.zeros(3))
print("assembled:", q.round(6), "mobility", r.mobility)
print("accelerations:", r.a.round(4), "force in the pin:", r.loops["pin"].force.round(4), "N")

motion = kte.simulate(four_bar, q, v, time=10, every=0.02)
gap = max(kte.loops(four_bar, x).gap for x in motion.q)
print(f"after 10 s the pin is open by at most {gap:.1e} m")
assert gap < 1e-13
print(kte.view(motion, "closed_loop.html", columns=["pin/force"]))
