"""Recorded logs asked without a prior: the focused network beside the searches over the lattice."""

from __future__ import annotations

import math
import os
import statistics
import time
from pathlib import Path

import numpy as np

from landfall._landfall import (
    Pose2,
    PreparedMap,
    Scan,
    angle_distance,
    load_map,
    load_trajectory,
    translation_distance,
)
from landfall.logs import load_log
from landfall.searching import search

BUILDINGS = ("intel", "csail")
QUERIES = {"fsdn": 20, "branch_and_bound": 20, "exhaustive": 1}  # spread over the log
RIGHT_M, RIGHT_RAD = 0.5, math.radians(10.0)


def ask_logs(seed: int) -> dict:
    """Per building and method success and processor time; empty where LANDFALL_DATA is not there."""
    data = Path(os.environ.get("LANDFALL_DATA", "../shared/data"))
    answer: dict = {}
    for building in BUILDINGS:
        folder = data / building
        if not folder.is_dir():
            continue
        prepared = load_map(folder / "map.yaml")
        prepared.prepare()
        scans = load_log(folder / "query.log.gz").scans
        truths = [pose for _, pose in load_trajectory(folder / "truth.tum")]
        answer[building] = {
            method: _ask(prepared, scans, truths, method, queries, seed)
            for method, queries in QUERIES.items()
        }
    return answer


def _ask(
    map: PreparedMap, scans: list[Scan], truths: list[Pose2], method: str, queries: int, seed: int
) -> dict:
    right, found, times = [], [], []
    for i in np.linspace(0, len(scans) - 1, queries).astype(int):
        start_s = time.process_time()
        result = search(map, None, scans[i], method=method, threads=1, seed=seed)
        times.append(1e3 * (time.process_time() - start_s))
        best = result.hypotheses[0].T_map_robot if result.hypotheses else None
        right.append(
            best is not None
            and translation_distance(best, truths[i]) <= RIGHT_M
            and angle_distance(best.theta_rad, truths[i].theta_rad) <= RIGHT_RAD
        )
        found.append(result.verdict == "found")
    return {
        "queries": queries,
        "success": float(np.mean(right)),
        "found_but_wrong": float(np.mean(np.array(found) & ~np.array(right))),
        "cpu_ms_median": statistics.median(times),
    }
