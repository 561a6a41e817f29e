"""One answer: the map with the best pose and its rivals, and the scan close up at the best of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from landfall._landfall import Hypothesis, Pose2, PreparedMap, Scan, SearchResult
from landfall.echoes import EXPLAINED, LONG, SHORT, judge_echoes
from landfall.pictures import (
    arrow_length_m,
    draw_map,
    draw_scale,
    in_map,
    known_box,
    legend_below,
    save_figure,
)

BEST_COLOR = "#d7263d"
RIVAL_COLORS = ("#7b3fa0", "#2e8b57", "#8c564b", "#0e7c86", "#b8860b")
ECHO_COLORS = {EXPLAINED: "#1f6fd6", SHORT: "#ff8c00", LONG: "#e0119d"}
ECHO_LABELS = {EXPLAINED: "echoes on walls", SHORT: "short of walls", LONG: "beyond walls"}
LEGEND_ROW_IN = 0.22
TITLE_IN = 0.35
PANEL_IN = 6.6  # height of the panels
CLOSE_UP_MARGIN_M = 1.5
LEGEND_COLUMNS = 3
NUMBER_AT = np.array([[-12.0, 0.0]])  # points, behind the robot
MOST_DRAWN = 9  # hypotheses


def draw_answer(
    maps: Sequence[PreparedMap], scan: Scan, result: SearchResult, path: Path, choice: int = 0
) -> None:
    """answer_figure() into a file. Raises FileWrite."""
    save_figure(answer_figure(maps, scan, result, choice), path)


def answer_figure(maps: Sequence[PreparedMap], scan: Scan, result: SearchResult, choice: int = 0) -> Figure:
    """The whole map with the best pose and its rivals; beside it the scan at the best pose, close up.

    An answer that is not found gets its strongest rival close up too. choice: the hypothesis that counts as
    the best.
    """
    shown = _close_ups(result, choice)
    map_index = result.hypotheses[shown[0]].map_index if shown else 0
    box = known_box(maps[map_index].grid)
    ratio = min(max((box[1] - box[0]) / (box[3] - box[2]), 0.6), 1.9)
    widths = [ratio, *(1.0 for _ in shown)]
    figure = Figure(
        figsize=(PANEL_IN * sum(widths) + 0.7 * len(widths), PANEL_IN + 1.7), layout="constrained"
    )
    whole, *close = figure.subplots(1, len(widths), width_ratios=widths, squeeze=False)[0]
    figure.suptitle(_headline(result, maps, choice), fontsize=13)
    draw_map(whole, maps[map_index].grid, box, PANEL_IN * ratio)
    for rank, axes in zip(shown, close, strict=True):
        hypothesis = result.hypotheses[rank]
        judged = _draw_close_up(
            axes, maps[hypothesis.map_index], scan, hypothesis.T_map_robot, _color(rank, choice)
        )
        axes.set_title(_title(rank, choice, hypothesis, maps, judged), fontsize=10)
    if shown:
        points = in_map(result.hypotheses[shown[0]].T_map_robot, scan.points_robot())
        whole.scatter(points[:, 0], points[:, 1], s=2, color=ECHO_COLORS[EXPLAINED], linewidths=0, zorder=3)
        _draw_hypotheses(whole, result, choice, map_index)
        legend_below(whole, LEGEND_COLUMNS)
    whole.set_title(_map_title(result, maps, map_index), fontsize=10)
    _leave_room(figure, LEGEND_ROW_IN * _legend_rows(whole))
    draw_scale(whole)
    return figure


def _close_ups(result: SearchResult, choice: int) -> list[int]:
    """The best, and where it is not sure the most probable of the others."""
    if not result.hypotheses:
        return []
    rivals = [rank for rank in range(len(result.hypotheses)) if rank != choice]
    return [choice] if result.verdict == "found" and choice == 0 else [choice, *rivals[:1]]


def _color(rank: int, choice: int) -> str:
    return BEST_COLOR if rank == choice else RIVAL_COLORS[(rank - 1) % len(RIVAL_COLORS)]


def _draw_hypotheses(axes: Axes, result: SearchResult, choice: int, map_index: int) -> None:
    """Arrows with rank and probability; the chosen one in its own colour, on top."""
    for rank, hypothesis in enumerate(result.hypotheses):
        if hypothesis.map_index != map_index or (rank >= MOST_DRAWN and rank != choice):
            continue
        color = _color(rank, choice)
        label = f"{rank + 1}: probability {hypothesis.probability:.3f}, explained {hypothesis.explained:.2f}"
        zorder = 11 if rank == choice else 10 - rank
        draw_robot(axes, hypothesis.T_map_robot, color, arrow_length_m(axes), label, zorder)
        axes.annotate(
            str(rank + 1),
            (hypothesis.T_map_robot.x_m, hypothesis.T_map_robot.y_m),
            xytext=in_map(Pose2(0.0, 0.0, hypothesis.T_map_robot.theta_rad), NUMBER_AT)[0],
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=10,
            fontweight="bold",
            color=color,
            zorder=12 + zorder,
            path_effects=[patheffects.withStroke(linewidth=2.5, foreground="white")],
        )


def draw_robot(
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


def _draw_close_up(axes: Axes, map: PreparedMap, scan: Scan, T_map_robot: Pose2, color: str) -> np.ndarray:
    """The echoes over the walls that should explain them; returns their judgement."""
    points = in_map(T_map_robot, scan.points_robot())
    judged = judge_echoes(map, scan, T_map_robot, points)
    framed = np.vstack([points, [(T_map_robot.x_m, T_map_robot.y_m)]])
    low, high = np.percentile(framed, [2, 98], axis=0)
    (x, y), half = (low + high) / 2, max(float((high - low).max()) / 2 + CLOSE_UP_MARGIN_M, 3.0)
    draw_map(axes, map.grid, (x - half, x + half, y - half, y + half), PANEL_IN)
    for kind, echo_color in ECHO_COLORS.items():
        of_kind = points[judged == kind]
        label = f"{ECHO_LABELS[kind]}: {len(of_kind)}"
        axes.scatter(of_kind[:, 0], of_kind[:, 1], s=8, color=echo_color, linewidths=0, zorder=3, label=label)
    draw_robot(axes, T_map_robot, color, 0.12 * half, None, zorder=5)
    legend_below(axes, LEGEND_COLUMNS)
    axes.set_ylabel("")
    draw_scale(axes)
    return judged


def _headline(result: SearchResult, maps: Sequence[PreparedMap], choice: int) -> str:
    if not result.hypotheses:
        return f"{result.verdict}: {result.reason}"
    best = result.hypotheses[choice]
    pose = best.T_map_robot
    verdict = f"{result.verdict} ({result.reason})" if result.reason else result.verdict
    verdict = verdict if choice == 0 else f"chosen by odometry, {verdict} alone"
    where = f" on {maps[best.map_index].name}" if len(maps) > 1 else ""
    return (
        f"{verdict}{where}: x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, "
        f"heading {math.degrees(pose.theta_rad):.1f} deg   |   probability {best.probability:.3f}, "
        f"explained {best.explained:.2f}, {result.times.total_ms - result.times.prepare_ms:.1f} ms"
    )


def _leave_room(figure: Figure, bottom_in: float) -> None:
    """For the headline above, and below for legends, which the layout does not see."""
    top, bottom = TITLE_IN / figure.get_figheight(), bottom_in / figure.get_figheight()
    layout = figure.get_layout_engine()
    layout.set(rect=(0.0, bottom, 1.0, 1.0 - bottom - top))  # type: ignore[union-attr, call-arg]


def _legend_rows(axes: Axes) -> int:
    """Of the legend below a panel."""
    return math.ceil(len(axes.get_legend_handles_labels()[0]) / LEGEND_COLUMNS)


def _title(
    rank: int, choice: int, hypothesis: Hypothesis, maps: Sequence[PreparedMap], judged: np.ndarray
) -> str:
    what = "best pose" if rank == choice else "strongest rival"
    where = f" on {maps[hypothesis.map_index].name}" if len(maps) > 1 else ""
    return f"{what} ({rank + 1}){where}: the scan's {len(judged)} echoes there"


def _map_title(result: SearchResult, maps: Sequence[PreparedMap], map_index: int) -> str:
    elsewhere = sum(hypothesis.map_index != map_index for hypothesis in result.hypotheses)
    name = maps[map_index].name
    return name + (f" ({elsewhere} hypotheses lie on other maps)" if elsewhere else "")
