"""The algebra of poses."""
import numpy as np
import pytest

import kte


def test_poses_are_composed_and_inverted(iiwa, random):
    q = random.uniform(-1, 1, 7)
    tool, elbow = kte.forward_kinematics(iiwa, q, "tool"), kte.forward_kinematics(iiwa, q, "link4")
    between = kte.relative_pose(iiwa, q, "tool", "link4")
    found = elbow.inverse() @ tool
    np.testing.assert_allclose(found.position, between.position, atol=1e-15)
    np.testing.assert_allclose(found.rotation, between.rotation, atol=1e-15)
    np.testing.assert_allclose((elbow @ found).matrix(), tool.matrix(), atol=1e-15)
    np.testing.assert_allclose(elbow.matrix() @ found.matrix(), tool.matrix(), atol=1e-15)
    points = random.uniform(-1, 1, (5, 3))
    np.testing.assert_allclose(tool @ points, points @ tool.rotation.T + tool.position, atol=1e-15)
    np.testing.assert_allclose((tool.inverse() @ (tool @ points)), points, atol=1e-15)


def test_many_poses_at_once(iiwa, random):
    q = random.uniform(-1, 1, (4, 5, 7))
    tools = kte.forward_kinematics(iiwa, q, "tool")
    back = tools.inverse() @ tools
    np.testing.assert_allclose(back.matrix(), np.broadcast_to(np.eye(4), (4, 5, 4, 4)), atol=1e-15)
    again = kte.Pose.of(tools.position, quaternion=tools.quaternion())
    np.testing.assert_allclose(again.rotation, tools.rotation, atol=1e-15)
    assert tools.quaternion().shape == (4, 5, 4) and (tools @ [0, 0, 1]).shape == (4, 5, 3)
    np.testing.assert_allclose(kte.Pose.of(matrix=tools.matrix()).matrix(), tools.matrix())


@pytest.mark.parametrize("angle", [0, 1e-200, 1e-9, 1e-3, 1, np.pi - 1e-9, np.pi])
def test_rotations_of_all_sizes_return(angle, random):
    for _ in range(50):
        axis = random.normal(size=3)
        v = angle * axis / np.linalg.norm(axis)
        pose = kte.Pose.of(rotation_vector=v)
        np.testing.assert_allclose(pose.rotation @ pose.rotation.T, np.eye(3), atol=1e-15)
        back = pose.rotation_vector()
        if np.dot(back, v) < 0:  # at pi both signs are right
            back = -back
        np.testing.assert_allclose(back, v, atol=1e-15 + 4e-16 * angle if angle < 3 else 1e-15, rtol=1e-14)
    np.testing.assert_allclose(kte.Pose.of(rotation_vector=[0, 0, np.pi / 2]).rotation, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=3e-16)


def test_rotations_of_scipy(random):
    rotations = pytest.importorskip("scipy.spatial.transform").Rotation
    r = rotations.from_rotvec(random.normal(size=(20, 3)))
    pose = kte.Pose.of(np.zeros((20, 3)), r)
    np.testing.assert_allclose(pose.rotation_vector(), r.as_rotvec(), atol=1e-14)
    np.testing.assert_allclose(rotations.from_matrix(pose.rotation).as_rotvec(), r.as_rotvec(), atol=1e-14)


def test_bad_poses_are_refused():
    with pytest.raises(kte.BadArgument, match=r"position has shape \(2,\), expected \(..., 3\)"):
        kte.Pose.of([1, 2])
    with pytest.raises(kte.BadArgument, match="position has a number that is not finite"):
        kte.Pose.of([0, 0, np.nan])
    with pytest.raises(kte.BadArgument, match="does not have the length 1"):
        kte.Pose.of(quaternion=[1, 1, 0, 0])
    with pytest.raises(kte.BadArgument, match="one of rotation, quaternion"):
        kte.Pose.of(rotation=np.eye(3), quaternion=[1, 0, 0, 0])
    with pytest.raises(kte.BadArgument, match="points has shape"):
        kte.Pose.of() @ [1.0, 2.0]
