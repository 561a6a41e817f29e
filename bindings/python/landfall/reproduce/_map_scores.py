"""How much of a building's walls a map found, and what it drew where no wall is."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from landfall._landfall import GridMap, PreparedMap, make_fan, map_from_known_poses, simulate

NEAR_M = 0.1  # of an occupied cell's centre: found
ARTEFACT_M = 0.2  # of an occupied cell's centre to the nearest wall: farther is an artefact
SAMPLE_M = 0.02
RAYS = 1440
EVERY = 2  # poses


@dataclass
class Truth:
    """Walls (n, 4); points of those that could be seen; the floor that could be."""

    walls: np.ndarray
    visible_points: np.ndarray  # SAMPLE_M apart along the walls
    points: np.ndarray  # of all walls
    free_m2: float


def make_truth(map: PreparedMap, T_map_robot: np.ndarray, range_max_m: float) -> Truth:
    """What lies in line of sight within range_max_m of any pose of the drive, as a perfect laser shows it."""
    laser = make_fan(RAYS, 0.0, 2.0 * math.pi / RAYS, range_max_m=range_max_m)
    scans = simulate(map, laser, T_map_robot[::EVERY], noise=False)
    for scan in scans:
        scan.ranges_m[scan.ranges_m < range_max_m] += 1e-3  # into the cell whose face was hit
    seen = map_from_known_poses(scans)
    walls = np.asarray(map.walls.walls)
    points = _along(walls)
    visible = points[found(seen, points, seen.resolution_m)]
    free_m2 = float((seen.cells == 0).sum()) * seen.resolution_m**2
    return Truth(walls, visible, points, free_m2)


def _along(walls: np.ndarray) -> np.ndarray:
    """(points, 2) in the middle of pieces of about SAMPLE_M."""
    pieces = []
    for x1, y1, x2, y2 in walls:
        count = max(1, round(math.hypot(x2 - x1, y2 - y1) / SAMPLE_M))
        share = (np.arange(count)[:, None] + 0.5) / count
        pieces.append(np.array([x1, y1]) + share * np.array([x2 - x1, y2 - y1]))
    return np.concatenate(pieces)


def found(grid: GridMap, points: np.ndarray, near_m: float) -> np.ndarray:
    """Per point whether an occupied cell's centre is within near_m."""
    cell_m, origin = grid.resolution_m, grid.T_map_grid
    reach = math.ceil(near_m / cell_m) + 1
    occupied = np.pad(grid.cells == 1, reach)
    col = np.floor((points[:, 0] - origin.x_m) / cell_m).astype(int)
    row = np.floor((points[:, 1] - origin.y_m) / cell_m).astype(int)
    inside = (col >= 0) & (col < grid.width_cells) & (row >= 0) & (row < grid.height_cells)
    near = np.zeros(len(points), dtype=bool)
    for down in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            x = origin.x_m + (col + right + 0.5) * cell_m - points[:, 0]
            y = origin.y_m + (row + down + 0.5) * cell_m - points[:, 1]
            at = occupied[np.where(inside, row + down + reach, 0), np.where(inside, col + right + reach, 0)]
            near |= inside & at & (np.hypot(x, y) <= near_m)
    return near


def occupied_points(grid: GridMap) -> np.ndarray:
    """(cells, 2): centres of occupied cells; the grid's axes are the map's."""
    rows, cols = np.nonzero(grid.cells == 1)
    origin = grid.T_map_grid
    return np.column_stack(
        [origin.x_m + (cols + 0.5) * grid.resolution_m, origin.y_m + (rows + 0.5) * grid.resolution_m]
    )


def wall_distance(points: np.ndarray, walls: np.ndarray) -> np.ndarray:
    """Of each point to the nearest wall."""
    nearest = np.full(len(points), np.inf)
    for x1, y1, x2, y2 in walls:
        start, along = np.array([x1, y1]), np.array([x2 - x1, y2 - y1])
        share = np.clip((points - start) @ along / (along @ along), 0.0, 1.0)
        nearest = np.minimum(nearest, np.hypot(*(points - start - share[:, None] * along).T))
    return nearest


def score(grid: GridMap, truth: Truth) -> dict[str, float]:
    """coverage: of the wall length that could be seen; coverage_of_all: of all walls of the building."""
    cells = occupied_points(grid)
    artefacts = int((wall_distance(cells, truth.walls) > ARTEFACT_M).sum())
    return {
        "coverage": float(found(grid, truth.visible_points, NEAR_M).mean()),
        "coverage_of_all": float(found(grid, truth.points, NEAR_M).mean()),
        "artefacts_per_m2": artefacts / truth.free_m2,
        "occupied_cells": float(len(cells)),
    }
