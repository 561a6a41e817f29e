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

MAP_COLORS = ListedColormap(["#ffffff", "#20252b", "#d9dde1"])  # free, occupied, unknown
BEST_COLOR = "#d7263d"
RIVAL_COLORS = ("#1f77b4", "#e68a00", "#7b3fa0", "#2e8b57", "#8c564b")
VERDICT_COLORS = {"found": "#1a9850", "ambiguous": "#f39c12", "lost": "#d7263d"}
MAX_PIXELS = 1800
CLOSE_UP_MARGIN_M = 1.5


def draw_answer(maps: Sequence[PreparedMap], scan: Scan, result: SearchResult, path: Path) -> None:
    """The whole map with the best pose and its rivals; beside it the scan at the best pose, close up."""
    best = result.hypotheses[0] if result.hypotheses else None
    map_index = best.map_index if best else 0
    grid = maps[map_index].grid
    figure = Figure(figsize=(13.0, 6.8), layout="constrained")
    whole, close = figure.subplots(1, 2)
    for axes in (whole, close):
        draw_map(axes, grid)
    _frame_known(whole, grid)
    figure.suptitle(_headline(result, maps), fontsize=13)
    if best is None:
        close.set_axis_off()
    else:
        _draw_hypotheses(whole, result, map_index)
        _draw_close_up(close, scan, best)
    _save(figure, path)


def draw_trajectory(maps: Sequence[PreparedMap], answers: Answers, path: Path) -> None:
    """Every query's best pose, coloured by verdict, on each map that answers lie on."""
    used = sorted({i for i, pose in zip(answers.map_indices, answers.poses, strict=True) if pose}) or [0]
    width, height = _figure_size(maps[used[0]].grid)
    figure = Figure(figsize=(width * len(used), height), layout="constrained")
    for axes, map_index in zip(np.atleast_1d(figure.subplots(1, len(used))), used, strict=True):
        grid = maps[map_index].grid
        draw_map(axes, grid)
        _frame_known(axes, grid)
        _draw_verdicts(axes, answers, map_index)
        axes.set_title(maps[map_index].name)
    _save(figure, path)


def draw_map(axes: Axes, grid: GridMap) -> None:
    """The grid in metres of the map frame; a large one is thinned so that walls stay."""
    cells = thin(grid.cells, math.ceil(max(grid.cells.shape) / MAX_PIXELS))
    width_m = grid.width_cells * grid.resolution_m
    height_m = grid.height_cells * grid.resolution_m
    image = axes.imshow(
        cells, cmap=MAP_COLORS, vmin=0, vmax=2, origin="lower", extent=(0, width_m, 0, height_m),
        interpolation="nearest",
    )
    origin = grid.T_map_grid
    placed = Affine2D().rotate(origin.theta_rad).translate(origin.x_m, origin.y_m)
    image.set_transform(placed + axes.transData)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


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


def _known_box(grid: GridMap) -> tuple[float, float, float, float]:
    """x0, x1, y0, y1 of the cells that are not unknown, in the map frame, with a small margin."""
    rows, cols = np.nonzero(grid.cells != 2)
    if rows.size == 0:
        rows, cols = np.array([0, grid.height_cells - 1]), np.array([0, grid.width_cells - 1])
    x = np.array([cols.min(), cols.max() + 1]) * grid.resolution_m
    y = np.array([rows.min(), rows.max() + 1]) * grid.resolution_m
    corners = np.array([(x[i], y[j]) for i in (0, 1) for j in (0, 1)])
    corners = in_map(grid.T_map_grid, corners)
    margin = 0.02 * float(np.ptp(corners, axis=0).max())
    (x0, y0), (x1, y1) = corners.min(axis=0) - margin, corners.max(axis=0) + margin
    return float(x0), float(x1), float(y0), float(y1)


def _frame_known(axes: Axes, grid: GridMap) -> None:
    x0, x1, y0, y1 = _known_box(grid)
    axes.set_xlim(x0, x1)
    axes.set_ylim(y0, y1)


def _figure_size(grid: GridMap) -> tuple[float, float]:
    """Inches: the map's shape, its longer side 11."""
    x0, x1, y0, y1 = _known_box(grid)
    scale = 11.0 / max(x1 - x0, y1 - y0)
    return max((x1 - x0) * scale, 5.0), max((y1 - y0) * scale, 4.0) + 0.6


def _draw_hypotheses(axes: Axes, result: SearchResult, map_index: int) -> None:
    """Arrows with rank and probability; the best on top."""
    ranked = [(k, h) for k, h in enumerate(result.hypotheses) if h.map_index == map_index]
    for rank, hypothesis in reversed(ranked):
        color = BEST_COLOR if rank == 0 else RIVAL_COLORS[(rank - 1) % len(RIVAL_COLORS)]
        label = f"{rank + 1}: p {hypothesis.probability:.3f}, explained {hypothesis.explained:.2f}"
        _draw_robot(axes, hypothesis.T_map_robot, color, _arrow_length_m(axes), label, zorder=10 - rank)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2, fontsize=9)


def _arrow_length_m(axes: Axes) -> float:
    return 0.05 * max(abs(np.diff(axes.get_xlim())[0]), abs(np.diff(axes.get_ylim())[0]))


def _draw_robot(
    axes: Axes, T_map_robot: Pose2, color: str, length_m: float, label: str | None, zorder: float
) -> None:
    """A disc at the robot's position and an arrow along its heading."""
    axes.scatter([T_map_robot.x_m], [T_map_robot.y_m], s=36, color=color, zorder=zorder, label=label)
    tip = in_map(T_map_robot, np.array([[length_m, 0.0]]))[0]
    axes.annotate(
        "", xy=tip, xytext=(T_map_robot.x_m, T_map_robot.y_m), zorder=zorder,
        arrowprops={"arrowstyle": "-|>", "color": color, "linewidth": 2.2, "shrinkA": 0, "shrinkB": 0},
    )


def _draw_close_up(axes: Axes, scan: Scan, best: Hypothesis) -> None:
    """The echoes at the best pose, over the walls that should explain them."""
    points = in_map(best.T_map_robot, scan.points_robot())
    axes.scatter(points[:, 0], points[:, 1], s=7, color=BEST_COLOR, linewidths=0, zorder=3, label="echoes")
    framed = np.vstack([points, [(best.T_map_robot.x_m, best.T_map_robot.y_m)]])
    low, high = np.percentile(framed, [1, 99], axis=0)
    center, half = (low + high) / 2, max(float((high - low).max()) / 2 + CLOSE_UP_MARGIN_M, 3.0)
    axes.set_xlim(center[0] - half, center[0] + half)
    axes.set_ylim(center[1] - half, center[1] + half)
    _draw_robot(axes, best.T_map_robot, "#0b5fa5", 0.12 * half, "robot", zorder=5)
    axes.legend(loc="upper right", fontsize=9)
    axes.set_title(f"{len(points)} echoes at the best pose", fontsize=10)


def _headline(result: SearchResult, maps: Sequence[PreparedMap]) -> str:
    if not result.hypotheses:
        return f"{result.verdict}: {result.reason}"
    best = result.hypotheses[0]
    pose = best.T_map_robot
    where = f" on {maps[best.map_index].name}" if len(maps) > 1 else ""
    return (
        f"{result.verdict}{where}: x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, "
        f"heading {math.degrees(pose.theta_rad):.1f} deg   |   probability {best.probability:.3f}, "
        f"explained {best.explained:.2f}, {result.times.total_ms:.1f} ms"
    )


def _draw_verdicts(axes: Axes, answers: Answers, map_index: int) -> None:
    """Dots with heading ticks, the sure ones drawn first."""
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
            xyt[:, 0], xyt[:, 1], tick_m * np.cos(xyt[:, 2]), tick_m * np.sin(xyt[:, 2]), color=color,
            angles="xy", scale_units="xy", scale=1, width=0.0015, headwidth=0, headlength=0, headaxislength=0,
        )
        axes.scatter(xyt[:, 0], xyt[:, 1], s=9, color=color, linewidths=0, label=f"{verdict}: {len(poses)}", zorder=3)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper right", fontsize=9)


def _save(figure: Figure, path: Path) -> None:
    """PNG, or what the ending says, under a temporary name first."""
    part = path.with_name(f".{path.stem}.part{path.suffix or '.png'}")
    figure.savefig(part, dpi=130, facecolor="white")
    part.replace(path)
