"""Maps of one drive, side by side."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from landfall._landfall import GridMap
from landfall.pictures import draw_map
from landfall.reproduce._map_scores import occupied_points

PANEL_IN = 7.5
DPI = 110
AROUND_M = 1.0
WALL_COLOR, PATH_COLOR, LINE_COLOR = "#d7263d", "#1f77b4", "#e68a00"


def draw_maps(
    maps: Mapping[str, GridMap],
    T_map_robot: np.ndarray,
    path: Path,
    walls: np.ndarray | None = None,
    lines: Mapping[str, np.ndarray] | None = None,
    cols: int = 2,
) -> None:
    """A panel per map, all of one extent. walls (n, 4): the truth, thin; lines: fitted, per map (n, 4)."""
    box = _box(maps, T_map_robot)
    rows = -(-len(maps) // cols)
    height = PANEL_IN * (box[3] - box[2]) / (box[1] - box[0])
    figure = Figure(figsize=(PANEL_IN * cols, rows * (height + 0.6) + 0.1), layout="constrained")
    panels = np.atleast_1d(figure.subplots(rows, cols)).ravel()
    for axes, (title, grid) in zip(panels, maps.items(), strict=False):
        draw_map(axes, grid, box, PANEL_IN)
        axes.plot(T_map_robot[:, 0], T_map_robot[:, 1], color=PATH_COLOR, linewidth=0.8)
        _add_segments(axes, walls, WALL_COLOR, 0.5)
        _add_segments(axes, (lines or {}).get(title), LINE_COLOR, 1.2)
        axes.set_title(title, fontsize=11)
    for axes in panels[len(maps) :]:
        axes.set_axis_off()
    part = path.with_name(f".{path.stem}.part{path.suffix}")
    figure.savefig(part, dpi=DPI, facecolor="white")
    part.replace(path)


def _box(maps: Mapping[str, GridMap], T_map_robot: np.ndarray) -> tuple[float, float, float, float]:
    """Holds the drive and nearly all that any map drew."""
    points = np.concatenate([T_map_robot[:, :2], *(occupied_points(grid) for grid in maps.values())])
    (x0, y0), (x1, y1) = np.percentile(points, [0.5, 99.5], axis=0)
    low, high = T_map_robot[:, :2].min(axis=0), T_map_robot[:, :2].max(axis=0)
    x0, y0, x1, y1 = min(x0, low[0]), min(y0, low[1]), max(x1, high[0]), max(y1, high[1])
    return float(x0) - AROUND_M, float(x1) + AROUND_M, float(y0) - AROUND_M, float(y1) + AROUND_M


def _add_segments(axes: Axes, segments: np.ndarray | None, color: str, width: float) -> None:
    if segments is not None:
        axes.add_collection(
            LineCollection(list(segments.reshape(-1, 2, 2)), colors=color, linewidths=width, zorder=4)
        )
