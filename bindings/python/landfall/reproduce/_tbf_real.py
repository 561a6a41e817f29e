"""Real sonars: a drive along a corridor with odometry, mapped; how sharp its two walls come out."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np

from landfall._landfall import GridMap, Pose2
from landfall.logs import load_log
from landfall.reproduce._map_scores import occupied_points
from landfall.reproduce._sonar_maps import LABELS, make_maps

STRAIGHT_RAD = math.radians(8.0)  # of the first heading: the straight part of the drive
BESIDE_M = (0.6, 2.0)  # of the path: where its walls are
FIT_M = 0.25  # cells this near to the line so far make the next
WALL_M = 0.5  # cells this near count as the wall's, for its spread


def data_folder() -> Path:
    return Path(os.environ.get("LANDFALL_DATA", "../shared/data"))


def corridor8(out: Path) -> dict | None:
    """The four maps and how sharp they are; None where the log is not there."""
    path = data_folder() / "sonar" / "corridor8_ranges.txt"
    if not path.exists():
        return None
    scans = load_log(path).scans
    for scan in scans:
        scan.T_map_robot = scan.T_odom_robot
    poses = np.array([list(scan.T_odom_robot or Pose2()) for scan in scans])
    maps = make_maps(scans)
    fits = {name: wall_fit(grid, poses) for name, grid in maps.items()}
    result: dict = {name: fit.numbers() for name, fit in fits.items()}
    result["pictures"] = _draw(maps, fits, poses, out)
    return result


class WallFit:
    """Lines y = a + b x of the wall on the left and on the right, and the cells that they are of."""

    def __init__(self, cells: np.ndarray, poses: np.ndarray) -> None:
        self.span = float(poses[:, 0].min()), float(poses[:, 0].max())
        self.cells = cells[(cells[:, 0] > self.span[0]) & (cells[:, 0] < self.span[1])]
        path_y = np.interp(self.cells[:, 0], poses[:, 0], poses[:, 1])
        off = self.cells[:, 1] - path_y
        self.lines = [
            _fit(self.cells[(side * off > BESIDE_M[0]) & (side * off < BESIDE_M[1])]) for side in (1, -1)
        ]

    def numbers(self) -> dict[str, float]:
        """spread_m: root mean square of the cells across their wall; off_walls: share of cells on neither."""
        across = np.array([_across(self.cells, line) for line in self.lines])
        nearest = np.abs(across).min(axis=0)
        wall = nearest < WALL_M
        slopes = [math.atan(line[1]) for line in self.lines]
        length = self.span[1] - self.span[0]
        found = [
            len(np.unique(np.floor(self.cells[np.abs(row) < 0.1, 0] / 0.1))) * 0.1 / length for row in across
        ]
        return {
            "spread_m": float(np.sqrt((nearest[wall] ** 2).mean())),
            "off_walls": float((~wall).mean()),
            "parallel_deg": abs(math.degrees(slopes[0] - slopes[1])),
            "width_m": float(_across(np.array([[np.mean(self.span), 0.0]]), self.lines[1])[0])
            - float(_across(np.array([[np.mean(self.span), 0.0]]), self.lines[0])[0]),
            "walls_found": float(np.mean(found)),
        }

    def segments(self) -> np.ndarray:
        return np.array(
            [[self.span[0], a + b * self.span[0], self.span[1], a + b * self.span[1]] for a, b in self.lines]
        )


def wall_fit(grid: GridMap, poses: np.ndarray) -> WallFit:
    """The walls beside the straight beginning of a drive along x."""
    turned = np.abs(poses[:, 2] - poses[0, 2]) > STRAIGHT_RAD
    straight = poses[: int(np.argmax(turned))] if turned.any() else poses
    return WallFit(occupied_points(grid), straight[np.diff(straight[:, 0], prepend=-np.inf) > 0.0])


def _fit(cells: np.ndarray) -> tuple[float, float]:
    """Least squares over the cells near the line so far, from the most frequent y on."""
    counts, edges = np.histogram(cells[:, 1], bins=np.arange(-20.0, 20.0, 0.1))
    a, b = float(edges[int(np.argmax(counts))]) + 0.05, 0.0
    for _ in range(10):
        near = cells[np.abs(_across(cells, (a, b))) < FIT_M]
        b, a = (float(value) for value in np.polyfit(near[:, 0], near[:, 1], 1))
    return a, b


def _across(cells: np.ndarray, line: tuple[float, float]) -> np.ndarray:
    return (cells[:, 1] - line[0] - line[1] * cells[:, 0]) / math.hypot(1.0, line[1])


def _draw(maps: dict[str, GridMap], fits: dict[str, WallFit], poses: np.ndarray, out: Path) -> list[str]:
    from landfall.reproduce._sonar_maps import FOUR
    from landfall.reproduce._tbf_pictures import draw_maps

    path = out / "tbf_corridor8.png"
    lines = {LABELS[name]: fits[name].segments() for name in FOUR}
    draw_maps({LABELS[name]: maps[name] for name in FOUR}, poses, path, lines=lines)
    return [str(path)]


def sharpness_table(result: dict) -> list[list[str]]:
    rows = [
        [
            "map of corridor8",
            "spread across walls [cm]",
            "off both walls",
            "walls found",
            "angle between [deg]",
        ]
    ]
    for name, label in LABELS.items():
        fit = result[name]
        rows.append(
            [
                label,
                f"{100.0 * fit['spread_m']:.1f}",
                f"{100.0 * fit['off_walls']:.1f} %",
                f"{100.0 * fit['walls_found']:.1f} %",
                f"{fit['parallel_deg']:.2f}",
            ]
        )
    return rows
