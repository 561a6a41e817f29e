"""Figures 5 and 7 of the convolution paper, and what they were made from."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.figure import Figure

from landfall._landfall import GridMap, Pose2, Scan
from landfall.pictures import draw_map, in_map, known_box

PANEL_IN = 4.6
DPI = 130
DROPPED, KEPT, TRUTH = "#9aa5b1", "#d7263d", "#0b5fa5"


def draw_points(
    grids: dict[str, GridMap],
    turns: dict[str, tuple[Scan, Scan]],
    truths: dict[str, Pose2],
    estimates: dict[str, Pose2],
    path: Path,
) -> None:
    """The extended robot at its estimate: readings that the filter drops, and those that it keeps."""
    figure = Figure(figsize=(PANEL_IN * len(grids), PANEL_IN), layout="constrained")
    for axes, name in zip(np.atleast_1d(figure.subplots(1, len(grids))), grids, strict=True):
        draw_map(axes, grids[name], known_box(grids[name]), PANEL_IN)
        for scan, color, label in zip(
            turns[name], (DROPPED, KEPT), ("all readings", "local minima"), strict=True
        ):
            points = in_map(estimates[name], scan.points_robot())
            axes.scatter(points[:, 0], points[:, 1], s=7, color=color, linewidths=0, label=label)
        axes.scatter([truths[name].x_m], [truths[name].y_m], s=50, marker="o", color=TRUTH, label="truth")
        axes.scatter(
            [estimates[name].x_m], [estimates[name].y_m], s=60, marker="x", color="black", label="estimate"
        )
        axes.set_title(f"point {name}")
    axes.legend(loc="lower right", fontsize=8)
    _save(figure, path)


def draw_slices(volumes: dict[str, np.ndarray], cell_m: float, truths: dict[str, Pose2], path: Path) -> None:
    """Figure 5: C at the heading of its maximum."""
    figure = Figure(figsize=(PANEL_IN * len(volumes), PANEL_IN), layout="constrained")
    for axes, (name, volume) in zip(
        np.atleast_1d(figure.subplots(1, len(volumes))), volumes.items(), strict=True
    ):
        heading = int(np.argmax(volume.max(axis=(1, 2))))
        extent = (0.0, volume.shape[2] * cell_m, 0.0, volume.shape[1] * cell_m)
        image = axes.imshow(volume[heading], origin="lower", extent=extent, cmap="viridis")
        axes.scatter([truths[name].x_m], [truths[name].y_m], s=90, facecolors="none", edgecolors=KEPT)
        axes.set(title=f"point {name}, heading {360.0 * heading / len(volume):.1f} deg", xlabel="x [m]")
        figure.colorbar(image, ax=axes, shrink=0.8)
    _save(figure, path)


def draw_wrap(grid: GridMap, padded: np.ndarray, wrapped: np.ndarray, path: Path) -> None:
    """C at one heading by padded transforms and by those that wrap, on one scale, and what wrapping adds."""
    heading = int(np.argmax(padded.max(axis=(1, 2))))
    figure = Figure(figsize=(PANEL_IN * 3, 0.8 * PANEL_IN), layout="constrained")
    titles = ("padded: nothing wraps", "transforms of the map's size (paper)", "what wraps around")
    slices = (padded[heading], wrapped[heading], wrapped[heading] - padded[heading])
    walls = np.ma.masked_where(grid.cells != 1, np.ones_like(grid.cells))
    extent = (0.0, padded.shape[2] * grid.resolution_m, 0.0, padded.shape[1] * grid.resolution_m)
    for axes, title, values in zip(figure.subplots(1, 3), titles, slices, strict=True):
        most = float(max(wrapped[heading].max(), padded[heading].max()))
        image = axes.imshow(values, origin="lower", extent=extent, cmap="viridis", vmin=0.0, vmax=most)
        axes.imshow(walls, origin="lower", extent=extent, cmap="gray", vmin=0.0, vmax=1.0, alpha=0.6)
        axes.set(title=title, xlabel="x [m]")
        figure.colorbar(image, ax=axes, shrink=0.8)
    _save(figure, path)


def draw_headings(volumes: dict[str, np.ndarray], path: Path) -> None:
    """Figure 7: the maximum of C at each heading."""
    figure = Figure(figsize=(2.0 * PANEL_IN, 0.8 * PANEL_IN), layout="constrained")
    axes = figure.subplots()
    for name, volume in volumes.items():
        most = volume.max(axis=(1, 2))
        axes.plot(np.arange(len(most)) * 360.0 / len(most), most, marker=".", label=f"point {name}")
    axes.set(xlabel="heading [deg]", ylabel="maximum of C", xlim=(0.0, 360.0))
    axes.set_xticks(range(0, 361, 45))
    axes.grid(alpha=0.3)
    axes.legend()
    _save(figure, path)


def _save(figure: Figure, path: Path) -> None:
    part = path.with_name(f".{path.stem}.part{path.suffix}")
    figure.savefig(part, dpi=DPI, facecolor="white")
    part.replace(path)
