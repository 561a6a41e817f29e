"""Maps under construction: drawn in the colours of Okada & Fujimoto, and as they grow."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import TracebackType

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from landfall._landfall import GridMap, Pose2
from landfall.pictures import Box, draw_scale, known_box, save_figure, thin

UNKNOWN = "#a9a9a9"
COLORS = ListedColormap(["#ffffff", "#000000", UNKNOWN])  # measured, obstacles, unknown
PATH, START, ROBOT = "#d7263d", "#1a9850", "#0b5fa5"
LONGER_SIDE_IN = 8.0
FRAMES_PER_S = 12
FRAME_PIXELS = 640  # along the longer side


def draw_built_map(axes: Axes, grid: GridMap, path: Sequence[Pose2], box: Box | None = None) -> None:
    """Unknown grey, obstacles black, measured white; the path, and the robot at its end."""
    x0, y0 = grid.T_map_grid.x_m, grid.T_map_grid.y_m
    x0, x1, y0, y1 = (
        x0,
        x0 + grid.width_cells * grid.resolution_m,
        y0,
        y0 + grid.height_cells * grid.resolution_m,
    )
    axes.imshow(
        thin(grid.cells, max(1, max(grid.cells.shape) // 2000)),
        cmap=COLORS,
        vmin=0,
        vmax=2,
        origin="lower",
        extent=(x0, x1, y0, y1),
        interpolation="nearest",
    )
    if path:
        xy = np.array([(pose.x_m, pose.y_m) for pose in path])
        axes.plot(xy[:, 0], xy[:, 1], color=PATH, linewidth=1.2)
        axes.scatter(xy[-1:, 0], xy[-1:, 1], s=18, color=ROBOT, zorder=3)
    shown = box or known_box(grid)
    axes.set(
        xlim=shown[:2], ylim=shown[2:], aspect="equal", facecolor=UNKNOWN, xlabel="x [m]", ylabel="y [m]"
    )


def save_built_map(grid: GridMap, path: Sequence[Pose2], file: Path) -> None:
    """One picture, under a temporary name first."""
    box = known_box(grid)
    scale = LONGER_SIDE_IN / max(box[1] - box[0], box[3] - box[2])
    size = (max((box[1] - box[0]) * scale, 3.0) + 0.8, max((box[3] - box[2]) * scale, 3.0) + 0.6)
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots()
    draw_built_map(axes, grid, path, box)
    if path:
        axes.scatter(path[0].x_m, path[0].y_m, s=30, color=START, zorder=3)
        marks = [
            Line2D([], [], color=PATH),
            *(Line2D([], [], color=c, marker="o", ls="") for c in (START, ROBOT)),
        ]
        labels = [f"path of {len(path)} scans", "start", "end"]
        axes.legend(marks, labels, loc="lower right", fontsize=9)
    draw_scale(axes)
    save_figure(figure, file)


class GrowingMapGif:
    """A GIF of a map as it grows: use as a context, add() a frame now and then. All frames show one place."""

    def __init__(self, file: Path) -> None:
        self.file = file
        self.frames: list[tuple[GridMap, list[Pose2]]] = []

    def add(self, grid: GridMap, path: Sequence[Pose2]) -> None:
        self.frames.append((grid, list(path)))

    def __enter__(self) -> GrowingMapGif:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Writes what there is, also where the work was stopped."""
        if self.frames:
            self._write()

    def _write(self) -> None:
        box = known_box(self.frames[-1][0])
        scale = FRAME_PIXELS / 100.0 / max(box[1] - box[0], box[3] - box[2])
        figure = Figure(
            figsize=(max((box[1] - box[0]) * scale, 2.0), max((box[3] - box[2]) * scale, 2.0)), dpi=100
        )
        FigureCanvasAgg(figure)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        part = self.file.with_name(f".{self.file.stem}.part.gif")
        writer = PillowWriter(fps=FRAMES_PER_S)
        with writer.saving(figure, str(part), dpi=100):
            for grid, path in self.frames:
                axes.clear()
                draw_built_map(axes, grid, path, box)
                axes.set_axis_off()
                figure.patch.set_facecolor(UNKNOWN)
                writer.grab_frame()
        part.replace(self.file)
