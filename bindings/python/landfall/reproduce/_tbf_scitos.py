"""A ring of 24 sonars without poses: its motion from the map that grows by TBF while it is driven.

Every fifth scan is matched, alone, by method `fft` to the map of those before it, near where constant motion
leads. There is no truth. What can be seen: how well the laps agree. Scans of different laps whose readings
are nearly the same were taken at nearly the same place; how far apart are their poses? And the readings
repeat after every lap, whatever the poses: is that how often the recovered robot turned?
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from landfall._landfall import (
    GridMap,
    Pose2,
    PreparedMap,
    Scan,
    Window,
    angle_distance,
    map_by_triangulation,
    map_of_end_points,
    translation_distance,
)
from landfall.logs import load_log
from landfall.progress import progress_bar
from landfall.reproduce._tbf_real import data_folder
from landfall.searching import search

EVERY = 5  # scans
REMAP = 4  # matched scans from one map to the next; each, at first
FEW_CELLS = 60  # of the first triangulated map: below, the readings' end points are the map
SEARCH_M, SEARCH_RAD = 0.2, math.radians(20.0)
STEP_RAD = math.radians(1.0)
MARGIN_M = 1.5
FIELD_SIGMA_M = 0.1
LAP_APART = 150  # matched scans
LEAST_LAP, LAG_STEP = 40, 8  # of the search for the lap's length
ALIKE_M = 0.03  # median difference of two scans' readings


def scitos24(out: Path, scans: int | None = None) -> dict | None:
    """Of the first `scans` scans, or all; None where the log is not there."""
    path = data_folder() / "sonar" / "scitos24.csv.gz"
    if not path.exists():
        return None
    located = recover_motion(load_log(path).scans[:scans])
    poses = [scan.T_map_robot or Pose2() for scan in located]
    result: dict = agreement(located, poses)
    result["scans"] = len(located)
    headings_rad = np.unwrap([pose.theta_rad for pose in poses])
    result["turns"] = float(abs(headings_rad[-1] - headings_rad[0]) / (2.0 * math.pi))
    period = lap_period(located)
    result["laps_by_readings"] = len(located) / period if period else None
    result["driven_m"] = sum(translation_distance(a, b) for a, b in itertools.pairwise(poses))
    result["pictures"] = [str(_draw(located, poses, out))]
    return result


def recover_motion(scans: list[Scan]) -> list[Scan]:
    """Every fifth scan with the pose that it was given, the first at the origin."""
    located: list[Scan] = []
    pose, step = Pose2(), Pose2()
    map: PreparedMap | None = None
    for scan in _with_progress(scans[::EVERY]):
        if len(located) < 3 * REMAP or len(located) % REMAP == 0:
            map = _map_of(located) if located else None
        if map is not None:
            before, pose = pose, _match(map, scan, pose * step)
            step = before.inverse() * pose
        located.append(Scan(scan.sensor, scan.ranges_m.copy(), scan.stamp_s, None, pose))
    return located


def _with_progress(scans: list[Scan]) -> Iterator[Scan]:
    with progress_bar() as bar:
        yield from bar.track(scans, description="scitos24")


def _map_of(located: list[Scan]) -> PreparedMap:
    grid = map_by_triangulation(located, margin_m=MARGIN_M).map
    if (grid.cells == 1).sum() < FEW_CELLS:
        grid = map_of_end_points(located, margin_m=MARGIN_M)
    cells = np.where(grid.cells == 2, 0, grid.cells).astype(np.uint8)  # it may go where it has not been
    return PreparedMap(GridMap(cells, grid.resolution_m, grid.T_map_grid), field_sigma_m=FIELD_SIGMA_M)


def _match(map: PreparedMap, scan: Scan, expected: Pose2) -> Pose2:
    prior = Window(expected, SEARCH_M, SEARCH_M, SEARCH_RAD)
    result = search(map, prior, scan, method="fft", rotation_step_rad=STEP_RAD)
    return result.hypotheses[0].T_map_robot if result.hypotheses else expected


def agreement(located: list[Scan], poses: list[Pose2]) -> dict[str, float]:
    """How far apart the poses of scans of different laps are that read alike."""
    readings = np.array([scan.ranges_m for scan in located], dtype=float)
    off_m, off_rad = [], []
    for i, row in enumerate(readings):
        differences = np.median(np.abs(readings[: max(0, i - LAP_APART)] - row), axis=1)
        if len(differences) and differences.min() < ALIKE_M:
            other = poses[int(np.argmin(differences))]
            off_m.append(translation_distance(poses[i], other))
            off_rad.append(angle_distance(poses[i].theta_rad, other.theta_rad))
    if not off_m:
        return {"pairs": 0.0}
    return {
        "pairs": float(len(off_m)),
        "median_off_m": float(np.median(off_m)),
        "p90_off_m": float(np.percentile(off_m, 90)),
        "median_off_deg": math.degrees(float(np.median(off_rad))),
        "p90_off_deg": math.degrees(float(np.percentile(off_rad, 90))),
        "median_of_any_two_m": _median_distance(poses),
    }


def lap_period(located: list[Scan]) -> int | None:
    """After how many scans the readings first repeat, whatever the poses; None: too few scans.

    The first of the lags that fit within twice the best one's misfit: several laps fit as well as one.
    """
    readings = np.array([scan.ranges_m for scan in located], dtype=float)
    lags = range(LEAST_LAP, len(readings) // 2, LAG_STEP)
    if not lags:
        return None
    misfit = np.array([_difference_after(readings, lag) for lag in lags])
    fits = misfit <= 2.0 * misfit.min()
    first = int(np.argmax(fits))
    dip = first + int(np.argmin(np.append(fits[first:], False)))
    return lags[first + int(np.argmin(misfit[first:dip]))]


def _difference_after(readings: np.ndarray, lag: int) -> float:
    """Median over scans of how unlike the one is that is most alike of those about `lag` later."""
    starts = len(readings) - lag - LAG_STEP
    nearest = np.full(starts, np.inf)
    for later in range(lag - LAG_STEP, lag + LAG_STEP + 1):
        differences = np.abs(readings[later : later + starts] - readings[:starts])
        nearest = np.minimum(nearest, np.median(differences, axis=1))
    return float(np.median(nearest))


def _median_distance(poses: list[Pose2]) -> float:
    """Of any two poses: what chance would give."""
    x, y, _ = np.array([list(pose) for pose in poses]).T
    return float(np.median(np.hypot(x[:, None] - x, y[:, None] - y)))


def _draw(located: list[Scan], poses: list[Pose2], out: Path) -> Path:
    from landfall.reproduce._tbf_pictures import draw_maps

    path = out / "tbf_scitos24.png"
    maps = {
        "scitos24: raw end points at recovered poses": map_of_end_points(located),
        "TBF at the same poses": map_by_triangulation(located).map,
    }
    draw_maps(maps, np.array([list(pose) for pose in poses]), path)
    return path
