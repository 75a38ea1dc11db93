"""A robot from a URDF text: its dynamics at many states at once, and inverse kinematics."""
import numpy as np

import kte

URDF = """<robot name="arm">
  <link name="ground"/>
  <joint name="turn" type="revolute">
    <parent link="ground"/> <child link="column"/> <origin xyz="0 0 0.3"/> <axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="2" effort="80"/>
  </joint>
  <link name="column">
    <inertial><mass value="4"/> <inertia ixx="0.02" iyy="0.02" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="column"/> <child link="upper"/> <axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" velocity="2" effort="80"/>
  </joint>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 0.2"/> <mass value="3"/> <inertia ixx="0.04" iyy="0.04" izz="0.005" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="upper"/> <child link="fore"/> <origin xyz="0 0 0.4"/> <axis xyz="0 1 0"/>
    <limit lower="-2.5" upper="2.5" velocity="3" effort="40"/>
  </joint>
  <link name="fore">
    <inertial>
      <origin xyz="0 0 0.15"/> <mass value="2"/> <inertia ixx="0.015" iyy="0.015" izz="0.002" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="flange" type="fixed"> <parent link="fore"/> <child link="tool"/> <origin xyz="0 0 0.3"/> </joint>
  <link name="tool"/>
</robot>"""

arm = kte.parse_robot(URDF)
print(arm, "of", arm.joints)

# The torques that hold it at a hundred thousand random configurations, in one call.
random = np.random.default_rng(1)
q = random.uniform(arm.limits.lower, arm.limits.upper, size=(100_000, 3))
torques = kte.static_forces(arm, q)
print("largest holding torques:", np.abs(torques).max(axis=0).round(2), "Nm; the motors have", arm.limits.effort)

# Where to go for a point, within limits.
found = kte.inverse_kinematics(arm, "tool", [0.3, 0.2, 0.5], start=[0, 0.5, 1.0])
print("inverse kinematics:", found.status, found.q.round(4), f"off by {found.position_error:.1e} m")
print("there:", kte.forward_kinematics(arm, found.q, "tool").position.round(9))
print(kte.view(arm, "own_robot.html"))
