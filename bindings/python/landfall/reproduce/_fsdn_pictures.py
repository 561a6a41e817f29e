"""The cells of a focused stochastic diffusion network over a workshop, and what they cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from landfall._landfall import DiffusionSnapshot, Pose2
from landfall.reproduce._workshop import HEIGHT_M, WIDTH_M, Workshop

PANEL_IN = 3.6
DPI = 130
WALL, SOLID, IDLE, ACTIVE, FOCUSED, TRUTH = "#2b2f36", "#d9dde2", "#b8c0c9", "#e8871e", "#d7263d", "#0b5fa5"
SHOWN = (0, 10, 30, 100)
FRAME_DPI = 64


def draw_workshops(places: Sequence[Workshop], poses: Sequence[Sequence[Pose2]], path: Path) -> None:
    """Plans, with some random starts."""
    figure = Figure(figsize=(PANEL_IN * len(places), PANEL_IN), layout="constrained")
    for axes, workshop, starts in zip(
        np.atleast_1d(figure.subplots(1, len(places))), places, poses, strict=True
    ):
        _draw_plan(axes, workshop)
        for start in starts:
            _draw_pose(axes, start)
    _save(figure, path)


def draw_diffusion(
    workshop: Workshop, snapshots: Sequence[DiffusionSnapshot], truth: Pose2, path: Path
) -> None:
    """Cells at iterations 0, 10, 30, 100 and the end: gray inactive, orange active, red near the finest."""
    by_iteration = {snapshot.iteration: snapshot for snapshot in snapshots}
    shown = [by_iteration[i] for i in SHOWN if i in by_iteration and by_iteration[i] is not snapshots[-1]]
    shown.append(snapshots[-1])
    figure = Figure(figsize=(PANEL_IN * len(shown), PANEL_IN + 0.3), layout="constrained")
    finest = _finest(snapshots)
    for axes, snapshot in zip(np.atleast_1d(figure.subplots(1, len(shown))), shown, strict=True):
        _draw_plan(axes, workshop)
        _draw_cells(axes, snapshot, finest)
        _draw_pose(axes, truth)
        ending = ", the end" if snapshot is snapshots[-1] else ""
        axes.set_title(f"iteration {snapshot.iteration}{ending}")
    _save(figure, path)


def draw_frames(workshop: Workshop, snapshots: Sequence[DiffusionSnapshot], truth: Pose2, path: Path) -> None:
    """The same as an animated GIF."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    finest = _finest(snapshots)
    every = max(1, len(snapshots) // 40)
    chosen = [*snapshots[::every], snapshots[-1]]
    frames = []
    for snapshot in chosen:
        figure = Figure(figsize=(5.0, 5.0), layout="constrained", dpi=FRAME_DPI)
        axes = figure.subplots()
        _draw_plan(axes, workshop)
        _draw_cells(axes, snapshot, finest)
        _draw_pose(axes, truth)
        axes.set_title(f"iteration {snapshot.iteration}")
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        frames.append(
            Image.fromarray(np.asarray(canvas.buffer_rgba())).convert(
                "P", palette=Image.Palette.ADAPTIVE, colors=16
            )
        )
    frames[0].save(
        path, save_all=True, append_images=frames[1:], duration=[150] * (len(frames) - 1) + [2000], loop=0
    )


def draw_curves(
    curve: Sequence[Mapping], chosen: int, success_by_obstacles: Mapping[str, float], path: Path
) -> None:
    """Processor and wall time and success against the number of cells; success against shortened beams."""
    figure = Figure(figsize=(3.0 * PANEL_IN, PANEL_IN), layout="constrained")
    times, successes, obstacles = figure.subplots(1, 3)
    cells = [row["cells"] for row in curve]
    for key, label, style in (
        ("cpu_ms_1", "processor time, 1 thread", "o-"),
        ("cpu_ms_2", "processor time, 2 threads", "s--"),
        ("wall_ms_1", "wall time, 1 thread", "o:"),
        ("wall_ms_2", "wall time, 2 threads", "s:"),
    ):
        times.plot(
            cells, [np.nan if row[key] is None else row[key] for row in curve], style, ms=4, label=label
        )
    times.axvline(chosen, color=TRUTH, lw=1)
    times.set(xscale="log", yscale="log", xlabel="cells", ylabel="until found, expected [ms]")
    times.legend(fontsize=7)
    successes.plot(cells, [100 * row["success_1"] for row in curve], "o-", ms=4, color=TRUTH)
    successes.axvline(chosen, color=TRUTH, lw=1, label="chosen by the engine")
    successes.set(xscale="log", xlabel="cells", ylabel="right mode found [%]", ylim=(0, 104))
    successes.legend(fontsize=7, loc="lower right")
    shares = [100 * float(share) for share in success_by_obstacles]
    obstacles.plot(shares, [100 * s for s in success_by_obstacles.values()], "o-", ms=4, color=FOCUSED)
    obstacles.set(xlabel="beams shortened [%]", ylabel="within 1 cm and 1 degree [%]", ylim=(0, 104))
    _save(figure, path)


def _draw_plan(axes: Axes, workshop: Workshop) -> None:
    axes.add_collection(PolyCollection(workshop.solids, facecolors=SOLID, edgecolors="none"))
    walls = [((x1, y1), (x2, y2)) for x1, y1, x2, y2 in workshop.walls]
    axes.add_collection(LineCollection(walls, colors=WALL, linewidths=1.1))
    axes.set(xlim=(-0.4, WIDTH_M + 0.4), ylim=(-0.4, HEIGHT_M + 0.4), aspect="equal", xticks=[], yticks=[])
    axes.set_frame_on(False)


def _draw_cells(axes: Axes, snapshot: DiffusionSnapshot, finest: int) -> None:
    poses = snapshot.poses
    active = np.array(snapshot.active, dtype=bool)
    focused = active & (np.array(snapshot.level) >= finest - 1)
    for mask, color, size in ((~active, IDLE, 4), (active & ~focused, ACTIVE, 6), (focused, FOCUSED, 8)):
        axes.scatter(poses[mask, 0], poses[mask, 1], s=size, color=color, linewidths=0, zorder=3)


def _draw_pose(axes: Axes, pose: Pose2) -> None:
    axes.annotate(
        "",
        (pose.x_m + 1.1 * np.cos(pose.theta_rad), pose.y_m + 1.1 * np.sin(pose.theta_rad)),
        (pose.x_m, pose.y_m),
        arrowprops={"arrowstyle": "->", "color": TRUTH, "lw": 1.4},
        zorder=5,
    )
    axes.scatter([pose.x_m], [pose.y_m], s=34, facecolors="none", edgecolors=TRUTH, linewidths=1.4, zorder=5)


def _finest(snapshots: Sequence[DiffusionSnapshot]) -> int:
    return max(max(snapshot.level) for snapshot in snapshots)


def _save(figure: Figure, path: Path) -> None:
    figure.savefig(path, dpi=DPI)
