"""The paper's volume C and its maximum, as its experiments use them; and what happens where it wraps."""

from __future__ import annotations

import math

import numpy as np

from landfall._landfall import (
    GridMap,
    Pose2,
    PreparedMap,
    Scan,
    blurred_map,
    correlation_volume,
    raised_cosine_mask,
)

HEADINGS = 64
STEP_RAD = 2.0 * math.pi / HEADINGS
MASK_CELLS = 7
MASKS = 1  # of the environment alone


def correlate(map: PreparedMap, scan: Scan, masks: int = MASKS) -> np.ndarray:
    """C over heading, row, column. Masks: 1 blurs the environment, 2 the robot as well (the same as the
    environment twice)."""
    blurred = blurred_map(map.grid, raised_cosine_mask(MASK_CELLS), masks)
    return correlation_volume(map, scan, rotation_step_rad=STEP_RAD, values=blurred).scores


def correlate_wrapped(map: PreparedMap, scan: Scan, masks: int = MASKS) -> np.ndarray:
    """The same by transforms of the map's own size, as the paper has them: end points beyond the map's edge
    come back in at the other side."""
    blurred = blurred_map(map.grid, raised_cosine_mask(MASK_CELLS), masks)
    spectrum = np.fft.rfft2(blurred)
    height, width = blurred.shape
    volume = np.empty((HEADINGS, height, width), np.float32)
    points = scan.points_robot() / map.grid.resolution_m
    for k in range(HEADINGS):
        cos, sin = math.cos(k * STEP_RAD), math.sin(k * STEP_RAD)
        col = np.floor(points[:, 0] * cos - points[:, 1] * sin + 0.5).astype(int)
        row = np.floor(points[:, 0] * sin + points[:, 1] * cos + 0.5).astype(int)
        drawn = np.zeros(blurred.shape)
        np.add.at(drawn, (row % height, col % width), 1.0)
        volume[k] = np.fft.irfft2(spectrum * np.conj(np.fft.rfft2(drawn)), s=blurred.shape)
    return volume


def argmax(grid: GridMap, volume: np.ndarray) -> Pose2:
    """Equation 11, over the free cells."""
    free = np.where(grid.cells == 0, volume, -np.inf)
    heading, row, col = np.unravel_index(int(np.argmax(free)), free.shape)
    x_m, y_m = grid.center_of(int(row), int(col))
    return Pose2(x_m, y_m, int(heading) * 2.0 * math.pi / len(volume))


def cut_to_walls(grid: GridMap) -> GridMap:
    """The grid without what lies around its walls: where the paper's transforms wrap the most."""
    rows, cols = np.nonzero(grid.cells == 1)
    cut = grid.cells[rows.min() : rows.max() + 1, cols.min() : cols.max() + 1]
    x_m, y_m = cols.min() * grid.resolution_m, rows.min() * grid.resolution_m
    return GridMap(np.ascontiguousarray(cut), grid.resolution_m, (float(x_m), float(y_m), 0.0))
