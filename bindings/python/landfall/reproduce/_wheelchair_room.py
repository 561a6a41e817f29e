"""A room with the nine sides of the paper's Table III, and a UHG-08LX that is pushed through it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from landfall._landfall import Pose2, PreparedMap, Scan, Sensor, WallMap, make_fan, simulate_ranges
from landfall.pictures import in_map

SIDES_M = (4.490, 0.590, 0.800, 0.748, 0.510, 1.320, 2.170, 6.710, 4.445)  # S1 to S9
FIRST_CORNER = (0, 1, 2, 3, 4, 5, 6, 10, 11)  # side k goes from this corner to the next
ALCOVE_M = 0.45
BEAMS, STEP_DEG = 769, 0.3515625  # 270 degrees
RANGE_MIN_M, RANGE_MAX_M = 0.1, 8.0
NOISE_NEAR, NEAR_M, NOISE_M = 0.03, 1.0, 0.03  # 3 % up to 1 m, 30 mm beyond; uniform
BOXES, TRIES = 3, 2000
CLEARANCE_M = 0.35  # of furniture from track and walls
# Of the track's corners, room frame; a seed shifts each by up to WANDER_M.
TRACK_M = ((0.9, 0.9), (5.7, 0.9), (5.7, 3.4), (3.0, 3.4), (3.0, 1.9), (-0.5, 0.8))
MIDDLE_M = (3.6, 2.1)
WANDER_M = 0.15


@dataclass
class Room:
    """Corners, track and furniture in the room's frame; the map in that of the robot's first pose."""

    map: PreparedMap
    corners: np.ndarray  # (12, 2) of the walls, in turn
    boxes: list[np.ndarray]
    track: np.ndarray
    T_room_start: Pose2

    def side(self, index: int) -> np.ndarray:
        """Both ends of S(index + 1), in the frame of the robot's first pose."""
        first = FIRST_CORNER[index]
        ends = self.corners[[first, (first + 1) % len(self.corners)]]
        return in_map(self.T_room_start.inverse(), ends)


def make_room(seed: int, *, in_the_middle: bool = False) -> Room:
    """Table III's sides at right angles, closed by three more; furniture off the track; mirrored or not.

    The robot starts where the track does, looking along it, or in the middle of the room.
    """
    rng = np.random.default_rng([seed, 7])
    mirror = np.array([1.0, -1.0 if rng.random() < 0.5 else 1.0])
    track = np.array(TRACK_M) + rng.uniform(-WANDER_M, WANDER_M, (len(TRACK_M), 2))
    boxes = [box * mirror for box in _furniture(rng, track)]
    corners, track = _corners() * mirror, track * mirror
    ahead = track[1] - track[0]
    start = np.array(MIDDLE_M) * mirror if in_the_middle else track[0]
    T_room_start = Pose2(float(start[0]), float(start[1]), math.atan2(ahead[1], ahead[0]))
    outlines = [in_map(T_room_start.inverse(), outline) for outline in (corners, *boxes)]
    walls = np.vstack([np.hstack([outline, np.roll(outline, -1, axis=0)]) for outline in outlines])
    return Room(PreparedMap(WallMap(walls), resolution_m=0.1), corners, boxes, track, T_room_start)


def _corners() -> np.ndarray:
    """The first is where S1 begins: five steps of a niche, an alcove, the long wall."""
    s1, s2, s3, s4, s5, s6, s7, s8, s9 = SIDES_M
    steps = [(-s1, 0), (0, -s2), (-s3, 0), (0, -s4), (-s5, 0), (0, -s6), (-s7, 0)]
    corners = np.cumsum([(s8, s9), *steps], axis=0)
    alcove = [(corners[-1][0], -ALCOVE_M), (0.0, -ALCOVE_M)]
    return np.vstack([corners, alcove, [(0.0, 0.0), (s8, 0.0)]])


def _furniture(rng: np.random.Generator, track: np.ndarray) -> list[np.ndarray]:
    """Boxes that stand free, turned anyhow."""
    boxes: list[np.ndarray] = []
    for _ in range(TRIES):
        if len(boxes) == BOXES:
            break
        center = rng.uniform((0.6, 0.5), (6.2, 3.9))
        half = rng.uniform(0.06, 0.22, 2)
        radius = float(np.hypot(*half))
        walls = _corners()
        far_from_track = distance_to_path(center, np.vstack([track, track[:1]])) > radius + CLEARANCE_M
        far_from_walls = distance_to_path(center, np.vstack([walls, walls[:1]])) > radius + CLEARANCE_M
        apart = all(float(np.hypot(*(center - other.mean(axis=0)))) > 0.8 for other in boxes)
        off_the_middle = float(np.hypot(*(center - MIDDLE_M))) > 0.8
        if not (far_from_track and far_from_walls and apart and off_the_middle and _inside(center, walls)):
            continue
        turn = Pose2(float(center[0]), float(center[1]), float(rng.uniform(0.0, math.pi)))
        boxes.append(in_map(turn, half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])))
    return boxes


def distance_to_path(point: np.ndarray, path: np.ndarray) -> float:
    """Of a point to the nearest segment."""
    a, along = path[:-1], np.diff(path, axis=0)
    t = np.clip(((point - a) * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
    return float(np.hypot(*(a + t[:, None] * along - point).T).min())


def _inside(point: np.ndarray, corners: np.ndarray) -> bool:
    """By the number of walls to its right."""
    a, b = corners, np.roll(corners, -1, axis=0)
    spans = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = a[:, 0] + (point[1] - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return bool((spans & (x > point[0])).sum() % 2)


def uhg_08lx() -> Sensor:
    """270 degrees, 8 m. The noise it states is the standard deviation of what it does."""
    return make_fan(
        beams=BEAMS,
        first_rad=-math.radians(STEP_DEG) * (BEAMS - 1) / 2,
        step_rad=math.radians(STEP_DEG),
        range_min_m=RANGE_MIN_M,
        range_max_m=RANGE_MAX_M,
        range_noise_m=NOISE_M / math.sqrt(3.0),
        name="UHG-08LX",
    )


def read_scans(
    room: Room, poses: Sequence[Pose2], rng: np.random.Generator, period_s: float, blockers: Sequence = ()
) -> list[Scan]:
    """What the scanner reads at each pose; blockers[i]: (x, y, radius) of discs, in the first frame."""
    sensor = uhg_08lx()
    exact = simulate_ranges(room.map, sensor, list(poses)).astype(float)
    bearings = np.radians(STEP_DEG) * (np.arange(BEAMS) - (BEAMS - 1) / 2)
    for ranges, pose, discs in zip(exact, poses, blockers, strict=False):
        for disc in discs:
            np.minimum(ranges, _range_to_disc(pose, bearings, disc), out=ranges)
    return [
        Scan(sensor, noisy, stamp_s=i * period_s)
        for i, noisy in enumerate(_noisy(exact, rng).astype(np.float32))
    ]


def _range_to_disc(pose: Pose2, bearings: np.ndarray, disc: Sequence[float]) -> np.ndarray:
    x, y, radius = disc
    dx, dy = x - pose.x_m, y - pose.y_m
    c, s = np.cos(bearings + pose.theta_rad), np.sin(bearings + pose.theta_rad)
    along, across = c * dx + s * dy, c * dy - s * dx
    inside = radius**2 - across**2
    near = along - np.sqrt(np.maximum(inside, 0.0))
    return np.where((inside > 0.0) & (near > 0.0), near, np.inf)


def _noisy(exact: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Uniform; what lies beyond the range is the sensor's maximum."""
    most = np.where(exact < NEAR_M, NOISE_NEAR * exact, NOISE_M)
    with np.errstate(invalid="ignore"):
        noisy = exact + most * rng.uniform(-1.0, 1.0, exact.shape)
    return np.where(exact >= RANGE_MAX_M, RANGE_MAX_M, noisy)


def straight(step_m: float, steps: int) -> list[Pose2]:
    """Forward and back, the first pose included."""
    there = [Pose2(step_m * k, 0.0, 0.0) for k in range(steps + 1)]
    return [*there, *there[-2::-1]]


def turn(angle_rad: float, steps: int) -> list[Pose2]:
    """On the spot; negative is clockwise."""
    return [Pose2(0.0, 0.0, angle_rad * k / steps) for k in range(steps + 1)]


def along_track(room: Room, step_m: float, step_rad: float) -> list[Pose2]:
    """Once around: straight from corner to corner, turned on the spot there; in the first pose's frame."""
    poses = [room.T_room_start]
    for corner in [*room.track[1:], room.track[0]]:
        here = poses[-1]
        heading = math.atan2(corner[1] - here.y_m, corner[0] - here.x_m)
        by = math.remainder(heading - here.theta_rad, 2.0 * math.pi)
        turns = max(1, math.ceil(abs(by) / step_rad - 1e-6))
        poses += [Pose2(here.x_m, here.y_m, here.theta_rad + by * k / turns) for k in range(1, turns + 1)]
        length = math.hypot(corner[0] - here.x_m, corner[1] - here.y_m)
        steps = max(1, math.ceil(length / step_m))
        for k in range(1, steps + 1):
            t = k / steps
            poses.append(
                Pose2(here.x_m + t * (corner[0] - here.x_m), here.y_m + t * (corner[1] - here.y_m), heading)
            )
    to_start = room.T_room_start.inverse()
    return [to_start * pose for pose in poses]
