"""Which payload does a PD law still carry? A sweep over masses and stiffnesses, in all cores."""
import numpy as np

import kte

arm = kte.Chain(gravity=[0, 0, -9.81]).add(
    kte.revolute_joint_3D("shoulder", "base", "upper", axis=[0, 1, 0]),
    kte.rigid_link_3D("upper", "elbow", [0.4, 0, 0]),
    kte.inertia_3D("elbow", mass=2),
    kte.revolute_joint_3D("wrist", "elbow", "lower", axis=[0, 1, 0]),
    kte.rigid_link_3D("lower", "tool", [0.3, 0, 0]),
    kte.inertia_3D("tool", mass=1),
    # The law, as elements: springs to q = 0, and dampers.
    kte.joint_stiffness_gen("shoulder", stiffness=800),
    kte.joint_stiffness_gen("wrist", stiffness=200),
    kte.joint_damping_gen("shoulder", damping=60),
    kte.joint_damping_gen("wrist", damping=20),
)
cases = kte.evenly("tool/mass", 0, 10, 21) * kte.one_of("shoulder/stiffness", [400, 800, 1600])
table = kte.sweep(cases, kte.SimulationRun(arm, [0.0, 0.0], time=3), {"height": "frame:tool/position/z"})

for stiffness in np.unique(table["shoulder/stiffness"]):
    carried = table["tool/mass"][(table["shoulder/stiffness"] == stiffness) & (table["height"] > -0.1)]
    print(f"{stiffness:.0f} Nm/rad carry {carried.max():.1f} kg within 0.1 m")
