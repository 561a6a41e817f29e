"""What pictures share: the map in metres, points and robots on it, a scale, files that appear whole."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.transforms import Affine2D, ScaledTranslation
from mpl_toolkits.axes_grid1.anchored_artists import AnchoredSizeBar

from landfall._landfall import GridMap, Pose2
from landfall.errors import FileWrite
from landfall.outputs import replaceable

UNKNOWN_COLOR = "#d9dde1"
MAP_COLORS = ListedColormap(["#ffffff", "#20252b", UNKNOWN_COLOR])  # free, occupied, unknown
VERDICT_COLORS = {"found": "#1a9850", "ambiguous": "#f39c12", "lost": "#d7263d"}
DPI = 130
LABEL_IN = 0.5  # from a panel's rim to below its axis' label

Box = tuple[float, float, float, float]  # x0, x1, y0, y1 in the map frame


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


def arrow_length_m(axes: Axes) -> float:
    """Of a robot's heading, by the size of what the panel shows."""
    return 0.05 * max(abs(np.diff(axes.get_xlim())[0]), abs(np.diff(axes.get_ylim())[0]))


def legend_below(axes: Axes, columns: int) -> None:
    """Under the axis' label, by inches and not by the panel's height."""
    figure = axes.get_figure()
    assert figure is not None
    down = ScaledTranslation(0.0, -LABEL_IN, figure.dpi_scale_trans)
    axes.legend(
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        bbox_transform=axes.transAxes + down,
        ncols=columns,
        fontsize=9,
        frameon=False,
        markerscale=1.5,
    )


def draw_scale(axes: Axes) -> None:
    """A bar of 1, 2 or 5 times a power of ten metres, about a fifth of the panel's width."""
    fifth_m = abs(float(np.diff(axes.get_xlim())[0])) / 5.0
    power = 10.0 ** math.floor(math.log10(fifth_m))
    length_m = power * max(step for step in (1.0, 2.0, 5.0) if step * power <= fifth_m)
    bar = AnchoredSizeBar(
        axes.transData, length_m, f"{length_m:g} m", loc="lower left", pad=0.4, borderpad=0.6, sep=4
    )
    bar.patch.set(alpha=0.85, linewidth=0.5)
    bar.set_zorder(20)
    axes.add_artist(bar)


def save_figure(figure: Figure, path: Path) -> None:
    """PNG, or what the ending says, under a temporary name first."""
    target = replaceable(path)
    part = target.with_name(f".{target.stem}.part{path.suffix or '.png'}")
    try:
        figure.savefig(part, dpi=DPI, facecolor="white")
        part.replace(target)
    except OSError as cause:
        part.unlink(missing_ok=True)
        raise FileWrite(f"{path}: cannot be written: {cause.strerror or cause}") from cause
