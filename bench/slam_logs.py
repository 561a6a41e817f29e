"""SLAM on real logs: maps from scans alone, or with odometry as the prediction, beside the reference maps;
then intel's queries are relocalized in the map that SLAM made.

    .venv/bin/python bench/slam_logs.py [--only intel,trace1] [--out pictures] [--results bench/RESULTS.md]
"""

from __future__ import annotations

import argparse
import gzip
import itertools
import math
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import landfall
import numpy as np
from landfall.map_pictures import PATH, draw_built_map, save_figure
from landfall.pictures import draw_map, in_map, known_box
from matplotlib.figure import Figure
from results_page import rewrite_measured, table

ROOT = Path(__file__).resolve().parent.parent
NEAR_S = 0.1  # of a relation's stamps to those of keyframes
RIGHT_M, RIGHT_RAD = 0.25, math.radians(3.0)
CELL_M = 0.05  # these scanners' echoes lie 5 to 20 cm apart
ALONE = {"prediction": "constant_velocity"}
Poses = Sequence[landfall.Pose2]


def intel_scans(folder: Path) -> tuple[list[landfall.Scan], list[landfall.Pose2]]:
    """All keyframes by time stamp, and their corrected poses."""
    mapped = [(scan, scan.T_map_robot) for scan in landfall.load_log(folder / "map.log.gz").scans]
    queries = landfall.load_log(folder / "query.log.gz").scans
    truth = landfall.load_trajectory(folder / "truth.tum")
    asked = [(scan, pose) for scan, (_, pose) in zip(queries, truth, strict=True)]
    both = sorted([*mapped, *asked], key=lambda one: one[0].stamp_s)
    return [scan for scan, _ in both], [pose for _, pose in both]


def run(scans: Sequence[landfall.Scan], **options: object) -> tuple[landfall.SlamResult, dict]:
    """The result, and what every log is judged by. Times are of the processor, recoveries left out."""
    spent: list[float] = []
    start = time.thread_time()

    def on_step(_: landfall.Slam, step: landfall.SlamStep) -> None:
        nonlocal start
        now = time.thread_time()
        if step.recovery_ms == 0.0:
            spent.append(1000.0 * (now - start))
        start = now

    result = landfall.slam(scans, on_step, resolution_m=CELL_M, **options)
    steps = result.steps
    return result, {
        "scans": len(steps),
        "accepted": sum(step.accepted for step in steps) / len(steps),
        "recovered": sum(step.recovered for step in steps),
        "ms_mean": float(np.mean(spent)),
        "ms_max": float(np.max(spent)),
    }


def fitted(estimate: Poses, truth: Poses) -> landfall.Pose2:
    """T_truth_estimate: the motion that takes one path onto the other, least squares over the positions."""
    a, b = (np.array([(pose.x_m, pose.y_m) for pose in path]) for path in (estimate, truth))
    mean_a, mean_b = a.mean(axis=0), b.mean(axis=0)
    (xx, xy), (yx, yy) = (a - mean_a).T @ (b - mean_b)
    theta = math.atan2(xy - yx, xx + yy)
    x, y = mean_b - in_map(landfall.Pose2(0.0, 0.0, theta), mean_a[None])[0]
    return landfall.Pose2(float(x), float(y), theta)


def path_errors(estimate: Poses, truth: Poses) -> dict:
    """Metres and degrees, after the best motion of the whole."""
    T_truth_estimate = fitted(estimate, truth)
    moved = [T_truth_estimate * pose for pose in estimate]
    off = [landfall.translation_distance(a, b) for a, b in zip(moved, truth, strict=True)]
    turned = [landfall.angle_distance(a.theta_rad, b.theta_rad) for a, b in zip(moved, truth, strict=True)]
    return {
        "path_median_m": float(np.median(off)),
        "path_max_m": float(np.max(off)),
        "path_median_deg": math.degrees(float(np.median(turned))),
    }


def relation_errors(file: Path, stamps: np.ndarray, estimate: Poses) -> dict:
    """Beside relative poses that people checked, where both stamps are near keyframes: all, and those of two
    different ones (what the robot moved within a keyframe's NEAR_S nobody estimated)."""
    with gzip.open(file, "rt", encoding="ascii") as lines:
        relations = [tuple(map(float, line.split())) for line in lines]
    off, turned, different = [], [], []
    for first_s, second_s, x, y, *_, theta in relations:
        i, j = (int(np.abs(stamps - s).argmin()) for s in (first_s, second_s))
        if max(abs(stamps[i] - first_s), abs(stamps[j] - second_s)) > NEAR_S:
            continue
        step = estimate[i].inverse() * estimate[j]
        off.append(landfall.translation_distance(step, landfall.Pose2(x, y, theta)))
        turned.append(math.degrees(landfall.angle_distance(step.theta_rad, theta)))
        different.append(i != j)
    two = np.array(different)
    return {
        "relations": len(off),
        "relations_mean_m": float(np.mean(off)),
        "relations_median_m": float(np.median(off)),
        "relations_mean_deg": float(np.mean(turned)),
        "two_keyframes": int(two.sum()),
        "two_keyframes_median_m": float(np.median(np.array(off)[two])),
        "two_keyframes_median_deg": float(np.median(np.array(turned)[two])),
    }


def relocalized(grid: landfall.GridMap, scans: Sequence[landfall.Scan], truth: Poses) -> float:
    """Share of the scans found without prior in a map, first hypothesis, refined."""
    results = landfall.search(landfall.PreparedMap(grid), None, list(scans))
    right = [
        bool(result.hypotheses)
        and landfall.translation_distance(result.hypotheses[0].T_map_robot, pose) <= RIGHT_M
        and landfall.angle_distance(result.hypotheses[0].T_map_robot.theta_rad, pose.theta_rad) <= RIGHT_RAD
        for result, pose in zip(results, truth, strict=True)
    ]
    return sum(right) / len(right)


def path_length(path: Poses) -> float:
    """In metres, of the places half a metre apart: noise makes no way."""
    kept = [path[0]]
    for pose in path:
        if landfall.translation_distance(kept[-1], pose) >= 0.5:
            kept.append(pose)
    return sum(landfall.translation_distance(a, b) for a, b in itertools.pairwise(kept))


def intel(data: Path, out: Path) -> dict:
    folder = data / "intel"
    scans, truth = intel_scans(folder)
    result, numbers = run(scans, prediction="odometry")
    poses = [step.T_map_robot for step in result.steps]
    stamps = np.array([scan.stamp_s for scan in scans])
    numbers |= path_errors(poses, truth)
    numbers |= relation_errors(folder / "relations.gz", stamps, poses)
    corrected = relation_errors(folder / "relations.gz", stamps, truth)
    numbers |= {f"corrected_{key}": value for key, value in corrected.items()}
    T_estimate_truth = fitted(poses, truth).inverse()
    numbers["relocalized"] = relocalized(result.map, scans[1::2], [T_estimate_truth * p for p in truth[1::2]])
    numbers["relocalized_own_path"] = relocalized(result.map, scans[1::2], poses[1::2])
    reference = landfall.load_map(folder / "map.yaml").grid
    draw(result.map, poses, reference, out / "slam_intel.png", T_estimate_truth.inverse())
    return numbers


def wean_hall(data: Path, out: Path) -> dict:
    """No truth: judged by the picture, and by odometry's length."""
    folder = data / "wean_hall"
    scans = landfall.load_log(folder / "robotdata1.log.gz").scans
    result, numbers = run(scans, **ALONE)
    poses = [step.T_map_robot for step in result.steps]
    numbers["length"] = path_length(poses) / path_length([scan.T_odom_robot for scan in scans])
    draw(result.map, poses, landfall.load_map(folder / "map.yaml").grid, out / "slam_wean_hall.png")
    return numbers


def trace1(data: Path, out: Path) -> dict:
    """Beside the localizer's poses, good to 10 to 20 cm."""
    scans = landfall.load_log(data / "rosbag" / "trace1.bag").scans
    result, numbers = run(scans, **ALONE)
    poses = [step.T_map_robot for step in result.steps]
    known = [(pose, scan.T_map_robot) for pose, scan in zip(poses, scans, strict=True) if scan.T_map_robot]
    numbers |= path_errors([a for a, _ in known], [b for _, b in known])
    reference = landfall.map_from_known_poses(
        [scan for scan in scans if scan.T_map_robot], resolution_m=CELL_M
    )
    T_reference_map = fitted([a for a, _ in known], [b for _, b in known])
    draw(result.map, poses, reference, out / "slam_trace1.png", T_reference_map)
    return numbers


def draw(
    grid: landfall.GridMap,
    path: Poses,
    reference: landfall.GridMap,
    file: Path,
    T_reference_map: landfall.Pose2 | None = None,
) -> None:
    """Our map and path, turned as the map that others made, where that is known, and beside it."""
    figure = Figure(figsize=(13.0, 6.6), layout="constrained")
    ours, theirs = figure.subplots(1, 2)
    if T_reference_map is None:
        draw_built_map(ours, grid, path)
    else:
        placed = landfall.GridMap(grid.cells, grid.resolution_m, T_reference_map * grid.T_map_grid)
        draw_map(ours, placed, known_box(reference), 6.0)
        xy = np.array([(pose.x_m, pose.y_m) for pose in (T_reference_map * one for one in path)])
        ours.plot(xy[:, 0], xy[:, 1], color=PATH, linewidth=1.0)
    ours.set_title("SLAM: map and path")
    draw_map(theirs, reference, known_box(reference), 6.0)
    theirs.set_title("reference")
    save_figure(figure, file)


LOGS = {"intel": intel, "wean_hall": wean_hall, "trace1": trace1}
ROWS = (
    ("scans", "scans", 1.0, 0),
    ("accepted", "accepted [%]", 100.0, 1),
    ("recovered", "of these by the wider search", 1.0, 0),
    ("path_median_m", "path, median error [cm]", 100.0, 1),
    ("path_max_m", "path, largest error [cm]", 100.0, 1),
    ("path_median_deg", "heading, median error [deg]", 1.0, 2),
    ("length", "length of the path over odometry's", 1.0, 3),
    ("relations", "checked relations", 1.0, 0),
    ("relations_mean_m", "mean error [cm]", 100.0, 1),
    ("relations_median_m", "median error [cm]", 100.0, 1),
    ("corrected_relations_mean_m", "the corrected poses' mean error [cm]", 100.0, 1),
    ("corrected_relations_median_m", "and median error [cm]", 100.0, 1),
    ("relations_mean_deg", "mean error [deg]", 1.0, 2),
    ("corrected_relations_mean_deg", "the corrected poses' [deg]", 1.0, 2),
    ("two_keyframes", "of these between two keyframes", 1.0, 0),
    ("two_keyframes_median_m", "median error [cm]", 100.0, 1),
    ("corrected_two_keyframes_median_m", "the corrected poses' [cm]", 100.0, 1),
    ("two_keyframes_median_deg", "median error [deg]", 1.0, 2),
    ("relocalized", "queries found in our map, corrected poses [%]", 100.0, 1),
    ("relocalized_own_path", "queries found in our map, our path [%]", 100.0, 1),
    ("ms_mean", "a scan, mean [ms of processor time]", 1.0, 2),
    ("ms_max", "a scan, largest [ms]", 1.0, 2),
)


def log_table(measured: dict) -> list[list[str]]:
    rows = [["", *measured]]
    for key, label, factor, digits in ROWS:
        cells = [f"{factor * one[key]:.{digits}f}" if key in one else "" for one in measured.values()]
        if any(cells):
            rows.append([label, *cells])
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", default=",".join(LOGS))
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "bench" / "results")
    parser.add_argument("--results", type=Path, help="a page whose part slam_logs is rewritten")
    options = parser.parse_args()
    data = Path(os.environ.get("LANDFALL_DATA", ROOT.parent / "shared" / "data"))
    if not data.is_dir():
        print(f"{data}: no real data: set LANDFALL_DATA", file=sys.stderr)
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    measured = {name: LOGS[name](data, options.out) for name in options.only.split(",")}
    text = table(log_table(measured))
    print(text)
    if options.results is not None:
        rewrite_measured(options.results, {"slam_logs": text})
    return 0


if __name__ == "__main__":
    sys.exit(main())
