"""Which echoes the map explains from a pose: the verification's judgement, beam by beam, for pictures."""

from __future__ import annotations

import numpy as np

from landfall._landfall import GridMap, Pose2, PreparedMap, Scan, simulate_ranges

EXPLAINED, SHORT, LONG = 0, 1, 2  # as the map says; before a wall; behind one, or where the map has none


def judge_echoes(map: PreparedMap, scan: Scan, T_map_robot: Pose2, points_map: np.ndarray) -> np.ndarray:
    """(echoes,) of EXPLAINED, SHORT, LONG, in the order of scan.points_robot().

    The measured range against the simulated ones of the beam and its two neighbours, within three sigma and
    two cells. points_map: (echoes, 2), where the echoes lie on the map: in a wall is as the map says.
    """
    beams = scan.sensor.beams
    measured_m = scan.ranges_m.astype(float)
    least_m = np.array([beam.range_min_m for beam in beams])
    most_m = np.array([beam.range_max_m for beam in beams])
    echo = np.isfinite(measured_m) & (measured_m >= least_m) & (measured_m < most_m)
    tolerance_m = scan.sensor.range_noise_m + scan.sensor.range_noise_relative * measured_m
    tolerance_m = 3.0 * tolerance_m + 2.0 * map.grid.resolution_m
    off_m = _off_m(measured_m, simulate_ranges(map, scan.sensor, [T_map_robot])[0])
    judged = np.where(np.abs(off_m) <= tolerance_m, EXPLAINED, np.where(off_m < 0, SHORT, LONG))[echo]
    judged[in_walls(map.grid, points_map)] = EXPLAINED
    return judged


def in_walls(grid: GridMap, points_map: np.ndarray) -> np.ndarray:
    """(n,) whether each point of (n, 2), in the map frame, lies in an occupied cell."""
    x, y = (points_map - (grid.T_map_grid.x_m, grid.T_map_grid.y_m)).T
    c, s = np.cos(grid.T_map_grid.theta_rad), np.sin(grid.T_map_grid.theta_rad)
    cols = np.floor((c * x + s * y) / grid.resolution_m).astype(int)
    rows = np.floor((c * y - s * x) / grid.resolution_m).astype(int)
    inside = (rows >= 0) & (rows < grid.height_cells) & (cols >= 0) & (cols < grid.width_cells)
    found = np.zeros(len(points_map), dtype=bool)
    found[inside] = grid.cells[rows[inside], cols[inside]] == 1
    return found


def _off_m(measured_m: np.ndarray, simulated_m: np.ndarray) -> np.ndarray:
    """Measured less simulated range, of the three neighbours the one that fits best."""
    before, after = np.roll(simulated_m, 1), np.roll(simulated_m, -1)
    before[:1], after[-1:] = simulated_m[:1], simulated_m[-1:]
    off_m = measured_m - np.stack([simulated_m, before, after])
    return off_m[np.nan_to_num(np.abs(off_m), nan=np.inf).argmin(axis=0), np.arange(len(measured_m))]
