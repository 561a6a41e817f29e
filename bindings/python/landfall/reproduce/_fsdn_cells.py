"""What a number of cells costs: the same starts for every number, in search spaces of several sizes.

The cost of a number of cells is the expected cost of a right answer: the mean over all starts, those that
fail included with all that they spent, over the share of starts that are answered rightly. Means, not
medians: a network that a false place holds for long is rare, and costs most.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from landfall._landfall import (
    Anywhere,
    DiffusionRun,
    Pose2,
    PreparedMap,
    Scan,
    Sensor,
    Window,
    angle_distance,
    run_diffusion,
    simulate,
    translation_distance,
)
from landfall.reproduce._workshop import HEIGHT_M, WIDTH_M, Workshop, make_room, make_workshop

NEAR_M, NEAR_RAD = 0.2, math.radians(10.0)  # so near a mode is the right one, before refinement
RAW_M, RAW_RAD = 0.01, math.radians(1.0)
STARTS_A_PLACE = 5
PART_HALF_M = 4.5  # of the window that is a part of a workshop
WALL_M = 0.2  # between workshops side by side
RESAMPLES = 2000
SPACES = ("room of 4 x 4 m", "9 x 9 m of a workshop", "workshop", "four workshops")


@dataclass
class Start:
    map: PreparedMap
    prior: Anywhere | Window
    scan: Scan
    truth: Pose2
    seed: int


@dataclass
class Spent:
    """Until the right mode was found, or in all where none was."""

    right: bool
    raw: bool  # the network's own estimate is good to 1 cm and 1 degree
    processor_ms: float
    wall_ms: float
    rays: float
    iterations: float


def make_starts(space: str, count: int, sensor: Sensor, seed: int) -> list[Start]:
    """From places 0, 1, ... of a kind, STARTS_A_PLACE in each."""
    starts: list[Start] = []
    place_seed = seed
    while len(starts) < count:
        rng = np.random.default_rng([place_seed, 10])
        place, truths = _place(space, place_seed, rng)
        map = place.map()
        for scan, truth in zip(simulate(map, sensor, truths, seed=place_seed), truths, strict=True):
            starts.append(Start(map, _prior(space, truth, rng), scan, truth, seed=1000 * seed + len(starts)))
        place_seed += 1
    return starts[:count]


def spend(start: Start, cells: int, threads: int = 1) -> Spent:
    """The networks until the right mode, which nearly always is the first."""
    for modes in (1, 32):
        run = run_diffusion(
            start.map, start.prior, start.scan, cells=cells, max_modes=modes, threads=threads, seed=start.seed
        )
        spent = _until_right(run, start.truth)
        if spent.right:
            break
    return spent


def chosen_cells(start: Start) -> int:
    return run_diffusion(start.map, start.prior, start.scan, max_modes=1).cells


def search_space(start: Start) -> float:
    """In regions of the top level."""
    return run_diffusion(start.map, start.prior, start.scan, max_modes=1).regions


def over_best(costs: np.ndarray, right: np.ndarray, chosen: int) -> tuple[float, float, float]:
    """Of costs[number of cells, start]: the chosen number's expected cost over the least of all, and where it
    lies in 95 % of the resamplings of the starts. The least is looked for in each resampling anew, which
    favours the other numbers."""
    rng = np.random.default_rng(0)
    starts = costs.shape[1]
    ratios = []
    for _ in range(RESAMPLES):
        drawn = rng.integers(starts, size=starts)
        expected = _expected(costs[:, drawn], right[:, drawn])
        ratios.append(expected[chosen] / expected.min())
    expected = _expected(costs, right)
    low, high = np.percentile(ratios, (2.5, 97.5))
    return float(expected[chosen] / expected.min()), float(low), float(high)


def compare(starts: Sequence[Start], numbers: Sequence[int], chosen: int) -> dict:
    """Rows by number of cells, and how the chosen one compares: [ratio, low, high] by time and by rays."""
    numbers = sorted({*numbers, chosen})
    spent = [[spend(start, cells) for start in starts] for cells in numbers]
    right = np.array([[one.right for one in row] for row in spent], dtype=float)
    processor_ms = np.array([[one.processor_ms for one in row] for row in spent])
    rays = np.array([[one.rays for one in row] for row in spent])
    rows = [
        {
            "cells": cells,
            "success": float(right[i].mean()),
            "success_raw": float(np.mean([one.raw for one in spent[i]])),
            "cpu_ms": float(_expected(processor_ms, right)[i]),
            "cpu_ms_median": float(np.median(processor_ms[i])),
            "cpu_ms_p95": float(np.percentile(processor_ms[i], 95)),
            "rays": float(_expected(rays, right)[i]),
            "iterations": float(np.median([one.iterations for one in spent[i]])),
        }
        for i, cells in enumerate(numbers)
    ]
    at = numbers.index(chosen)
    return {
        "chosen": chosen,
        "starts": len(starts),
        "rows": rows,
        "cpu_over_best": over_best(processor_ms, right, at),
        "rays_over_best": over_best(rays, right, at),
    }


def _expected(costs: np.ndarray, right: np.ndarray) -> np.ndarray:
    with np.errstate(divide="ignore"):
        return np.asarray(costs.sum(axis=1) / right.sum(axis=1))


def _until_right(run: DiffusionRun, truth: Pose2) -> Spent:
    iterations = 0.0
    for mode in run.modes:
        iterations += mode.iterations
        pose = mode.T_map_robot
        turned_rad = angle_distance(pose.theta_rad, truth.theta_rad)
        if translation_distance(pose, truth) > NEAR_M or turned_rad > NEAR_RAD:
            continue
        off_m = max(abs(pose.x_m - truth.x_m), abs(pose.y_m - truth.y_m))
        raw = off_m <= RAW_M and turned_rad <= RAW_RAD
        rays = float(mode.found_rays_cast)
        return Spent(True, raw, mode.found_processor_ms, mode.found_ms, rays, iterations)
    return Spent(False, False, run.processor_ms, run.total_ms, float(run.rays_cast), float(run.iterations))


def _place(space: str, seed: int, rng: np.random.Generator) -> tuple[Workshop, list[Pose2]]:
    if space == "four workshops":
        return _four_workshops(seed, rng)
    place = make_room(seed) if space.startswith("room") else make_workshop(seed)
    return place, place.random_poses(STARTS_A_PLACE, rng)


def _prior(space: str, truth: Pose2, rng: np.random.Generator) -> Anywhere | Window:
    if "of a workshop" not in space:
        return Anywhere()
    off = rng.uniform(-PART_HALF_M, PART_HALF_M, 2)
    return Window(Pose2(truth.x_m + off[0], truth.y_m + off[1], 0.0), PART_HALF_M, PART_HALF_M, math.pi)


def _four_workshops(seed: int, rng: np.random.Generator) -> tuple[Workshop, list[Pose2]]:
    """Two by two, all different."""
    all_four = Workshop(size_m=(2 * WIDTH_M + WALL_M, 2 * HEIGHT_M + WALL_M))
    truths: list[Pose2] = []
    for k in range(4):
        workshop = make_workshop(10_000 + 4 * seed + k)
        dx, dy = (k % 2) * (WIDTH_M + WALL_M), (k // 2) * (HEIGHT_M + WALL_M)
        all_four.walls += [(x1 + dx, y1 + dy, x2 + dx, y2 + dy) for x1, y1, x2, y2 in workshop.walls]
        poses = workshop.random_poses(STARTS_A_PLACE, rng)
        truths += [Pose2(pose.x_m + dx, pose.y_m + dy, pose.theta_rad) for pose in poses]
    chosen = rng.permutation(len(truths))[:STARTS_A_PLACE]
    return all_four, [truths[i] for i in chosen]
