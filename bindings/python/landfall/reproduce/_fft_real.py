"""Method fft on real data: a drive of eight sonars along a corridor, and a building seen by a laser."""

from __future__ import annotations

import math
import statistics
import time

from landfall._landfall import (
    Pose2,
    PreparedMap,
    SearchResult,
    angle_distance,
    load_map,
    translation_distance,
)
from landfall.logs import load_log
from landfall.progress import progress_bar
from landfall.reproduce._corridor8 import data_folder, load_corridor8, make_halves
from landfall.reproduce._fft_volume import HEADINGS, STEP_RAD, argmax, correlate
from landfall.searching import search

RIGHT_M, RIGHT_RAD = 0.5, math.radians(10.0)
INTEL_SCANS = 12


def corridor8() -> dict | None:
    """Windows of 1 m of driving, each a composite scan, on a map of the stretches between; None: no data."""
    log = load_corridor8()
    if log is None:
        return None
    right, right_by_search, free_poses = [], [], []
    for half in make_halves(log):
        map = PreparedMap(half.map)
        free_poses.append(HEADINGS * int((half.map.cells == 0).sum()))
        for window, T_map_robot in zip(half.windows, half.T_map_robot, strict=True):
            right.append(_is_right(argmax(half.map, correlate(map, window)), T_map_robot))
            found = search(map, None, window, method="fft", rotation_step_rad=STEP_RAD).hypotheses
            right_by_search.append(bool(found) and _is_right(found[0].T_map_robot, T_map_robot))
    return {
        "windows": len(right),
        "free_poses": free_poses,
        "success": statistics.mean(right),
        "success_search_refined": statistics.mean(right_by_search),
    }


def intel() -> dict | None:
    """fft's best score beside exhaustive's, and its time beside branch_and_bound's; None: no data."""
    folder = data_folder() / "intel"
    if not (folder / "map.yaml").exists():
        return None
    map = load_map(str(folder / "map.yaml"))
    scans = load_log(folder / "query.log.gz").scans
    sample = scans[:: max(1, len(scans) // INTEL_SCANS)][:INTEL_SCANS]
    best: dict[str, list[int]] = {"fft": [], "exhaustive": []}
    times_ms: dict[str, list[float]] = {"fft": [], "branch_and_bound": []}
    ways: dict[str, int] = {}
    for method in times_ms:
        search(map, None, sample[0], method=method)  # prepares the map
    with progress_bar() as bar:
        task = bar.add_task("intel", total=len(sample))
        for scan in sample:
            for method in times_ms:
                start = time.process_time()
                result = search(map, None, scan, method=method, threads=1)
                times_ms[method].append(1e3 * (time.process_time() - start))
                if method == "fft":
                    best["fft"].append(_best_score(result))
                    ways[result.method] = ways.get(result.method, 0) + 1
            best["exhaustive"].append(_best_score(search(map, None, scan, method="exhaustive")))
            bar.advance(task)
    equal = [a == b for a, b in zip(best["fft"], best["exhaustive"], strict=True)]
    return {
        "scans": len(sample),
        "equal_to_exhaustive": statistics.mean(equal),
        "ways": ways,
        "fft_ms": statistics.median(times_ms["fft"]),
        "branch_and_bound_ms": statistics.median(times_ms["branch_and_bound"]),
    }


def _best_score(result: SearchResult) -> int:
    return max((hypothesis.score for hypothesis in result.hypotheses), default=0)


def _is_right(estimate: Pose2, truth: Pose2) -> bool:
    return (
        translation_distance(estimate, truth) <= RIGHT_M
        and angle_distance(estimate.theta_rad, truth.theta_rad) <= RIGHT_RAD
    )
