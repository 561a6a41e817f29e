"""Static localization of a wheelchair by occupancy grids (Courcelle & Horn 1999), sections 4 to 6.

Three furnished rooms per seed, a ring of 14 sonars whose cones are 12 degrees wide, random poses, and an
estimate that is off by up to 80 cm and 45 degrees. The paper does not give its rooms, nor mounts and ranges
of the sonars: those are ours. A beam measures the nearest obstacle in its cone.

The pose that counts is the method's own, unrefined: that of the best score, which is the paper's answer
("by_score", method `grid_published`), and that of the first hypothesis of method `grid`, chosen among the
best scores by ranges cast against the map. Real sonars and a real laser: _grid_on_real_data.py.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from landfall._landfall import (
    Beam,
    Pose2,
    PreparedMap,
    Scan,
    SearchResult,
    Sensor,
    Window,
    angle_distance,
    simulate,
    time_grid_matching,
    translation_distance,
)
from landfall.progress import progress_bar
from landfall.reproduce._furnished_rooms import RESOLUTION_M, make_room
from landfall.reproduce._grid_on_real_data import real_data, real_rows
from landfall.searching import search, search_options

ROOMS = 3
POSES_PER_SEED = 1000
TIMED = 100
HALF_WINDOW_CELLS = 8
HALF_CONE_DEG, HEADING_STEP_DEG = 45.0, 5.0
ROBOT_RADIUS_M = 0.3
WITHIN_M, WITHIN_DEG = 0.1, 7.0
# "found" is about this very pose: poses a little farther off than what counts as right are its rivals.
DISTINCT_M, DISTINCT_DEG = 0.12, 7.5
RANGE_NOISE = 0.03
WRONG_SHARE = 0.05  # of the readings, too short; as many too long

PAPER = {"success_uncorrected": 0.74, "success_corrected": 0.99}
ROWS = {
    "success_uncorrected": "simulated, uncorrected global grid",
    "success_corrected": "simulated, contour-corrected, poses on the lattice",
    "success_continuous": "simulated, contour-corrected, poses anywhere",
    "success_rotated_raster": "rotated raster instead of oriented grids",
    "success_with_crosstalk": "crosstalk, multiple reflections, range noise",
    "right_that_are_found": "of these right, found",
    "found_but_wrong": "of these found, wrong",
    "reduced_finds_the_same": "reduced grids: same answer as the full search's",
}
# Compared as the paper does: ranges would choose the right pose from any grid.
SCORE_ALONE = ("success_uncorrected", "success_rotated_raster")


@dataclass
class Questions:
    """Poses of one room with their scans and priors."""

    map: PreparedMap
    T_map_robot: list[Pose2]
    priors: list[Window]
    scans: list[Scan]


@dataclass
class Tally:
    """Answers judged."""

    asked: int = 0
    right: int = 0
    found: int = 0
    found_right: int = 0
    answers: list[tuple[Pose2, bool, str, float]] = field(default_factory=list)  # truth, right, verdict, p

    def add(self, truth: Pose2, result: SearchResult) -> None:
        right = bool(result.hypotheses) and is_right(result.hypotheses[0].T_map_robot_unrefined, truth)
        found = result.verdict == "found"
        self.asked += 1
        self.right += right
        self.found += found
        self.found_right += found and right
        probability = result.hypotheses[0].probability if result.hypotheses else 0.0
        self.answers.append((truth, right, result.verdict, probability))

    @property
    def success(self) -> float:
        return self.right / self.asked


def is_right(estimate: Pose2, truth: Pose2) -> bool:
    """The paper's: one cell and 7 degrees."""
    slack = 1e-6
    return (
        translation_distance(estimate, truth) <= WITHIN_M + slack
        and angle_distance(estimate.theta_rad, truth.theta_rad) <= math.radians(WITHIN_DEG) + slack
    )


def sonar_ring(range_noise_relative: float = 0.0) -> Sensor:
    """14 sonars evenly around the robot's outline."""
    axes = [2.0 * math.pi * k / 14 for k in range(14)]
    mounts = [Pose2(ROBOT_RADIUS_M * math.cos(a), ROBOT_RADIUS_M * math.sin(a), a) for a in axes]
    beams = [Beam(mount, half_angle_rad=math.radians(6.0), range_max_m=8.0) for mount in mounts]
    return Sensor(beams, "sonar ring", 0.0, range_noise_relative)


def make_questions(
    rng: np.random.Generator, map: PreparedMap, poses: int, *, on_lattice: bool, disturbed: bool = False
) -> Questions:
    """Random poses where the robot fits; the estimate's cell is one of the window's around the pose's."""
    clearance_cells = np.sqrt(map.squared_distance_cells())
    fits = np.argwhere(clearance_cells > ROBOT_RADIUS_M / RESOLUTION_M + 1e-9)
    truths, priors = [], []
    for row, col in fits[rng.integers(len(fits), size=poses)]:
        x, y = (col + 0.5) * RESOLUTION_M, (row + 0.5) * RESOLUTION_M
        theta = float(rng.uniform(-math.pi, math.pi))
        off_x, off_y = (0.0, 0.0) if on_lattice else rng.uniform(-0.5, 0.5, 2) * RESOLUTION_M
        truths.append(Pose2(x + off_x, y + off_y, theta))
        error_x, error_y = rng.integers(-HALF_WINDOW_CELLS, HALF_WINDOW_CELLS + 1, 2) * RESOLUTION_M
        error_deg = float(rng.uniform(-HALF_CONE_DEG, HALF_CONE_DEG))
        if on_lattice:
            error_deg = HEADING_STEP_DEG * round(error_deg / HEADING_STEP_DEG)
        half_m = HALF_WINDOW_CELLS * RESOLUTION_M
        estimate = Pose2(x + error_x, y + error_y, theta + math.radians(error_deg))
        priors.append(Window(estimate, half_m, half_m, math.radians(HALF_CONE_DEG)))
    sensor = sonar_ring(RANGE_NOISE if disturbed else 0.0)
    scans = simulate(map, sensor, truths, noise=disturbed, seed=int(rng.integers(2**31)))
    if disturbed:
        for scan in scans:
            _disturb(rng, scan)
    return Questions(map, truths, priors, scans)


def _disturb(rng: np.random.Generator, scan: Scan) -> None:
    """Crosstalk: another sonar's echo comes first. Multiple reflections: the echo took a longer way."""
    kind = rng.random(len(scan.ranges_m))
    short, long = kind < WRONG_SHARE, (kind >= WRONG_SHARE) & (kind < 2.0 * WRONG_SHARE)
    scan.ranges_m[short] *= rng.uniform(0.3, 0.9, int(short.sum()))
    scan.ranges_m[long] *= rng.uniform(1.1, 2.0, int(long.sum()))


def options() -> dict:
    """As published: 10 cm and 5 degrees."""
    return {
        "translation_step_m": RESOLUTION_M,
        "rotation_step_rad": math.radians(HEADING_STEP_DEG),
        "robot_radius_m": ROBOT_RADIUS_M,
        "distinct_translation_m": DISTINCT_M,
        "distinct_rotation_rad": math.radians(DISTINCT_DEG),
    }


def ask(questions: Questions, method: str, threads: int = 0) -> list[SearchResult]:
    """One answer per scan."""
    return search(
        questions.map, questions.priors, questions.scans, method=method, threads=threads, **options()
    )


@dataclass
class Tallies:
    """Of the paper's table, by the row's name."""

    by_score: dict[str, Tally]
    by_ranges: dict[str, Tally]
    asked_reduced: int = 0
    reduced_the_same: int = 0

    @classmethod
    def empty(cls) -> Tallies:
        names = [name for name in ROWS if name.startswith("success_")]
        compared = [name for name in names if name not in SCORE_ALONE]
        return cls({name: Tally() for name in names}, {name: Tally() for name in compared})


def run(seed: int, seeds: int, out: Path) -> dict:
    """The paper's table, its rooms drawn."""
    tallies = Tallies.empty()
    times: dict[str, list[float]] = {}
    with progress_bar() as bar:
        task = bar.add_task("rooms", total=seeds * ROOMS)
        for one in range(seed, seed + seeds):
            rng = np.random.default_rng(one)
            maps = [PreparedMap(make_room(rng), name=f"room {k + 1}") for k in range(ROOMS)]
            drawn: list[Tally] = []
            for k, map in enumerate(maps):
                poses = POSES_PER_SEED * (k + 1) // ROOMS - POSES_PER_SEED * k // ROOMS
                drawn.append(_ask_room(rng, map, poses, tallies))
                bar.advance(task)
            if one == seed:
                _draw_rooms(maps, drawn, out / "grid_rooms.png")
                times = _times(rng, maps[0])
    disturbed = tallies.by_ranges["success_with_crosstalk"]
    return {
        **{name: tally.success for name, tally in (tallies.by_score | tallies.by_ranges).items()},
        "by_score": {name: tally.success for name, tally in tallies.by_score.items()},
        "found_but_wrong": (disturbed.found - disturbed.found_right) / max(1, disturbed.found),
        "right_that_are_found": disturbed.found_right / max(1, disturbed.right),
        "reduced_finds_the_same": tallies.reduced_the_same / tallies.asked_reduced,
        **{name: float(np.median(measured)) for name, measured in times.items()},
        **real_data(seed),
        "poses": disturbed.asked,
        "seed": seed,
        "seeds": seeds,
    }


def _ask_room(rng: np.random.Generator, map: PreparedMap, poses: int, tallies: Tallies) -> Tally:
    """Adds to the tallies; returns that of this room's disturbed readings."""
    on_lattice = make_questions(rng, map, poses, on_lattice=True)
    _judge(on_lattice, "grid_uncorrected", tallies.by_score["success_uncorrected"])
    _judge(on_lattice, "grid_turned", tallies.by_score["success_rotated_raster"])
    _judge(on_lattice, "grid_published", tallies.by_score["success_corrected"])
    full = ask(on_lattice, "grid")
    _add(on_lattice, full, tallies.by_ranges["success_corrected"])
    _compare(full, ask(on_lattice, "grid_reduced"), tallies)
    anywhere = make_questions(rng, map, poses, on_lattice=False)
    _judge(anywhere, "grid_published", tallies.by_score["success_continuous"])
    _judge(anywhere, "grid", tallies.by_ranges["success_continuous"])
    disturbed = make_questions(rng, map, poses, on_lattice=False, disturbed=True)
    _judge(disturbed, "grid_published", tallies.by_score["success_with_crosstalk"])
    return _judge(disturbed, "grid", tallies.by_ranges["success_with_crosstalk"])


def _judge(questions: Questions, method: str, total: Tally) -> Tally:
    return _add(questions, ask(questions, method), total)


def _add(questions: Questions, results: Sequence[SearchResult], total: Tally) -> Tally:
    here = Tally()
    for truth, result in zip(questions.T_map_robot, results, strict=True):
        here.add(truth, result)
        total.add(truth, result)
    return here


def _compare(full: Sequence[SearchResult], reduced: Sequence[SearchResult], tallies: Tallies) -> None:
    """Whether the first hypotheses are the same pose of the lattice."""
    for one, other in zip(full, reduced, strict=True):
        tallies.asked_reduced += 1
        if one.hypotheses and other.hypotheses:
            a, b = one.hypotheses[0].T_map_robot_unrefined, other.hypotheses[0].T_map_robot_unrefined
            tallies.reduced_the_same += list(a) == list(b)


def _times(rng: np.random.Generator, map: PreparedMap) -> dict[str, list[float]]:
    """Milliseconds of processor time in one thread, scan by scan, the map prepared."""
    questions = make_questions(rng, map, TIMED, on_lattice=True)
    times: dict[str, list[float]] = {"search_ms": [], "local_grids_ms": []}
    for prior, scan in zip(questions.priors, questions.scans, strict=True):
        local_grids_ms, matching_ms = time_grid_matching(map, prior, scan, search_options(**options()), 5)
        times["local_grids_ms"].append(local_grids_ms)
        times["search_ms"].append(matching_ms)
    for method, name in (("grid", "whole_search_ms"), ("grid_reduced", "whole_reduced_search_ms")):
        ask(questions, method)
        times[name] = []
        for prior, scan in zip(questions.priors, questions.scans, strict=True):
            start_s = time.thread_time()
            ask(Questions(map, [], [prior], [scan]), method, threads=1)
            times[name].append(1e3 * (time.thread_time() - start_s))
    return times


def table(result: dict) -> list[list[str]]:
    """Ours beside the paper's."""
    rows = [["", "unit", "paper", "best score alone", "ranges compared"]]
    for name, label in ROWS.items():
        paper = f"{100.0 * PAPER[name]:.0f}" if name in PAPER else ""
        by_score = f"{100.0 * result['by_score'][name]:.2f}" if name in result["by_score"] else ""
        compared = "" if name in SCORE_ALONE else f"{100.0 * result[name]:.2f}"
        rows.append([label, "%", paper, by_score, compared])
    rows.append(["matching at all poses, one core", "ms", "", f"{result['search_ms']:.2f}", ""])
    both_ms = result["search_ms"] + result["local_grids_ms"]
    rows.append(["the same with drawing the 19 local grids", "ms", "", f"{both_ms:.2f}", ""])
    rows.append(["whole search() call, one core", "ms", "", "", f"{result['whole_search_ms']:.2f}"])
    rows.append(["the same by reduced grids", "ms", "", "", f"{result['whole_reduced_search_ms']:.2f}"])
    return rows + real_rows(result)


def _draw_rooms(maps: Sequence[PreparedMap], tallies: Sequence[Tally], path: Path) -> None:
    """The rooms with the poses of disturbed readings, by verdict; crosses where the answer was wrong."""
    from matplotlib.figure import Figure  # takes a while to import

    from landfall.pictures import VERDICT_COLORS, draw_map, known_box

    figure = Figure(figsize=(5.0 * len(maps), 5.4), layout="constrained")
    for axes, map, tally in zip(figure.subplots(1, len(maps)), maps, tallies, strict=True):
        draw_map(axes, map.grid, known_box(map.grid), 5.0)
        for right, marker, size in ((True, "o", 7), (False, "x", 30)):
            for verdict, color in VERDICT_COLORS.items():
                at = [pose for pose, was, given, _ in tally.answers if was == right and given == verdict]
                if at:
                    label = f"{verdict}, {'right' if right else 'wrong'}: {len(at)}"
                    x, y = [pose.x_m for pose in at], [pose.y_m for pose in at]
                    axes.scatter(
                        x, y, s=size, marker=marker, color=color, linewidths=1.0, label=label, zorder=3
                    )
        axes.set_title(f"{map.name}: {100.0 * tally.success:.1f} % right of {tally.asked}", fontsize=11)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), fontsize=8, ncols=2)
    figure.suptitle(
        "14 sonars with crosstalk, multiple reflections and noise; prior within 80 cm and 45 degrees"
    )
    figure.savefig(path, dpi=110, facecolor="white", bbox_inches="tight")
