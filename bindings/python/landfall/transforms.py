"""Stamped transforms as in ROS tf: a tree of frames, interpolated in time, projected onto the plane."""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import dataclass, field

import numpy as np

from landfall._landfall import Pose2, wrap_angle

MAX_GAP_S = 1.0  # a transform further away in time says nothing


def rotation_matrix(q: np.ndarray) -> np.ndarray:
    """3x3 of a quaternion (x, y, z, w); not necessarily of unit length."""
    x, y, z, w = q / (np.linalg.norm(q) or 1.0)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


@dataclass(frozen=True)
class Mount:
    """A rigid transform in space: where a sensor sits; upside down is allowed."""

    translation: np.ndarray = field(default_factory=lambda: np.zeros(3))
    rotation: np.ndarray = field(default_factory=lambda: np.eye(3))

    def __mul__(self, other: Mount) -> Mount:
        return Mount(self.translation + self.rotation @ other.translation, self.rotation @ other.rotation)

    def beams(self, angles_rad: np.ndarray) -> list[Pose2]:
        """Planar beam poses for a scanner's angles in its own xy plane."""
        in_sensor = np.stack([np.cos(angles_rad), np.sin(angles_rad), np.zeros_like(angles_rad)])
        x, y, _ = self.rotation @ in_sensor
        tx, ty = float(self.translation[0]), float(self.translation[1])
        return [Pose2(tx, ty, math.atan2(dy, dx)) for dx, dy in zip(x, y, strict=True)]


class StampedPoses:
    """A frame's pose in its parent over time."""

    def __init__(self) -> None:
        self.entries: list[tuple[float, np.ndarray, np.ndarray]] = []
        self.stamps: list[float] = []

    def add(self, stamp_s: float, translation: np.ndarray, quaternion: np.ndarray) -> None:
        self.entries.append((stamp_s, translation, quaternion))

    def sort(self) -> None:
        self.entries.sort(key=lambda entry: entry[0])
        self.stamps = [entry[0] for entry in self.entries]

    def mount(self) -> Mount:
        """The transform as first recorded: mounts do not move."""
        _, translation, quaternion = self.entries[0]
        return Mount(translation, rotation_matrix(quaternion))

    def at(self, stamp_s: float) -> Pose2 | None:
        """Linear between neighbours; the end's own value up to MAX_GAP_S beyond; one entry is static."""
        if not self.entries:
            return None
        if len(self.entries) == 1:
            return _planar(self.entries[0])
        after = bisect_left(self.stamps, stamp_s)
        if after == 0 or after == len(self.entries):
            end = self.entries[min(after, len(self.entries) - 1)]
            return _planar(end) if abs(end[0] - stamp_s) <= MAX_GAP_S else None
        return _between(self.entries[after - 1], self.entries[after], stamp_s)


def _planar(entry: tuple[float, np.ndarray, np.ndarray]) -> Pose2:
    _, t, q = entry
    R = rotation_matrix(q)
    return Pose2(float(t[0]), float(t[1]), math.atan2(R[1, 0], R[0, 0]))


def _between(before: tuple, after: tuple, stamp_s: float) -> Pose2:
    a, b = _planar(before), _planar(after)
    share = (stamp_s - before[0]) / (after[0] - before[0])
    return Pose2(
        a.x_m + share * (b.x_m - a.x_m),
        a.y_m + share * (b.y_m - a.y_m),
        wrap_angle(a.theta_rad + share * wrap_angle(b.theta_rad - a.theta_rad)),
    )


class TransformTree:
    """Frames by child: each has one parent, as tf demands."""

    def __init__(self) -> None:
        self.parents: dict[str, str] = {}
        self.poses: dict[str, StampedPoses] = {}

    def add(
        self, parent: str, child: str, stamp_s: float, translation: np.ndarray, quaternion: np.ndarray
    ) -> None:
        self.parents[child] = parent
        self.poses.setdefault(child, StampedPoses()).add(stamp_s, translation, quaternion)

    def sort(self) -> None:
        for poses in self.poses.values():
            poses.sort()

    def chain(self, frame: str) -> list[str]:
        """The frame and all above it."""
        frames = [frame]
        while frames[-1] in self.parents and self.parents[frames[-1]] not in frames:
            frames.append(self.parents[frames[-1]])
        return frames

    def lookup(self, parent: str, child: str, stamp_s: float) -> Pose2 | None:
        """T_parent_child in the plane, or None where a link of the chain has no value near that time."""
        T_parent_child = Pose2()
        chain = self.chain(child)
        for frame in reversed(chain[: chain.index(parent)]):
            step = self.poses[frame].at(stamp_s)
            if step is None:
                return None
            T_parent_child = T_parent_child * step
        return T_parent_child

    def mount(self, parent: str, child: str) -> Mount:
        """T_parent_child in space; the identity where the frames are not connected."""
        mount = Mount()
        chain = self.chain(child)
        if parent in chain:
            for frame in reversed(chain[: chain.index(parent)]):
                mount = mount * self.poses[frame].mount()
        return mount
