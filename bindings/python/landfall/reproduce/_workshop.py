"""An industrial workshop of 19.2 x 18.13 m: machines, pillars, an office with an open door.

Two 180-degree scanners back to back, 720 beams, 50 m, 1 cm of noise. Everything follows from a seed.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field

import numpy as np

from landfall._landfall import Beam, Pose2, PreparedMap, Sensor, WallMap

WIDTH_M, HEIGHT_M = 19.2, 18.13
CLEARANCE_M = 0.4  # of the robot's centre to any wall
BEAMS = 720
MOUNT_M = 0.15  # of either scanner before and behind the centre


@dataclass
class Workshop:
    """A plan, and the solid things in it as polygons."""

    walls: list[tuple[float, float, float, float]] = field(default_factory=list)
    solids: list[np.ndarray] = field(default_factory=list)
    door: tuple[float, float] = (0.0, 0.0)
    size_m: tuple[float, float] = (WIDTH_M, HEIGHT_M)

    def map(self) -> PreparedMap:
        return PreparedMap(WallMap(np.array(self.walls)), outside_unknown=True)

    def add_solid(self, corners: np.ndarray) -> None:
        self.solids.append(corners)
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            self.walls.append((*a, *b))

    def is_free(self, x_m: float, y_m: float) -> bool:
        """Whether the robot fits there."""
        point = np.array([x_m, y_m])
        if (point < 0.0).any() or (point > self.size_m).any():
            return False
        if any(_contains(corners, point) for corners in self.solids):
            return False
        walls = np.array(self.walls)
        return bool(_distance_to_segments(point, walls).min() > CLEARANCE_M)

    def random_poses(self, count: int, rng: np.random.Generator) -> list[Pose2]:
        poses: list[Pose2] = []
        while len(poses) < count:
            x_m, y_m = rng.uniform((0.0, 0.0), self.size_m)
            if self.is_free(x_m, y_m):
                poses.append(Pose2(x_m, y_m, rng.uniform(-math.pi, math.pi)))
        return poses


def make_workshop(seed: int) -> Workshop:
    rng = np.random.default_rng([seed, 1])
    workshop = Workshop()
    _add_shell(workshop, rng)
    _add_office(workshop, rng)
    _add_pillars(workshop, rng)
    _add_machines(workshop, rng, 11)
    return workshop


def make_room(seed: int) -> Workshop:
    """4 x 4 m, with three boxes along its walls."""
    rng = np.random.default_rng([seed, 9])
    side_m = 4.0
    room = Workshop(size_m=(side_m, side_m))
    corners = [(0.0, 0.0), (side_m, 0.0), (side_m, side_m), (0.0, side_m)]
    room.walls += [(*a, *b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    for at in ((0.7, 0.45), (3.5, 1.6), (1.6, 3.55)):
        center = np.array(at) + rng.uniform(-0.1, 0.1, 2)
        room.add_solid(_box(center, rng.uniform(0.5, 0.9), rng.uniform(0.3, 0.6), 0.0))
    return room


def make_scanners() -> Sensor:
    """Back to back: beams every half degree all around, from two mounts."""
    beams = []
    for mount_x_m, facing_rad in ((MOUNT_M, 0.0), (-MOUNT_M, math.pi)):
        for i in range(BEAMS // 2):
            bearing_rad = facing_rad + math.radians(-90.0 + 0.25 + 180.0 * i / (BEAMS // 2))
            beams.append(Beam(Pose2(mount_x_m, 0.0, bearing_rad), range_max_m=50.0))
    return Sensor(name="two_scanners", beams=beams, range_noise_m=0.01)


def _add_shell(workshop: Workshop, rng: np.random.Generator) -> None:
    """Outer walls with pilasters; one gate stands back from its wall."""
    corners = [(0.0, 0.0), (WIDTH_M, 0.0), (WIDTH_M, HEIGHT_M), (0.0, HEIGHT_M)]
    for k, (a, b) in enumerate(zip(corners, corners[1:] + corners[:1], strict=True)):
        start, end = np.array(a), np.array(b)
        length = float(np.linalg.norm(end - start))
        along = (end - start) / length
        inward = np.array([-along[1], along[0]])
        outline = [start]
        at = rng.uniform(2.0, 4.0)
        while at < length - 2.0:
            width, depth = rng.uniform(0.3, 0.6), rng.uniform(0.15, 0.35)
            if k == 0 and len(outline) == 5:
                width, depth = 2.4, 0.3  # the gate's frame
            foot = start + at * along
            outline += [foot, foot + depth * inward]
            outline += [foot + depth * inward + width * along, foot + width * along]
            at += width + rng.uniform(2.5, 5.0)
        outline.append(end)
        workshop.walls += [(*p, *q) for p, q in itertools.pairwise(outline)]


def _add_office(workshop: Workshop, rng: np.random.Generator) -> None:
    """A room in a corner, its door open by some angle."""
    width, depth = rng.uniform(4.0, 6.0), rng.uniform(3.0, 4.5)
    mirror_x, mirror_y = rng.random() < 0.5, rng.random() < 0.5
    door_m, leaf_rad = 0.9, rng.uniform(0.9, 1.7)
    at = rng.uniform(0.6, width - door_m - 0.6)
    hinge = (at, depth)
    leaf = (at + door_m * math.cos(leaf_rad), depth + door_m * math.sin(leaf_rad))
    walls = [(0.0, depth, *hinge), (at + door_m, depth, width, depth), (width, depth, width, 0.0)]
    walls += [(*hinge, *leaf)]

    def place(x_m: float, y_m: float) -> tuple[float, float]:
        return (WIDTH_M - x_m if mirror_x else x_m, HEIGHT_M - y_m if mirror_y else y_m)

    workshop.walls += [(*place(x1, y1), *place(x2, y2)) for x1, y1, x2, y2 in walls]
    workshop.door = place(at + 0.5 * door_m, depth)


def _add_pillars(workshop: Workshop, rng: np.random.Generator) -> None:
    for x_m in (WIDTH_M / 3, 2 * WIDTH_M / 3):
        for y_m in (HEIGHT_M / 3, 2 * HEIGHT_M / 3):
            center = np.array([x_m, y_m]) + rng.uniform(-0.6, 0.6, 2)
            if float(np.hypot(*(center - workshop.door))) > 1.5:
                workshop.add_solid(_box(center, rng.uniform(0.3, 0.5), rng.uniform(0.3, 0.5), 0.0))


def _add_machines(workshop: Workshop, rng: np.random.Generator, count: int) -> None:
    """Boxes, most along the walls' directions; aisles of a metre stay free between them."""
    aisle_m = 0.55  # each side's share
    placed = 0
    for _ in range(2000):
        if placed == count:
            return
        length, width = rng.uniform(1.0, 3.2), rng.uniform(0.6, 1.6)
        turn_rad = float(rng.choice([0.0, math.pi / 2])) if rng.random() < 0.6 else rng.uniform(0.0, math.pi)
        center = rng.uniform((1.2, 1.2), (WIDTH_M - 1.2, HEIGHT_M - 1.2))
        corners = _box(center, length, width, turn_rad)
        outline = _box(center, length + 2 * aisle_m, width + 2 * aisle_m, turn_rad)
        inside = (outline > 0.0).all() and (outline < (WIDTH_M, HEIGHT_M)).all()
        if not inside or float(np.hypot(*(center - workshop.door))) < 0.5 * length + 1.5:
            continue
        probes = np.concatenate([outline, (outline + np.roll(outline, -1, axis=0)) / 2])
        walls = np.array(workshop.walls)
        ends = np.concatenate([walls[:, :2], walls[:, 2:], (walls[:, :2] + walls[:, 2:]) / 2])
        if any(_contains(outline, end) for end in ends):
            continue
        if any(_distance_to_segments(probe, walls).min() < 0.3 for probe in probes):
            continue
        if any(_contains(solid, probe) for solid in workshop.solids for probe in probes):
            continue
        workshop.add_solid(corners)
        placed += 1


def _box(center: np.ndarray, length: float, width: float, turn_rad: float) -> np.ndarray:
    half = 0.5 * np.array([[-length, -width], [length, -width], [length, width], [-length, width]])
    c, s = math.cos(turn_rad), math.sin(turn_rad)
    return center + half @ np.array([[c, s], [-s, c]])


def _contains(corners: np.ndarray, point: np.ndarray) -> bool:
    """A convex polygon, counter-clockwise."""
    edge = np.roll(corners, -1, axis=0) - corners
    to = point - corners
    return bool((edge[:, 0] * to[:, 1] - edge[:, 1] * to[:, 0] > 0.0).all())


def _distance_to_segments(point: np.ndarray, segments: np.ndarray) -> np.ndarray:
    start, along = segments[:, :2], segments[:, 2:] - segments[:, :2]
    share = ((point - start) * along).sum(axis=1) / np.maximum(1e-12, (along**2).sum(axis=1))
    nearest = start + np.clip(share, 0.0, 1.0)[:, None] * along
    return np.asarray(np.linalg.norm(point - nearest, axis=1))
