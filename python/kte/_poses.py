"""Poses and their algebra."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .errors import BadArgument

Array = np.ndarray[Any, np.dtype[np.float64]]


def _numbers(name: str, x: ArrayLike, *shape: int) -> Array:
    a = np.asarray(x, dtype=float)
    if a.shape[a.ndim - len(shape) :] != shape or a.ndim < len(shape):
        expected = ", ".join(["...", *map(str, shape)])
        raise BadArgument(f"kte: {name} has shape {a.shape}, expected ({expected})")
    if not np.isfinite(a).all():
        raise BadArgument(f"kte: {name} has a number that is not finite")
    return a


class Pose(NamedTuple):
    """A pose in axes of the base: `position`, m, and `rotation`, from own axes to axes of the base. Several poses
    have the same leading axes in both.

        kte.Pose.of([0.5, 0, 0.2], rotation_vector=[0, 0, np.pi / 2])
        tool = hand @ offset             # a pose in `hand` as one of the base
        tool @ [0.1, 0, 0]               # a point of it, or several, (..., 3), in axes of the base
        hand.inverse() @ tool            # the pose of `tool` in axes of `hand`
    """

    position: Array
    rotation: Array

    @staticmethod
    def of(
        position: ArrayLike = (0.0, 0.0, 0.0),
        rotation: Any = None,
        *,
        quaternion: Any = None,
        rotation_vector: Any = None,
        matrix: Any = None,
    ) -> Pose:
        """A pose from a position, m, and a rotation: a matrix, (3, 3), or anything with `as_matrix`, as those of scipy;
        a unit quaternion w, x, y, z; or a rotation vector, rad. Or from a `matrix`, (4, 4)."""
        given = [x for x in (rotation, quaternion, rotation_vector, matrix) if x is not None]
        if len(given) > 1:
            raise BadArgument("kte: a pose has one of rotation, quaternion, rotation_vector and matrix")
        if matrix is not None:
            m = _numbers("matrix", matrix, 4, 4)
            return Pose(m[..., :3, 3].copy(), m[..., :3, :3].copy())
        p = _numbers("position", position, 3)
        if quaternion is not None:
            return Pose(p, _from_quaternion(_numbers("quaternion", quaternion, 4)))
        if rotation_vector is not None:
            return Pose(p, _from_rotation_vector(_numbers("rotation_vector", rotation_vector, 3)))
        if rotation is None:
            return Pose(p, np.eye(3))
        return Pose(p, _numbers("rotation", rotation.as_matrix() if hasattr(rotation, "as_matrix") else rotation, 3, 3))

    def __matmul__(self, other: Any) -> Any:
        """The pose `other`, which is in this one, in axes of the base; or points of this one, (..., 3)."""
        if isinstance(other, Pose):
            return Pose(self @ other.position, self.rotation @ other.rotation)
        return self.position + (self.rotation @ _numbers("points", other, 3)[..., None])[..., 0]

    def inverse(self) -> Pose:
        """The pose of the base in this one."""
        back = np.swapaxes(self.rotation, -1, -2)
        return Pose(-(back @ np.asarray(self.position)[..., None])[..., 0], back)

    def matrix(self) -> Array:
        """The matrix, (..., 4, 4), that multiplies x, y, z, 1."""
        shape = np.broadcast_shapes(np.shape(self.position)[:-1], np.shape(self.rotation)[:-2])
        m = np.zeros((*shape, 4, 4))
        m[..., :3, :3], m[..., :3, 3], m[..., 3, 3] = self.rotation, self.position, 1
        return m

    def quaternion(self) -> Array:
        """The unit quaternion w, x, y, z of the rotation, with w >= 0."""
        r = np.asarray(self.rotation)
        xx, yy, zz = r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]
        # 4 q_i q_j of all pairs: the row of the largest number has the smallest rounding errors
        x, y, z = r[..., 2, 1] - r[..., 1, 2], r[..., 0, 2] - r[..., 2, 0], r[..., 1, 0] - r[..., 0, 1]
        xy, xz, yz = r[..., 0, 1] + r[..., 1, 0], r[..., 0, 2] + r[..., 2, 0], r[..., 1, 2] + r[..., 2, 1]
        w2, x2, y2, z2 = 1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz
        all_pairs = np.stack([w2, x, y, z, x, x2, xy, xz, y, xy, y2, yz, z, xz, yz, z2], axis=-1)
        pairs = all_pairs.reshape(*all_pairs.shape[:-1], 4, 4)
        best = np.argmax(np.stack([w2, x2, y2, z2], axis=-1), axis=-1)
        q = np.take_along_axis(pairs, best[..., None, None], axis=-2)[..., 0, :]
        q = q / np.linalg.norm(q, axis=-1, keepdims=True)
        return np.where(q[..., :1] < 0, -q, q)

    def rotation_vector(self) -> Array:
        """The axis of the rotation times its angle, rad, at most pi."""
        q = self.quaternion()
        half = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
        angle = 2 * np.arctan2(half, q[..., :1])
        v: Array = q[..., 1:] * np.where(half > 0, angle / np.where(half > 0, half, 1), 2)
        return v


def _from_quaternion(q: Array) -> Array:
    size = np.linalg.norm(q, axis=-1, keepdims=True)
    if not np.all(np.abs(size - 1) <= 1e-6):
        raise BadArgument(f"kte: the quaternion {np.array2string(q, threshold=8)} does not have the length 1")
    w, x, y, z = np.moveaxis(q / size, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _from_rotation_vector(v: Array) -> Array:
    angle = np.linalg.norm(v, axis=-1, keepdims=True)
    half = 0.5 * np.sinc(angle / (2 * np.pi))  # sin(angle/2) / angle
    return _from_quaternion(np.concatenate([np.cos(angle / 2), half * v], axis=-1))
