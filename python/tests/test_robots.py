import copy
import pickle

import numpy as np
import pytest

import kte

URDF = """<robot name="arm">
  <link name="ground"/>
  <joint name="shoulder" type="revolute">
    <parent link="ground"/> <child link="arm"/>
    <axis xyz="0 0 1"/> <limit lower="-2" upper="2" velocity="3" effort="50"/>
  </joint>
  <link name="arm">
    <inertial>
      <origin xyz="0.5 0 0"/> <mass value="2"/>
      <inertia ixx="0.1" iyy="0.1" izz="0.3" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <transmission name="drive"/>
</robot>"""


@pytest.mark.filterwarnings("ignore::kte.RobotWarning")
def test_robots_have_chains_limits_and_notes():
    arm = kte.parse_robot(URDF, "arm.urdf")
    assert arm.name == "arm" and arm.joints == ["shoulder"] and arm.chain.frames[:2] == ["ground", "arm"]
    assert arm.limits.lower == [-2] and arm.limits.upper == [2] and arm.limits.rate == [3] and arm.limits.effort == [50]
    assert "transmission 'drive'" in arm.not_read[0].text and arm.not_read[0].line == 13
    assert repr(arm).startswith("<kte.Robot 'arm': 1 degree of freedom")
    assert "physically realizable" in " ".join(arm.check())


def test_what_is_odd_is_a_warning():
    with pytest.warns(kte.RobotWarning, match=r"kte: arm.urdf:7: link 'arm': the inertia is not physically realizable"):
        kte.parse_robot(URDF, "arm.urdf")


@pytest.mark.filterwarnings("ignore::kte.RobotWarning")  # what MJCF leaves out
def test_formats_give_the_same_robot(iiwa, random):
    q, v, a = random.standard_normal((3, 7))
    expected = kte.inverse_dynamics(iiwa, q, v, a)
    for text in (kte.to_urdf(iiwa), kte.to_mjcf(iiwa)):
        again = kte.parse_robot(text)
        np.testing.assert_allclose(kte.inverse_dynamics(again, q, v, a), expected, atol=1e-9)


def test_options_change_the_chain(robots):
    floating = kte.load_robot(robots / "iiwa14.urdf", floating_base=True, gravity=[0, 0, -1.62])
    assert floating.chain.nq == 14 and floating.chain.nv == 13
    assert floating.chain.gravity.tolist() == [0, 0, -1.62]


def test_motors_are_inputs_of_the_chain(iiwa):
    iiwa.add_motors()
    assert [m.joint for m in iiwa.motors] == iiwa.joints
    q = np.zeros(7)
    torque = kte.gravity_forces(iiwa, q + 0.3)
    a = kte.forward_dynamics(iiwa, q + 0.3, q, q, inputs=dict(zip((m.input for m in iiwa.motors), torque)))
    np.testing.assert_allclose(a, 0, atol=1e-9)
    with pytest.raises(kte.BadArgument, match="motors"):
        iiwa.add_motors()


@pytest.mark.parametrize(
    "what, sentence",
    [
        (lambda: kte.load_robot("nowhere.urdf"), "cannot open 'nowhere.urdf'"),
        (lambda: kte.parse_robot("<robot name='a'><link/></robot>", "a.urdf"), "a.urdf:1: "),
    ],
)
def test_bad_files_are_errors(what, sentence):
    with pytest.raises(kte.BadFile, match=sentence):
        what()


def test_inverse_kinematics_reaches_poses(iiwa, random):
    for _ in range(5):
        q = random.uniform(-1, 1, 7)
        pose = kte.forward_kinematics(iiwa, q, "tool")
        for numeric in (False, True):
            found = kte.inverse_kinematics(iiwa, "tool", pose.position, pose.rotation, start=q + 0.1, numeric=numeric)
            assert found.status == "reached" and found.position_error < 1e-8 and found.rotation_error < 1e-8
            again = kte.forward_kinematics(iiwa, found.q, "tool")
            np.testing.assert_allclose(again.position, pose.position, atol=1e-8)
        place = kte.inverse_kinematics(iiwa, "tool", pose.position, start=q)
        assert place.status == "reached"
        every = kte.inverse_kinematics_all(iiwa, "tool", *pose)
        assert len(every) == 8 and all(a.status in ("reached", "beyond_limits") for a in every)
    assert kte.inverse_kinematics_all(iiwa, "tool", [5, 0, 0], np.eye(3)) == []


def test_poses_out_of_reach_are_named(iiwa):
    for rotation in (None, np.eye(3)):
        for numeric in (False, True):
            far = kte.inverse_kinematics(iiwa, "tool", [5, 0, 0], rotation, numeric=numeric)
            assert far.status == "out_of_reach" and far.position_error > 3
            with pytest.raises(kte.Unreachable, match="'tool' does not get there .out_of_reach.: [34].* m"):
                kte.inverse_kinematics(iiwa, "tool", [5, 0, 0], rotation, numeric=numeric, must_reach=True)
    arm = kte.Chain(
        kte.revolute_joint_3D("q0", "base", "a", axis=[0, 0, 1], position=[0, 0, 3]),
        kte.rigid_link_3D("a", "A", [1, 0, 0]),
        kte.revolute_joint_3D("q1", "A", "b", axis=[0, 0, 1]),
        kte.rigid_link_3D("b", "tip", [0.5, 0, 0]),
        kte.inertia_3D("tip", 1),
    )
    assert kte.inverse_kinematics(arm, "tip", [1.4999, 0, 3], start=[0.1, 0.1]).status == "reached"
    assert kte.inverse_kinematics(arm, "tip", [1.501, 0, 3], start=[0.1, 0.1]).status == "out_of_reach"
    assert kte.inverse_kinematics(arm, "tip", [0.4, 0, 3], start=[0.1, 0.1]).status == "local_minimum"  # inside


def test_limits_of_inverse_kinematics(iiwa):
    pose = kte.forward_kinematics(iiwa, np.full(7, 0.3), "tool")
    narrow = iiwa.limits._replace(lower=np.full(7, 0.25), upper=np.full(7, 0.35))
    found = kte.inverse_kinematics(iiwa, "tool", *pose, limits=narrow)
    assert (found.q >= 0.25).all() and (found.q <= 0.35).all() and found.status == "reached"
    with pytest.raises(kte.Error, match="closed form|formula"):
        kte.inverse_kinematics_all(kte.Chain(kte.revolute_joint_3D("q", "a", "b")), "b", *pose)


FOOT = """<robot name="hopper"><link name="leg">
  <inertial><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision name="foot"><origin xyz="0 0 -0.4"/><geometry><sphere radius="0.02"/></geometry></collision>
</link></robot>"""


def test_collision_shapes_touch_the_ground():
    contacts = dict(ground="world", friction=0.7)
    hopper = kte.parse_robot(FOOT, floating_base=True, contacts=contacts)
    assert hopper.contacts == ["foot"]
    np.testing.assert_allclose(hopper.configurations["standing"], [0, 0, 0.42, 1, 0, 0, 0], atol=1e-15)
    soft = kte.parse_robot(FOOT, floating_base=True, contacts=dict(contacts, compliant=dict(stiffness=1e5)))
    assert soft.contacts == [] and soft.chain.elements[-1].type == "compliant_contact_3D"
    for bad, sentence in [
        (dict(ground="world", mu=1), "contacts has no 'mu'"),
        (dict(friction=1), "contacts needs a 'ground'"),
        (3, "contacts must be a dict"),
        (dict(ground="world", friction="rough"), r"contacts\['friction'\] is 'rough'"),
        (dict(ground="world", compliant=dict(stiffness=[1])), r"compliant\['stiffness'\] is \[1\]"),
    ]:
        with pytest.raises((TypeError, ValueError), match=sentence):
            kte.parse_robot(FOOT, floating_base=True, contacts=bad)


@pytest.mark.filterwarnings("ignore::kte.RobotWarning")
def test_robots_are_pickled_and_copied(iiwa):
    arm = kte.parse_robot(URDF, "arm.urdf", gravity=[0, 0, -1])
    for robot in (iiwa, arm):
        q = np.full(robot.chain.nq, 0.3)
        for copied in (pickle.loads(pickle.dumps(robot)), copy.deepcopy(robot), copy.copy(robot)):
            assert repr(copied) == repr(robot) and copied.chain == robot.chain and copied.chain is not robot.chain
            assert np.array_equal(copied.limits.effort, robot.limits.effort) and copied.not_read == robot.not_read
            copied.chain << kte.base_3D("elsewhere")
            assert len(copied.chain) == len(robot.chain) + 1
            assert np.array_equal(kte.gravity_forces(copied, q), kte.gravity_forces(robot, q))
    iiwa.add_motors(stiffness=100)
    assert pickle.loads(pickle.dumps(iiwa)).motors == iiwa.motors == copy.deepcopy(iiwa).motors


def test_motions_keep_limits(iiwa):
    start, end = np.zeros(7), np.linspace(-1, 1, 7)
    limits = iiwa.limits._replace(acceleration=np.full(7, 4.0))
    for motion in (kte.trapezoidal_motion(iiwa, start, end, limits=limits), kte.quintic_motion(iiwa, start, end, limits=limits)):
        x = motion(np.linspace(0, motion.duration, 501))
        np.testing.assert_allclose([x.q[0], x.q[-1]], [start, end], atol=1e-14)
        assert (abs(x.v) <= limits.rate + 1e-12).all() and (abs(x.a) <= limits.acceleration + 1e-9).all()
        assert abs(x.v / limits.rate).max() > 0.99 or abs(x.a / limits.acceleration).max() > 0.99
        np.testing.assert_array_equal(motion(motion.duration / 2).q, motion([motion.duration / 2]).q[0])
    assert kte.quintic_motion(iiwa.chain, start, end, 3.0).duration == 3
    with pytest.raises(kte.BadArgument, match="trapezoidal_motion.*acceleration"):
        kte.trapezoidal_motion(iiwa, start, end)
    with pytest.raises(kte.BadArgument, match="beyond the limits of .*'q4'"):
        kte.quintic_motion(iiwa, start, [0, 0, 0, 3, 0, 0, 0])
    with pytest.raises(TypeError, match="t must be a number"):
        kte.quintic_motion(iiwa, start, end)("now")


def test_options_out_of_their_range_and_zero_bytes_are_named(robots, iiwa):
    for tolerance in (-1.0, 1e308, float("nan")):
        with pytest.raises(kte.BadArgument, match="quarter_turn_tolerance must be between 0 and 0.1 rad, got"):
            kte.load_robot(robots / "iiwa14.urdf", quarter_turn_tolerance=tolerance)
    for smoothing in (0, -1, float("nan")):
        with pytest.raises(kte.BadArgument, match="kte: friction_smoothing must be finite and positive, got"):
            kte.load_robot(robots / "iiwa14.urdf", friction_smoothing=smoothing)
    with pytest.raises(TypeError, match="search_path must be a list of folders, not a str"):
        kte.load_robot(robots / "iiwa14.urdf", search_path="/tmp")
    with pytest.raises(kte.UnknownName, match=r"nothing named 'to\\x00ol'"):
        kte.forward_kinematics(iiwa, np.zeros(7), "to\0ol")
    with pytest.raises(kte.BadArgument, match=r"must be finite, as must its square, got \(1e\+308, 0, 0\)"):
        kte.inverse_kinematics(iiwa, "tool", [1e308, 0, 0], np.eye(3), numeric=True)
    with pytest.raises(kte.BadArgument, match="the position, or its square, is not finite"):
        kte.inverse_kinematics_all(iiwa, "tool", [1e308, 0, 0], np.eye(3))
