"""Willow Garage: a map that others made, 1,080 beams, people in the way; seeded poses are the truth."""

from __future__ import annotations

import math
from collections import deque
from pathlib import Path

import landfall
import numpy as np

MAP = "turtlebot_willow-2010-02-18-0.10.yaml"
POSES = 1000
SEED = 1
PEOPLE_SHARE = 0.1  # of the beams end at somebody, anywhere on their way
RIGHT_M, RIGHT_RAD = 0.25, math.radians(3.0)


def willow_garage(folder: Path, every: int) -> dict:
    """Each pose's scan alone, no prior, one after the other with all threads."""
    building = landfall.load_map(folder / MAP)
    building.prepare()
    rng = np.random.default_rng(SEED)
    poses = _poses(building.grid, rng)
    scans = _scans(building, poses, rng)
    results = [landfall.search(building, None, scan) for scan in scans[::every]]
    right = [_is_right(result, pose) for result, pose in zip(results, poses[::every], strict=True)]
    found = [result.verdict == "found" for result in results]
    search_ms = [result.times.total_ms for result in results]
    return {
        "asked": len(results),
        "success_rate": float(np.mean(right)),
        "right_that_are_found": float(np.mean(found, where=right)),
        "median_ms": float(np.median(search_ms)),
        "p95_ms": float(np.percentile(search_ms, 95)),
    }


def _poses(grid: landfall.GridMap, rng: np.random.Generator) -> np.ndarray:
    """[pose][x_m, y_m, theta_rad] in the map's frame, in its largest connected free area."""
    cells = _largest_area(np.asarray(grid.cells).reshape(grid.height_cells, grid.width_cells) == 0)
    picked = cells[rng.integers(0, len(cells), POSES)]
    x_m, y_m = ((picked[:, ::-1] + rng.random((POSES, 2))) * grid.resolution_m).T
    T_map_grid = grid.T_map_grid
    c, s = math.cos(T_map_grid.theta_rad), math.sin(T_map_grid.theta_rad)
    theta_rad = rng.uniform(-math.pi, math.pi, POSES)
    return np.column_stack(
        [T_map_grid.x_m + c * x_m - s * y_m, T_map_grid.y_m + s * x_m + c * y_m, theta_rad]
    )


def _largest_area(free: np.ndarray) -> np.ndarray:
    """[cell][row, col] of the largest 4-connected set of free cells."""
    unseen = np.pad(free, 1)
    largest: list[tuple[int, int]] = []
    for start in np.argwhere(unseen):
        if not unseen[tuple(start)]:
            continue
        unseen[tuple(start)] = False
        area, front = [], deque([(int(start[0]), int(start[1]))])
        while front:
            row, col = front.popleft()
            area.append((row - 1, col - 1))
            for beside in ((row + 1, col), (row - 1, col), (row, col + 1), (row, col - 1)):
                if unseen[beside]:
                    unseen[beside] = False
                    front.append(beside)
        largest = max(largest, area, key=len)
    return np.array(largest)


def _scans(
    building: landfall.PreparedMap, poses: np.ndarray, rng: np.random.Generator
) -> list[landfall.Scan]:
    sensor = landfall.make_fan(
        1080, -math.radians(135.0), math.radians(270.0) / 1079, range_max_m=30.0, range_noise_m=0.02
    )
    ranges_m = np.array([scan.ranges_m for scan in landfall.simulate(building, sensor, poses, seed=SEED)])
    blocked = rng.random(ranges_m.shape) < PEOPLE_SHARE
    nearer = np.minimum(ranges_m, 30.0) * rng.uniform(0.1, 0.9, ranges_m.shape)
    return landfall.make_scans(sensor, np.where(blocked, nearer, ranges_m).astype(np.float32))


def _is_right(result: landfall.SearchResult, pose: np.ndarray) -> bool:
    if not result.hypotheses:
        return False
    T_map_robot = result.hypotheses[0].T_map_robot
    turn_rad = math.remainder(T_map_robot.theta_rad - pose[2], 2.0 * math.pi)
    return (
        math.hypot(T_map_robot.x_m - pose[0], T_map_robot.y_m - pose[1]) <= RIGHT_M
        and abs(turn_rad) <= RIGHT_RAD
    )
