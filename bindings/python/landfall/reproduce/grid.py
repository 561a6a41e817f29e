"""Static localization of a wheelchair by occupancy grids (Courcelle & Horn 1999), sections 4 to 6.

Three furnished rooms per seed, a ring of 14 sonars whose cones are 12 degrees wide, random poses, and an
estimate that is off by up to 80 cm and 45 degrees. The paper does not give its rooms, nor mounts and ranges
of the sonars: those are ours. A beam measures the nearest obstacle in its cone.

The pose that counts is the method's own, unrefined: that of the best score, which is the paper's answer
("by_score"), and that of the first hypothesis, chosen among the best by ranges cast against the map.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
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
    translation_distance,
)
from landfall.reproduce._furnished_rooms import RESOLUTION_M, make_room
from landfall.searching import search

ROOMS = 3
POSES_PER_SEED = 1000
TIMED = 200
HALF_WINDOW_CELLS = 8
HALF_CONE_DEG, HEADING_STEP_DEG = 45.0, 5.0
ROBOT_RADIUS_M = 0.3
WITHIN_M, WITHIN_DEG = 0.1, 7.0
# "found" is about this very pose: poses a little farther off than what counts as right are its rivals.
DISTINCT_M, DISTINCT_DEG = 0.12, 7.5
HYPOTHESES = 16  # rivals whose ranges are compared
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
}


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
    right_by_score: int = 0
    found: int = 0
    found_right: int = 0
    answers: list[tuple[Pose2, bool, str, float]] = field(default_factory=list)  # truth, right, verdict, p

    def add(self, truth: Pose2, result: SearchResult) -> None:
        right = bool(result.hypotheses) and is_right(result.hypotheses[0].T_map_robot_unrefined, truth)
        best = max(result.hypotheses, key=lambda one: one.score, default=None)
        self.right_by_score += best is not None and is_right(best.T_map_robot_unrefined, truth)
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

    @property
    def success_by_score(self) -> float:
        return self.right_by_score / self.asked


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


def ask(questions: Questions, method: str, threads: int = 0) -> list[SearchResult]:
    """As published: 10 cm and 5 degrees."""
    return search(
        questions.map,
        questions.priors,
        questions.scans,
        method=method,
        translation_step_m=RESOLUTION_M,
        rotation_step_rad=math.radians(HEADING_STEP_DEG),
        robot_radius_m=ROBOT_RADIUS_M,
        max_hypotheses=HYPOTHESES,
        distinct_translation_m=DISTINCT_M,
        distinct_rotation_rad=math.radians(DISTINCT_DEG),
        threads=threads,
    )


def run(seed: int, seeds: int, out: Path) -> dict:
    """The paper's table, its rooms drawn."""
    tallies = {name: Tally() for name in ROWS if name.startswith("success_")}
    propose_ms: list[float] = []
    total_ms: list[float] = []
    for one in range(seed, seed + seeds):
        rng = np.random.default_rng(one)
        maps = [PreparedMap(make_room(rng), name=f"room {k + 1}") for k in range(ROOMS)]
        drawn: list[Tally] = []
        for k, map in enumerate(maps):
            poses = POSES_PER_SEED * (k + 1) // ROOMS - POSES_PER_SEED * k // ROOMS
            drawn.append(_ask_room(rng, map, poses, tallies))
        if one == seed:
            _draw_rooms(maps, drawn, out / "grid_rooms.png")
            for result in _timed(rng, maps[0]):
                propose_ms.append(result.times.propose_ms)
                total_ms.append(result.times.total_ms)
    disturbed = tallies["success_with_crosstalk"]
    return {
        **{name: tally.success for name, tally in tallies.items()},
        "by_score": {name: tally.success_by_score for name, tally in tallies.items()},
        "found_but_wrong": (disturbed.found - disturbed.found_right) / max(1, disturbed.found),
        "right_that_are_found": disturbed.found_right / max(1, disturbed.right),
        "search_ms": float(np.median(propose_ms)),
        "whole_search_ms": float(np.median(total_ms)),
        "poses": disturbed.asked,
        "seed": seed,
        "seeds": seeds,
    }


def _ask_room(rng: np.random.Generator, map: PreparedMap, poses: int, tallies: dict[str, Tally]) -> Tally:
    """Adds to the tallies; returns that of this room's disturbed readings."""
    on_lattice = make_questions(rng, map, poses, on_lattice=True)
    _judge(on_lattice, "grid_uncorrected", tallies["success_uncorrected"])
    _judge(on_lattice, "grid", tallies["success_corrected"])
    _judge(on_lattice, "grid_turned", tallies["success_rotated_raster"])
    anywhere = make_questions(rng, map, poses, on_lattice=False)
    _judge(anywhere, "grid", tallies["success_continuous"])
    disturbed = make_questions(rng, map, poses, on_lattice=False, disturbed=True)
    return _judge(disturbed, "grid", tallies["success_with_crosstalk"])


def _judge(questions: Questions, method: str, total: Tally) -> Tally:
    here = Tally()
    for truth, result in zip(questions.T_map_robot, ask(questions, method), strict=True):
        here.add(truth, result)
        total.add(truth, result)
    return here


def _timed(rng: np.random.Generator, map: PreparedMap) -> Iterable[SearchResult]:
    """One after the other, on one thread, the map prepared."""
    questions = make_questions(rng, map, TIMED, on_lattice=True)
    ask(questions, "grid")
    for prior, scan in zip(questions.priors, questions.scans, strict=True):
        yield ask(Questions(map, [], [prior], [scan]), "grid", threads=1)[0]


def table(result: dict) -> list[list[str]]:
    """Ours beside the paper's."""
    rows = [["", "unit", "paper", "best score alone", "ranges compared"]]
    for name, label in ROWS.items():
        paper = f"{100.0 * PAPER[name]:.0f}" if name in PAPER else ""
        by_score = f"{100.0 * result['by_score'][name]:.2f}" if name in result["by_score"] else ""
        rows.append([label, "%", paper, by_score, f"{100.0 * result[name]:.2f}"])
    rows.append(["19 local grids and their search, one core", "ms", "", f"{result['search_ms']:.2f}", ""])
    rows.append(["whole search() call, one core", "ms", "", "", f"{result['whole_search_ms']:.2f}"])
    return rows


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
