"""Figures 7 to 13 of Okada & Fujimoto: maps in the paper's colours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from landfall._landfall import GridMap, Pose2
from landfall.map_pictures import draw_built_map
from landfall.pictures import Box, known_box, save_figure

LABELS = {"the swarm as published": "pso_raw", "landfall: swarm, refined": "pso"}
PANEL_IN = 4.6
TRUTH = "#1a9850"


def draw_maps(
    panels: Mapping[str, tuple[GridMap, Sequence[Pose2]]], truth: Sequence[Pose2], file: Path
) -> str:
    """Side by side, on one scale; the true path dashed."""
    box = _around([known_box(grid) for grid, _ in panels.values()])
    figure = _figure(len(panels), box)
    for axes, (title, (grid, path)) in zip(
        np.atleast_1d(figure.subplots(1, len(panels))), panels.items(), strict=True
    ):
        draw_built_map(axes, grid, path, box)
        xy = np.array([(pose.x_m, pose.y_m) for pose in truth])
        axes.plot(xy[:, 0], xy[:, 1], color=TRUTH, linewidth=1.0, linestyle="--", label="true path")
        axes.set_title(title, fontsize=11)
    axes.legend(loc="lower right", fontsize=8)
    save_figure(figure, file)
    return str(file)


def draw_moments(moments: Sequence[tuple[str, GridMap]], file: Path) -> str:
    """One map at several times."""
    box = _around([known_box(grid) for _, grid in moments])
    figure = _figure(len(moments), box)
    for axes, (title, grid) in zip(np.atleast_1d(figure.subplots(1, len(moments))), moments, strict=True):
        draw_built_map(axes, grid, [Pose2()], box)
        axes.set_title(title, fontsize=11)
    save_figure(figure, file)
    return str(file)


def _figure(panels: int, box: Box) -> Figure:
    height = PANEL_IN * (box[3] - box[2]) / (box[1] - box[0])
    return Figure(figsize=(PANEL_IN * panels, min(max(height, 2.5), 8.0) + 0.8), layout="constrained")


def _around(boxes: Sequence[Box]) -> Box:
    low, high = np.array(boxes).min(axis=0), np.array(boxes).max(axis=0)
    return float(low[0]), float(high[1]), float(low[2]), float(high[3])
