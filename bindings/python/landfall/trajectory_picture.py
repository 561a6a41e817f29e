"""All best poses of a log on their maps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from landfall._landfall import PreparedMap
from landfall.pictures import (
    VERDICT_COLORS,
    Box,
    arrow_length_m,
    draw_map,
    draw_scale,
    known_box,
    legend_below,
    save_figure,
)
from landfall.relocalization import Answers

LONGER_SIDE_IN = 11.0


def draw_trajectory(maps: Sequence[PreparedMap], answers: Answers, path: Path) -> None:
    """Every query's best pose, coloured by verdict, on each map that answers lie on."""
    used = sorted({i for i, pose in zip(answers.map_indices, answers.poses, strict=True) if pose}) or [0]
    boxes = [known_box(maps[i].grid) for i in used]
    cols = math.ceil(math.sqrt(len(used)))
    rows = math.ceil(len(used) / cols)
    width, height = _panel_size(boxes[0], LONGER_SIDE_IN / math.sqrt(cols))
    figure = Figure(figsize=(width * cols, height * rows), layout="constrained")
    headline = _headline(answers)
    figure.suptitle(f"{maps[used[0]].name}: {headline}" if len(used) == 1 else headline, fontsize=13)
    panels = figure.subplots(rows, cols, squeeze=False).ravel()
    for spare in panels[len(used) :]:
        spare.set_axis_off()
    for axes, map_index, box in zip(panels, used, boxes, strict=False):
        draw_map(axes, maps[map_index].grid, box, width)
        _draw_verdicts(axes, answers, map_index)
        draw_scale(axes)
        if len(used) > 1:
            axes.set_title(maps[map_index].name, fontsize=11)
    save_figure(figure, path)


def _headline(answers: Answers) -> str:
    verdicts = ", ".join(f"{answers.verdicts.count(verdict)} {verdict}" for verdict in VERDICT_COLORS)
    homeless = sum(pose is None for pose in answers.poses)
    text = f"{len(answers.queries)} queries: {verdicts}"
    return text + (f"; {homeless} without a pose are not drawn" if homeless else "")


def _panel_size(box: Box, longer_side_in: float) -> tuple[float, float]:
    """Inches: the box's shape, with room for title and legend."""
    scale = longer_side_in / max(box[1] - box[0], box[3] - box[2])
    return max((box[1] - box[0]) * scale, 5.0), max((box[3] - box[2]) * scale, 4.0) + 0.9


def _draw_verdicts(axes: Axes, answers: Answers, map_index: int) -> None:
    """Dots with heading ticks, the sure ones drawn first; a thin line where odometry ties them together."""
    if answers.tied:
        path = [
            (pose.x_m, pose.y_m) if pose is not None and index == map_index else (math.nan, math.nan)
            for pose, index in zip(answers.poses, answers.map_indices, strict=True)
        ]
        axes.plot(*np.array(path).reshape(-1, 2).T, color="#5b6770", linewidth=0.6, alpha=0.6, zorder=2)
    tick_m = 0.4 * arrow_length_m(axes)
    for verdict, color in VERDICT_COLORS.items():
        poses = [
            pose
            for pose, given, index in zip(answers.poses, answers.verdicts, answers.map_indices, strict=True)
            if pose is not None and given == verdict and index == map_index
        ]
        if not poses:
            continue
        xyt = np.array(poses)
        axes.quiver(
            xyt[:, 0],
            xyt[:, 1],
            tick_m * np.cos(xyt[:, 2]),
            tick_m * np.sin(xyt[:, 2]),
            color=color,
            angles="xy",
            scale_units="xy",
            scale=1,
            width=0.002,
            headwidth=0,
            headlength=0,
            headaxislength=0,
        )
        label = f"{verdict}: {len(poses)}"
        axes.scatter(xyt[:, 0], xyt[:, 1], s=14, color=color, linewidths=0, label=label, zorder=3)
    if axes.get_legend_handles_labels()[0]:
        legend_below(axes, 4)
