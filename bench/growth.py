"""How the time of a scan grows with poses and with beams: exponents, a table and a log-log picture."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from google_benchmark import Median, load_suite

LARGE_POSES = 1e8  # beyond it what a scan costs on any map no longer counts
# Series of growing maps, and what they are called.
MAPS = {
    "cut": "cuts of infinite_corridor",
    "floor": "made-up floors",
    "office": "offices, all rooms alike",
}
Table = list[list[str]]


@dataclass(frozen=True)
class Point:
    """The median scan of one map and sensor, on one thread."""

    name: str
    poses: float
    beams: float
    ms: float


def load_growth(path: Path) -> tuple[str, dict[str, list[Point]]]:
    """Date, and the points of each series: those of MAPS, building, beams. Raises as load_suite does."""
    suite = load_suite(path)
    return suite.date, series(suite.medians)


def series(medians: Mapping[str, Median]) -> dict[str, list[Point]]:
    found: dict[str, list[Point]] = {}
    for name, median in medians.items():
        kind, what = name.removesuffix("/real_time").split("/", 1)
        counters = median.counters
        point = Point(what, counters["poses"], counters["beams"], counters["median_ms"])
        found.setdefault(kind, []).append(point)
    return found


def exponent(sizes: Sequence[float], times: Sequence[float]) -> float:
    """The slope of log(time) over log(size), least squares; NaN for fewer than two sizes."""
    x, y = [math.log(size) for size in sizes], [math.log(time) for time in times]
    if len(set(x)) < 2:
        return math.nan
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    covariance = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y, strict=True))
    return covariance / sum((a - mean_x) ** 2 for a in x)


def of_poses(points: Sequence[Point], least_poses: float = 0.0) -> float:
    large = [p for p in points if p.poses >= least_poses]
    return exponent([p.poses for p in large], [p.ms for p in large])


def of_beams(points: Sequence[Point]) -> float:
    return exponent([p.beams for p in points], [p.ms for p in points])


def growth_table(found: Mapping[str, list[Point]]) -> Table:
    rows = [["map", "poses", "beams", "median ms"]]
    for kind, points in found.items():
        for p in points:
            name = p.name if kind == "building" else f"{kind} {p.name.removeprefix('cells:')}"
            rows.append([name, f"{p.poses:.2g}", f"{p.beams:.0f}", f"{p.ms:.3g}"])
    return rows


def exponent_table(found: Mapping[str, list[Point]]) -> Table:
    """A row per series: of all its maps, of the large ones; beams last."""
    rows = [["exponent of", "all", f"{LARGE_POSES:.0e} poses and more"]]
    for kind, title in MAPS.items():
        if points := found.get(kind):
            rows.append(
                [f"poses: {title}", f"{of_poses(points):.2f}", f"{of_poses(points, LARGE_POSES):.2f}"]
            )
    if points := found.get("beams"):
        rows.append(["beams", f"{of_beams(points):.2f}", ""])
    return rows


def draw_growth(found: Mapping[str, list[Point]], path: Path) -> None:
    """Two log-log panels: the points, the slopes fitted to large maps, a line of slope 1 beside them.

    The file is whole at any time.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, (by_poses, by_beams) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    for colour, (kind, title) in enumerate(MAPS.items()):
        if points := found.get(kind):
            _draw(by_poses, [p.poses for p in points], points, title, colour, LARGE_POSES)
    for p in found.get("building", []):
        by_poses.plot(p.poses, p.ms, "ks")
        by_poses.annotate(
            p.name, (p.poses, p.ms), textcoords="offset points", xytext=(-7, 5), ha="right", fontsize=7
        )
    if points := found.get("beams"):
        _draw(by_beams, [p.beams for p in points], points, "a made-up floor", 1)
    by_poses.set(
        xlabel="poses of the lattice (5 cm, 0.5 degrees)",
        title=f"time of a scan against poses, fitted from {LARGE_POSES:.0e}",
    )
    by_beams.set(xlabel="beams of the scan", title="and against beams")
    for axes in (by_poses, by_beams):
        axes.set(xscale="log", yscale="log", ylabel="median search, ms of one thread")
        bottom, top = axes.get_ylim()
        axes.set_ylim(bottom, max(top, 30.0 * bottom))  # noise is not to fill the panel
        _draw_slope_1(axes)
        axes.grid(which="major", alpha=0.4)
        axes.legend(loc="upper left", fontsize=8)
    part = path.with_name(path.name + ".part")
    figure.savefig(part, format="png", dpi=110)
    plt.close(figure)
    os.replace(part, path)


def _draw(
    axes, sizes: Sequence[float], points: Sequence[Point], title: str, colour: int, fit_from: float = 0.0
) -> None:
    """The points, and the slope fitted to those of at least that size."""
    axes.plot(sizes, [p.ms for p in points], "o:", color=f"C{colour}", linewidth=0.8)
    fitted = [(size, p.ms) for size, p in zip(sizes, points, strict=True) if size >= fit_from]
    if len(fitted) < 2:
        return
    x, y = zip(*fitted, strict=True)
    slope = exponent(x, y)
    middle_x, middle_y = (math.exp(sum(map(math.log, values)) / len(values)) for values in (x, y))
    ends = [min(x), max(x)]
    axes.plot(
        ends, [middle_y * (end / middle_x) ** slope for end in ends],
        color=f"C{colour}", alpha=0.4, linewidth=5, label=f"{title}: slope {slope:.2f}",
    )  # fmt: skip


def _draw_slope_1(axes) -> None:
    """From the lower left corner of what is drawn so far; the picture is not widened for it."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    axes.plot([left, right], [bottom, bottom * right / left], "--", color="0.4", label="slope 1")
    axes.set(xlim=(left, right), ylim=(bottom, top))
