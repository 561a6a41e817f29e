"""What the experiments measure: poses beside the truth, sides of the room, what people leave behind."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from landfall._landfall import GridMap, Pose2, Scan, angle_distance, match_scans
from landfall.pictures import in_map
from landfall.reproduce._wheelchair_room import FIRST_CORNER, SIDES_M, Room

OFF_WALL_M = 0.08  # cells that belong to a wall
OFF_CORNER_M = 0.07  # where another wall's cells mix in
LEAST_CELLS = 5
TRACE_M = 0.12  # a cell so far from every wall is somebody's trace
NEAR_M = 2.0
SIDE_MM, SIDE_PERCENT = 20.0, 1.0  # a side is right within the larger


def off_mm(estimate: Pose2, truth: Pose2) -> float:
    return 1000.0 * math.hypot(estimate.x_m - truth.x_m, estimate.y_m - truth.y_m)


def off_deg(estimate: Pose2, truth: Pose2) -> float:
    return math.degrees(angle_distance(estimate.theta_rad, truth.theta_rad))


def chain(scans: Sequence[Scan], matcher: str) -> list[Pose2]:
    """The conventional way: each scan beside the one before it, from where that was."""
    poses = [Pose2()]
    for i in range(1, len(scans)):
        poses.append(poses[-1] * match_scans(scans[i - 1], scans[i], matcher=matcher))
    return poses


def occupied_centers(grid: GridMap) -> np.ndarray:
    rows, cols = np.nonzero(grid.cells == 1)
    return in_map(grid.T_map_grid, (np.column_stack([cols, rows]) + 0.5) * grid.resolution_m)


def measured_sides(grid: GridMap, room: Room) -> list[float]:
    """S1 to S9 in metres: each between the lines of its neighbours; NaN where a wall has no line."""
    cells = occupied_centers(grid)
    corners = in_map(room.T_room_start.inverse(), room.corners)
    lines = [_line(cells, corners[k], corners[(k + 1) % len(corners)]) for k in range(len(corners))]
    lengths = []
    for first in FIRST_CORNER:
        before, side, after = (lines[(first + d) % len(lines)] for d in (-1, 0, 1))
        a, b = _crossing(before, side), _crossing(side, after)
        lengths.append(float(np.hypot(*(b - a))))
    return lengths


def _line(cells: np.ndarray, a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, float]:
    """(normal, offset) of the line through the occupied cells of a wall, least squares."""
    length = float(np.hypot(*(b - a)))
    along = (b - a) / length
    normal = np.array([-along[1], along[0]])
    place, off = (cells - a) @ along, (cells - a) @ normal
    mine = cells[(np.abs(off) < OFF_WALL_M) & (place > OFF_CORNER_M) & (place < length - OFF_CORNER_M)]
    if len(mine) < LEAST_CELLS:
        return np.full(2, math.nan), math.nan
    mean = mine.mean(axis=0)
    across = np.linalg.svd(mine - mean, full_matrices=False)[2][1]
    return across, float(across @ mean)


def _crossing(a: tuple[np.ndarray, float], b: tuple[np.ndarray, float]) -> np.ndarray:
    normals = np.array([a[0], b[0]])
    if not np.isfinite(normals).all():
        return np.full(2, math.nan)
    return np.linalg.solve(normals, np.array([a[1], b[1]]))


def side_errors_mm(lengths: Sequence[float]) -> list[float]:
    return [1000.0 * (length - true) for length, true in zip(lengths, SIDES_M, strict=True)]


def sides_right(errors_mm: Sequence[float]) -> list[bool]:
    """A side without a line is not."""
    return [
        abs(error) <= max(SIDE_MM, SIDE_PERCENT / 100.0 * 1000.0 * true)
        for error, true in zip(errors_mm, SIDES_M, strict=True)
    ]


def traces(grid: GridMap, room: Room) -> tuple[int, int]:
    """Occupied cells that no wall explains: within NEAR_M of the robot's first pose, and farther."""
    cells = occupied_centers(grid)
    walls = room.map.walls.walls
    off = np.min([_distance(cells, wall[:2], wall[2:]) for wall in walls], axis=0)
    near = np.hypot(cells[:, 0], cells[:, 1]) <= NEAR_M
    return int(((off > TRACE_M) & near).sum()), int(((off > TRACE_M) & ~near).sum())


def _distance(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    along = b - a
    t = np.clip((points - a) @ along / (along @ along), 0.0, 1.0)
    return np.hypot(*(points - a - t[:, None] * along).T)


def lost_cells(before: GridMap, after: GridMap) -> int:
    """Cells that were occupied and are not any more."""
    had, has = ({tuple(cell) for cell in _cell_numbers(grid)} for grid in (before, after))
    return len(had - has)


def _cell_numbers(grid: GridMap) -> np.ndarray:
    """Of occupied cells, counted from the frame's origin: the corner is a multiple of the resolution."""
    first = np.round([grid.T_map_grid.x_m / grid.resolution_m, grid.T_map_grid.y_m / grid.resolution_m])
    rows, cols = np.nonzero(grid.cells == 1)
    return np.column_stack([cols, rows]) + first.astype(int)
