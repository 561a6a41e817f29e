"""A drive through a made-up building, as a robot would have recorded it. Everything follows from the seed."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np

from landfall._landfall import (
    Pose2,
    PreparedMap,
    Scan,
    Sensor,
    make_fan,
    simulate,
    translation_distance,
    wrap_angle,
)
from landfall.building import CORRIDOR_M, WIDTH_M, Building

STEP_M = 0.5


def laser(range_noise_m: float = 0.01) -> Sensor:
    """A scanner of 270 degrees at 1 degree, 0.15 m ahead of the robot's centre."""
    return make_fan(
        beams=271,
        first_rad=-0.75 * math.pi,
        step_rad=math.radians(1.0),
        T_robot_sensor=Pose2(0.15, 0.0, 0.0),
        range_max_m=25.0,
        range_noise_m=range_noise_m,
    )


def drive(building: Building, seed: int) -> list[Pose2]:
    """T_map_robot every STEP_M along the two corridors, with a visit to every second room."""
    rng = np.random.default_rng((seed, 1))
    lower_y, upper_y = building.corridors_y_m
    end_x = CORRIDOR_M / 2
    corners = [(end_x, lower_y)]
    for corridor_y, rightwards in ((lower_y, True), (upper_y, False)):
        corners += _visits(building, rng, corridor_y, rightwards)
        last_x = WIDTH_M - end_x if rightwards else end_x
        corners += [(last_x, corridor_y)]
        corners += [(last_x, upper_y if rightwards else lower_y)]
    return list(_poses_along(corners, rng))


def _visits(
    building: Building, rng: np.random.Generator, corridor_y: float, rightwards: bool
) -> Iterator[tuple[float, float]]:
    """Out of the corridor, through a door, to the room's centre and back, in the order of driving."""
    beside = [r for r in building.rooms if abs(r.door_y_m - corridor_y) < CORRIDOR_M]
    for room in sorted(beside, key=lambda r: r.door_x_m if rightwards else -r.door_x_m):
        if rng.random() < 0.5:
            continue
        inside_y = room.door_y_m + math.copysign(1.0, room.door_y_m - corridor_y)
        at_door = [(room.door_x_m, corridor_y), (room.door_x_m, inside_y)]
        yield from (*at_door, room.center, *reversed(at_door))


def _poses_along(corners: Sequence[tuple[float, float]], rng: np.random.Generator) -> Iterator[Pose2]:
    """A pose every STEP_M on each leg, weaving a little."""
    for (x0, y0), (x1, y1) in itertools.pairwise(corners):
        length = math.hypot(x1 - x0, y1 - y0)
        heading = math.atan2(y1 - y0, x1 - x0)
        for k in range(int(length / STEP_M)):
            share = k * STEP_M / length
            dx, dy = rng.normal(0.0, 0.03, 2)
            theta = wrap_angle(heading + float(rng.normal(0.0, 0.08)))
            yield Pose2(x0 + share * (x1 - x0) + float(dx), y0 + share * (y1 - y0) + float(dy), theta)


def record(map: PreparedMap, T_map_robot: Sequence[Pose2], seed: int, people: float = 0.1) -> list[Scan]:
    """The drive as a log: noisy ranges, a share of the beams ended early by people, drifting odometry."""
    rng = np.random.default_rng((seed, 2))
    scans = simulate(map, laser(), T_map_robot, seed=seed)
    odometry = _odometry(T_map_robot, rng)
    for i, scan in enumerate(scans):
        scan.stamp_s = float(i)
        scan.T_odom_robot = odometry[i]
        _add_people(scan.ranges_m, people, rng)
    return scans


def _add_people(ranges_m: np.ndarray, share: float, rng: np.random.Generator) -> None:
    """Runs of neighbouring beams that end at a body, until `share` of the beams do."""
    hit = np.zeros(len(ranges_m), dtype=bool)
    while hit.mean() < share:
        distance_m = float(rng.uniform(0.6, 5.0))
        half = max(round(math.degrees(0.2 / distance_m)), 1)  # a body is 0.4 m wide; a beam per degree
        center = int(rng.integers(len(ranges_m)))
        body = slice(max(center - half, 0), center + half + 1)
        blocked = ranges_m[body] > distance_m
        ranges_m[body][blocked] = distance_m + rng.normal(0.0, 0.02, int(blocked.sum()))
        hit[body] = True


def _odometry(T_map_robot: Sequence[Pose2], rng: np.random.Generator) -> list[Pose2]:
    """Increments of the true poses with 3 % and 0.01 rad per metre of noise."""
    T_odom_robot = [Pose2()]
    for before, after in itertools.pairwise(T_map_robot):
        step = before.inverse() * after
        driven_m = translation_distance(before, after)
        scale = 1.0 + float(rng.normal(0.0, 0.03))
        turn = step.theta_rad + float(rng.normal(0.0, 0.01 * driven_m))
        T_odom_robot.append(T_odom_robot[-1] * Pose2(step.x_m * scale, step.y_m * scale, turn))
    return T_odom_robot
