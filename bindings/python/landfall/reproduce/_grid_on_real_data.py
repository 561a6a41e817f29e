"""Method `grid` on real data: eight sonars along a corridor, and a laser in an office building.

The sonars are asked inside the paper's prior around a disturbed pose; the laser is asked without prior,
beside `branch_and_bound`. Left out, with a line on stderr, where LANDFALL_DATA has no such folder.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from landfall._landfall import (
    Pose2,
    PreparedMap,
    Scan,
    SearchResult,
    Window,
    angle_distance,
    load_map,
    load_trajectory,
    translation_distance,
)
from landfall.logs import load_log
from landfall.reproduce._corridor8 import WINDOW_M, data_folder, load_corridor8, make_halves
from landfall.searching import search

# The paper's prior and lattice, and what it calls right.
HALF_WINDOW_M, HALF_CONE_RAD = 0.8, math.radians(45.0)
STEP_RAD = math.radians(5.0)
SONAR_RIGHT = (0.1, math.radians(7.0))
# What one cell of a corridor drawn by sonars leaves: its walls are where the cones say, to a few cells.
SONAR_NEAR = (0.3, math.radians(10.0))
# Of a building, as `landfall evaluate` judges.
LASER_RIGHT = (0.25, math.radians(3.0))
LASER_STEP_RAD = math.radians(1.0)
LASER_QUERIES = 40
LASER_METHODS = ("grid_reduced", "branch_and_bound")


def real_data(seed: int) -> dict[str, Any]:
    """What of it there is: {"corridor8": ..., "laser": ...}."""
    found: dict[str, Any] = {}
    for name, ask in (("corridor8", _corridor8), ("laser", lambda _: _laser())):
        answer = ask(seed)
        if answer is None:
            print(f"reproduce grid: {name} is skipped: no such data in {data_folder()}", file=sys.stderr)
        else:
            found[name] = answer
    return found


def real_rows(result: dict) -> list[list[str]]:
    """Rows of the table."""
    rows = []
    for name, label in (
        ("single", "one reading of 8 sonars"),
        ("window", f"readings along {WINDOW_M:.0f} m"),
    ):
        sonar = result.get("corridor8", {}).get(name)
        if sonar:
            title = f"corridor8, {label}, {sonar['queries']} poses"
            rows.append(
                [title, "%", "", f"{100.0 * sonar['by_score']:.1f}", f"{100.0 * sonar['success']:.1f}"]
            )
            within = f"{title}: within {SONAR_NEAR[0]} m and {math.degrees(SONAR_NEAR[1]):.0f} degrees"
            rows.append(
                [within, "%", "", f"{100.0 * sonar['near_by_score']:.1f}", f"{100.0 * sonar['near']:.1f}"]
            )
    for method, one in result.get("laser", {}).get("methods", {}).items():
        title = f"intel, laser, no prior, {result['laser']['queries']} scans: {method}"
        rows.append([title, "%", "", "", f"{100.0 * one['success']:.1f}"])
        rows.append([f"{title}, processor time", "ms", "", "", f"{one['cpu_ms']:.0f}"])
    return rows


def _corridor8(seed: int) -> dict[str, Any] | None:
    log = load_corridor8()
    if log is None:
        return None
    answers = {}
    for name, window_m in (("single", 0.0), ("window", WINDOW_M)):
        rng = np.random.default_rng([seed, 8])
        tallies: dict[str, list[bool]] = {
            "success": [],
            "near": [],
            "by_score": [],
            "near_by_score": [],
            "found": [],
            "found_right": [],
        }
        for half in make_halves(log, window_m=window_m):
            priors = [_around(rng, pose) for pose in half.T_map_robot]
            map = PreparedMap(half.map)
            for method, right, near in (
                ("grid", "success", "near"),
                ("grid_published", "by_score", "near_by_score"),
            ):
                results = _ask_sonars(map, priors, half.windows, method)
                tallies[right] += _judge(results, half.T_map_robot, SONAR_RIGHT)
                tallies[near] += _judge(results, half.T_map_robot, SONAR_NEAR)
                if method == "grid":
                    found = [result.verdict == "found" for result in results]
                    tallies["found"] += found
                    tallies["found_right"] += [
                        f and r
                        for f, r in zip(found, _judge(results, half.T_map_robot, SONAR_NEAR), strict=True)
                    ]
        shares = {key: float(np.mean(values)) for key, values in tallies.items()}
        answers[name] = {**shares, "queries": len(tallies["success"])}
    return answers


def _around(rng: np.random.Generator, T_map_robot: Pose2) -> Window:
    """The paper's window around an estimate that is off by anything within it."""
    x, y = rng.uniform(-HALF_WINDOW_M, HALF_WINDOW_M, 2)
    turn = rng.uniform(-HALF_CONE_RAD, HALF_CONE_RAD)
    estimate = Pose2(T_map_robot.x_m + x, T_map_robot.y_m + y, T_map_robot.theta_rad + turn)
    return Window(estimate, HALF_WINDOW_M, HALF_WINDOW_M, HALF_CONE_RAD)


def _ask_sonars(
    map: PreparedMap, priors: Sequence[Window], scans: Sequence[Scan], method: str
) -> list[SearchResult]:
    return search(
        map,
        priors,
        scans,
        method=method,
        rotation_step_rad=STEP_RAD,
        distinct_translation_m=SONAR_NEAR[0],
        distinct_rotation_rad=SONAR_NEAR[1],
    )


def _judge(
    results: Sequence[SearchResult], truths: Sequence[Pose2], right: tuple[float, float]
) -> list[bool]:
    """Whether the first hypothesis, unrefined, is that near; none is not."""
    judged = []
    for result, truth in zip(results, truths, strict=True):
        estimate = result.hypotheses[0].T_map_robot_unrefined if result.hypotheses else None
        judged.append(
            estimate is not None
            and translation_distance(estimate, truth) <= right[0]
            and angle_distance(estimate.theta_rad, truth.theta_rad) <= right[1]
        )
    return judged


def _laser() -> dict[str, Any] | None:
    folder = data_folder() / "intel"
    if not folder.exists():
        return None
    map = load_map(folder / "map.yaml")
    scans = load_log(folder / "query.log.gz").scans
    truths = [pose for _, pose in load_trajectory(folder / "truth.tum")]
    chosen = np.linspace(0, len(scans) - 1, LASER_QUERIES).round().astype(int)
    methods = {}
    for method in LASER_METHODS:
        results, cpu_ms = [], []
        _ask_laser(map, scans[chosen[0]], method)  # what the map lacks is built
        for i in chosen:
            start_s = time.thread_time()
            results.append(_ask_laser(map, scans[i], method))
            cpu_ms.append(1e3 * (time.thread_time() - start_s))
        right = _judge(results, [truths[i] for i in chosen], LASER_RIGHT)
        methods[method] = {"success": float(np.mean(right)), "cpu_ms": float(np.median(cpu_ms))}
    return {"queries": len(chosen), "methods": methods}


def _ask_laser(map: PreparedMap, scan: Scan, method: str) -> SearchResult:
    """In one thread, at steps of one cell and LASER_STEP_RAD."""
    return search(map, None, scan, method=method, rotation_step_rad=LASER_STEP_RAD, threads=1)
