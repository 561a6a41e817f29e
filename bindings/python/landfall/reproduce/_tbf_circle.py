"""The circle: a map that sonars alone made, and sonars of another drive that find themselves in it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from landfall._landfall import (
    GridMap,
    Pose2,
    PreparedMap,
    Scan,
    SearchResult,
    Window,
    angle_distance,
    merge,
    translation_distance,
)
from landfall.reproduce._office_corridor import STEP_M
from landfall.searching import search

COMPOSITE_M = 2.0  # of driving
THIN = 4  # every fourth scan of it
QUESTION_M = 3.0  # from one question to the next
STEP_RAD = math.radians(2.0)
RIGHT_M, RIGHT_RAD = 0.25, math.radians(5.0)
DRIFT, DRIFT_RAD_PER_M = 0.02, 0.01  # odometry within a composite: of the way, and of heading
WINDOW_M, WINDOW_RAD = 0.8, math.radians(45.0)  # what method `grid` is told: within this of the truth
FIELD_SIGMA_M = 0.1


def composites(scans: Sequence[Scan], rng: np.random.Generator) -> list[tuple[Pose2, Scan]]:
    """Truth and composite scan, its relative poses from drifting odometry."""
    T_map_robot = [scan.T_map_robot or Pose2() for scan in scans]  # all are set
    T_odom_robot = _odometry(T_map_robot, rng)
    length, every = round(COMPOSITE_M / STEP_M), round(QUESTION_M / STEP_M)
    asked = []
    for last in range(length, len(scans), every):
        part = slice(last - length, last + 1, THIN)
        asked.append((T_map_robot[last], merge(list(scans[part]), T_odom_robot[part])))
    return asked


def _odometry(T_map_robot: Sequence[Pose2], rng: np.random.Generator) -> list[Pose2]:
    T_odom_robot = [Pose2()]
    for before, after in itertools.pairwise(T_map_robot):
        step = before.inverse() * after
        driven_m = translation_distance(before, after)
        scale = 1.0 + DRIFT * float(rng.normal())
        turn_rad = step.theta_rad + DRIFT_RAD_PER_M * math.sqrt(driven_m) * float(rng.normal())
        T_odom_robot.append(T_odom_robot[-1] * Pose2(step.x_m * scale, step.y_m * scale, turn_rad))
    return T_odom_robot


def localize(
    grid: GridMap, asked: Sequence[tuple[Pose2, Scan]], method: str, rng: np.random.Generator
) -> list[SearchResult]:
    """`fft` is told nothing; `grid` a window somewhere about the truth."""
    map = PreparedMap(grid, field_sigma_m=FIELD_SIGMA_M)
    scans = [scan for _, scan in asked]
    if method == "fft":
        return search(map, None, scans, method=method, rotation_step_rad=STEP_RAD)
    priors = [_window(truth, rng) for truth, _ in asked]
    return search(map, priors, scans, method=method, rotation_step_rad=STEP_RAD)


def _window(truth: Pose2, rng: np.random.Generator) -> Window:
    off = rng.uniform(-1.0, 1.0, 3) * (WINDOW_M, WINDOW_M, WINDOW_RAD)
    center = Pose2(truth.x_m + off[0], truth.y_m + off[1], truth.theta_rad + off[2])
    return Window(center, WINDOW_M, WINDOW_M, WINDOW_RAD)


def is_right(truth: Pose2, result: SearchResult) -> bool:
    if not result.hypotheses:
        return False
    best = result.hypotheses[0].T_map_robot
    return (
        translation_distance(best, truth) <= RIGHT_M
        and angle_distance(best.theta_rad, truth.theta_rad) <= RIGHT_RAD
    )


def is_within_a_metre(truth: Pose2, result: SearchResult) -> bool:
    return bool(result.hypotheses) and translation_distance(result.hypotheses[0].T_map_robot, truth) <= 1.0
