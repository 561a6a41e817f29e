"""Pictures: one answer on its map with its rivals, and all best poses of a log."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.transforms import Affine2D

from landfall._landfall import GridMap, Hypothesis, Pose2, PreparedMap, Scan, SearchResult
from landfall.relocalization import Answers

UNKNOWN_COLOR = "#d9dde1"
MAP_COLORS = ListedColormap(["#ffffff", "#20252b", UNKNOWN_COLOR])  # free, occupied, unknown
BEST_COLOR = "#d7263d"
RIVAL_COLORS = ("#1f77b4", "#e68a00", "#7b3fa0", "#2e8b57", "#8c564b")
VERDICT_COLORS = {"found": "#1a9850", "ambiguous": "#f39c12", "lost": "#d7263d"}
DPI = 130
HEIGHT_IN = 6.6  # of the panels of one answer
CLOSE_UP_MARGIN_M = 1.5
MOST_DRAWN = 9  # of one answer's hypotheses

Box = tuple[float, float, float, float]  # x0, x1, y0, y1 in the map frame


def draw_answer(
    maps: Sequence[PreparedMap], scan: Scan, result: SearchResult, path: Path, choice: int = 0
) -> None:
    """The whole map with the best pose and its rivals; beside it the scan at the best pose, close up.

    choice: the hypothesis that counts as the best.
    """
    best = result.hypotheses[choice] if result.hypotheses else None
    map_index = best.map_index if best else 0
    grid = maps[map_index].grid
    box = known_box(grid)
    ratio = min(max((box[1] - box[0]) / (box[3] - box[2]), 0.6), 1.9)
    figure = Figure(figsize=(HEIGHT_IN * (ratio + 1.0) + 1.0, HEIGHT_IN + 1.2), layout="constrained")
    whole, close = figure.subplots(1, 2, width_ratios=[ratio, 1.0])
    figure.get_layout_engine().set(h_pad=0.12)  # type: ignore[union-attr, call-arg]
    figure.suptitle(_headline(result, best, maps), fontsize=13)
    draw_map(whole, grid, box, HEIGHT_IN * ratio)
    if best is None:
        close.set_axis_off()
    else:
        points = in_map(best.T_map_robot, scan.points_robot())
        whole.scatter(points[:, 0], points[:, 1], s=2, color=BEST_COLOR, linewidths=0, zorder=3)
        _draw_hypotheses(whole, result, choice, map_index)
        _draw_close_up(close, grid, points, best.T_map_robot)
        figure.legend(*whole.get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=9)
    _save(figure, path)


def draw_trajectory(maps: Sequence[PreparedMap], answers: Answers, path: Path) -> None:
    """Every query's best pose, coloured by verdict, on each map that answers lie on."""
    used = sorted({i for i, pose in zip(answers.map_indices, answers.poses, strict=True) if pose}) or [0]
    boxes = [known_box(maps[i].grid) for i in used]
    width, height = _figure_size(boxes[0])
    figure = Figure(figsize=(width * len(used), height), layout="constrained")
    for axes, map_index, box in zip(np.atleast_1d(figure.subplots(1, len(used))), used, boxes, strict=True):
        draw_map(axes, maps[map_index].grid, box, width)
        _draw_verdicts(axes, answers, map_index)
        axes.set_title(maps[map_index].name)
    _save(figure, path)


def draw_map(axes: Axes, grid: GridMap, box: Box, width_in: float) -> None:
    """The grid in metres of the map frame, framed to `box`; thinned to what the panel can show."""
    pixels_per_cell = width_in * DPI / ((box[1] - box[0]) / grid.resolution_m)
    cells = thin(grid.cells, math.ceil(1.0 / pixels_per_cell))
    cell_m = grid.resolution_m * max(math.ceil(1.0 / pixels_per_cell), 1)
    image = axes.imshow(
        cells,
        cmap=MAP_COLORS,
        vmin=0,
        vmax=2,
        origin="lower",
        extent=(0, cells.shape[1] * cell_m, 0, cells.shape[0] * cell_m),
        interpolation="nearest",
    )
    origin = grid.T_map_grid
    image.set_transform(
        Affine2D().rotate(origin.theta_rad).translate(origin.x_m, origin.y_m) + axes.transData
    )
    axes.set(
        xlim=box[:2], ylim=box[2:], aspect="equal", xlabel="x [m]", ylabel="y [m]", facecolor=UNKNOWN_COLOR
    )


def thin(cells: np.ndarray, factor: int) -> np.ndarray:
    """Blocks of factor x factor cells as one: occupied where any is, else free where any is, else unknown."""
    if factor <= 1:
        return cells
    pad = [(0, -size % factor) for size in cells.shape]
    padded = np.pad(cells, pad, constant_values=2)
    rows, cols = padded.shape[0] // factor, padded.shape[1] // factor
    blocks = padded.reshape(rows, factor, cols, factor)
    thinned = np.where((blocks == 0).any(axis=(1, 3)), 0, 2).astype(np.uint8)
    thinned[(blocks == 1).any(axis=(1, 3))] = 1
    return thinned


def in_map(T_map_robot: Pose2, points_robot: np.ndarray) -> np.ndarray:
    """(n, 2) points of the robot frame in the map frame."""
    c, s = math.cos(T_map_robot.theta_rad), math.sin(T_map_robot.theta_rad)
    return points_robot @ np.array([[c, s], [-s, c]]) + (T_map_robot.x_m, T_map_robot.y_m)


def known_box(grid: GridMap) -> Box:
    """Around the cells that are not unknown, in the map frame, with a small margin."""
    known = grid.cells != 2
    rows, cols = np.flatnonzero(known.any(axis=1)), np.flatnonzero(known.any(axis=0))
    if rows.size == 0:
        rows, cols = np.array([0, grid.height_cells - 1]), np.array([0, grid.width_cells - 1])
    x = np.array([cols[0], cols[-1] + 1]) * grid.resolution_m
    y = np.array([rows[0], rows[-1] + 1]) * grid.resolution_m
    corners = in_map(grid.T_map_grid, np.array([(x[i], y[j]) for i in (0, 1) for j in (0, 1)]))
    margin = 0.02 * float(np.ptp(corners, axis=0).max())
    (x0, y0), (x1, y1) = corners.min(axis=0) - margin, corners.max(axis=0) + margin
    return float(x0), float(x1), float(y0), float(y1)


def _figure_size(box: Box) -> tuple[float, float]:
    """Inches: the box's shape, its longer side 11."""
    scale = 11.0 / max(box[1] - box[0], box[3] - box[2])
    return max((box[1] - box[0]) * scale, 5.0), max((box[3] - box[2]) * scale, 4.0) + 0.6


def _draw_hypotheses(axes: Axes, result: SearchResult, choice: int, map_index: int) -> None:
    """Arrows with rank and probability; the chosen one in its own colour, on top."""
    for rank, hypothesis in enumerate(result.hypotheses):
        if hypothesis.map_index != map_index or (rank >= MOST_DRAWN and rank != choice):
            continue
        color = BEST_COLOR if rank == choice else RIVAL_COLORS[rank % len(RIVAL_COLORS)]
        label = f"{rank + 1}: p {hypothesis.probability:.3f}, explained {hypothesis.explained:.2f}"
        zorder = 11 if rank == choice else 10 - rank
        _draw_robot(axes, hypothesis.T_map_robot, color, _arrow_length_m(axes), label, zorder)


def _arrow_length_m(axes: Axes) -> float:
    return 0.05 * max(abs(np.diff(axes.get_xlim())[0]), abs(np.diff(axes.get_ylim())[0]))


def _draw_robot(
    axes: Axes, T_map_robot: Pose2, color: str, length_m: float, label: str | None, zorder: float
) -> None:
    """A disc at the robot's position and an arrow along its heading."""
    axes.scatter([T_map_robot.x_m], [T_map_robot.y_m], s=36, color=color, zorder=zorder, label=label)
    tip = in_map(T_map_robot, np.array([[length_m, 0.0]]))[0]
    axes.annotate(
        "",
        xy=tip,
        xytext=(T_map_robot.x_m, T_map_robot.y_m),
        zorder=zorder,
        arrowprops={"arrowstyle": "-|>", "color": color, "linewidth": 2.2, "shrinkA": 0, "shrinkB": 0},
    )


def _draw_close_up(axes: Axes, grid: GridMap, points: np.ndarray, T_map_robot: Pose2) -> None:
    """The echoes at the best pose, over the walls that should explain them."""
    framed = np.vstack([points, [(T_map_robot.x_m, T_map_robot.y_m)]])
    low, high = np.percentile(framed, [2, 98], axis=0)
    (x, y), half = (low + high) / 2, max(float((high - low).max()) / 2 + CLOSE_UP_MARGIN_M, 3.0)
    draw_map(axes, grid, (x - half, x + half, y - half, y + half), HEIGHT_IN)
    axes.scatter(points[:, 0], points[:, 1], s=7, color=BEST_COLOR, linewidths=0, zorder=3, label="echoes")
    _draw_robot(axes, T_map_robot, "#0b5fa5", 0.12 * half, "robot", zorder=5)
    axes.legend(loc="upper right", fontsize=9)
    axes.set_title(f"{len(points)} echoes at the best pose", fontsize=10)


def _headline(result: SearchResult, best: Hypothesis | None, maps: Sequence[PreparedMap]) -> str:
    if best is None:
        return f"{result.verdict}: {result.reason}"
    pose = best.T_map_robot
    where = f" on {maps[best.map_index].name}" if len(maps) > 1 else ""
    return (
        f"{result.verdict}{where}: x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, "
        f"heading {math.degrees(pose.theta_rad):.1f} deg   |   probability {best.probability:.3f}, "
        f"explained {best.explained:.2f}, {result.times.total_ms:.1f} ms"
    )


def _draw_verdicts(axes: Axes, answers: Answers, map_index: int) -> None:
    """Dots with heading ticks, the sure ones drawn first; a thin line where odometry ties them together."""
    if answers.tied:
        path = [
            (pose.x_m, pose.y_m) if pose is not None and index == map_index else (math.nan, math.nan)
            for pose, index in zip(answers.poses, answers.map_indices, strict=True)
        ]
        axes.plot(*np.array(path).reshape(-1, 2).T, color="#5b6770", linewidth=0.6, alpha=0.6, zorder=2)
    tick_m = 0.4 * _arrow_length_m(axes)
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
        axes.scatter(
            xyt[:, 0], xyt[:, 1], s=14, color=color, linewidths=0, label=f"{verdict}: {len(poses)}", zorder=3
        )
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper right", fontsize=9, framealpha=0.95)


def _save(figure: Figure, path: Path) -> None:
    """PNG, or what the ending says, under a temporary name first."""
    part = path.with_name(f".{path.stem}.part{path.suffix or '.png'}")
    figure.savefig(part, dpi=DPI, facecolor="white")
    part.replace(path)
