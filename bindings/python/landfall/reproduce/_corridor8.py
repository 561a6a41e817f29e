"""A real drive with eight sonars along a corridor (`sonar/corridor8`): one half maps, the other asks.

The drive is cut into stretches of 2 m. The map is made from every second one with its recorded poses; windows
of the stretches between are the questions, whose truth is the recorded pose. Each half asks the other's map.
"""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from landfall._landfall import (
    Beam,
    GridMap,
    Log,
    Pose2,
    Scan,
    Sensor,
    map_from_known_poses,
    merge,
    translation_distance,
)
from landfall.logs import load_log

STRETCH_M = 2.0
WINDOW_M = 1.0
RESOLUTION_M = 0.1
# Of a cone, 25 degrees wide, so much is drawn on the map, as rays: its echo comes from near the axis.
DRAWN_HALF_RAD, DRAWN_RAYS = math.radians(10.0), 9
# Farther off, an arc is too wide to draw walls with; a reading says that so much is free, echo or none.
DRAWN_RANGE_M = 3.0


@dataclass
class Half:
    """A map of every second stretch, and windows of the others with the pose of their last scan."""

    map: GridMap
    windows: list[Scan]
    T_map_robot: list[Pose2]


def data_folder() -> Path:
    """LANDFALL_DATA; shared/data beside the working directory's parent where that is not set."""
    return Path(os.environ.get("LANDFALL_DATA") or "../shared/data")


def load_corridor8() -> Log | None:
    """The drive; None where the data are not there."""
    path = data_folder() / "sonar" / "corridor8_ranges.txt"
    return load_log(path) if path.exists() else None


def make_halves(
    log: Log, *, stretch_m: float = STRETCH_M, window_m: float = WINDOW_M, every: int = 3
) -> list[Half]:
    """Mapped by the even stretches and asked by the odd ones, and the other way round.

    A window is the last window_m of the way at every n-th scan, within one stretch, as one composite scan.
    The first and the last stretch ask nothing: the map has no stretch on their other side.
    """
    scans = log.scans
    way_m = _way_m(scans)
    stretch = np.floor(way_m / stretch_m).astype(int)
    halves = []
    for parity in (0, 1):
        map = draw_map([scan for scan, k in zip(scans, stretch, strict=True) if k % 2 == parity])
        between = range(1, stretch[-1])
        lasts = [i for i in range(0, len(scans), every) if stretch[i] % 2 != parity and stretch[i] in between]
        firsts = [int(np.searchsorted(way_m, way_m[i] - window_m)) for i in lasts]
        asked = [
            (first, last)
            for first, last in zip(firsts, lasts, strict=True)
            if stretch[first] == stretch[last]
        ]
        windows = [merge(scans[first : last + 1]) for first, last in asked]
        halves.append(Half(map, windows, [_pose(scans[last]) for _, last in asked]))
    return halves


def draw_map(scans: Sequence[Scan]) -> GridMap:
    """Occupancy from the recorded poses, each cone drawn as a fan of rays that all read its range."""
    sensor = scans[0].sensor
    turns = np.linspace(-DRAWN_HALF_RAD, DRAWN_HALF_RAD, DRAWN_RAYS)
    mounts = [(beam.T_robot_beam, beam.range_max_m) for beam in sensor.beams]
    rays = Sensor(
        [
            Beam(Pose2(mount.x_m, mount.y_m, mount.theta_rad + turn), range_max_m=range_max_m)
            for mount, range_max_m in mounts
            for turn in turns
        ],
        f"{sensor.name} as rays",
    )
    limits_m = np.array([range_max_m for _, range_max_m in mounts])
    fans = []
    for scan in scans:
        # A reading just below the limit frees what lies before it; one at the limit would free nothing.
        ranges_m = np.minimum(scan.ranges_m, 0.99 * limits_m)
        fans.append(Scan(rays, np.repeat(ranges_m, DRAWN_RAYS), T_map_robot=_pose(scan)))
    return map_from_known_poses(fans, resolution_m=RESOLUTION_M, range_max_m=DRAWN_RANGE_M)


def _pose(scan: Scan) -> Pose2:
    assert scan.T_odom_robot is not None
    return scan.T_odom_robot


def _way_m(scans: Sequence[Scan]) -> np.ndarray:
    """How far the robot had driven at each scan."""
    steps = [translation_distance(_pose(a), _pose(b)) for a, b in itertools.pairwise(scans)]
    return np.concatenate([[0.0], np.cumsum(steps)])
