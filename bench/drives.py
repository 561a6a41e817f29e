"""Drives without a surveyed truth: Wean Hall, judged by map and odometry, and a bag with a localizer's tf."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from pathlib import Path

import landfall
from buildings import relocalize_all
from landfall.relocalization import CONSISTENT_HYPOTHESES, Answers, Question, tie_together
from landfall.searching import search_options
from landfall.trajectory_picture import draw_trajectory
from landfall.windows import Composition, odometry, single_queries, time_windows, with_motion

WINDOW_S = 5.0
WINDOW_MOTION_M = 0.5
WINDOW_MAX_SCANS = 8  # evenly spread over a window: these scanners give 5 to 10 scans a second
EXPLAINED = 0.7
AGREES_M = 0.5
# The bag's localizer is off by 10 to 20 cm.
LOCALIZER_M, LOCALIZER_RAD = 0.5, math.radians(10.0)


def wean_hall(folder: Path, drive: str, picture: Path) -> dict:
    """Disjoint windows with motion of one drive, each alone and then tied together by odometry."""
    map = landfall.load_map(folder / "map.yaml")
    log = landfall.load_log(folder / f"{drive}.log.gz").scans
    queries = with_motion(log, time_windows(log, WINDOW_S, disjoint=True), WINDOW_MOTION_M)
    options = search_options(max_hypotheses=CONSISTENT_HYPOTHESES)
    question = Question([map], landfall.Anywhere(), options, composition=Composition(WINDOW_MAX_SCANS))
    answers, _ = relocalize_all(log, queries, question)
    T_odom_robot = odometry([log[query.last] for query in queries])
    numbers = {"windows": len(queries), "alone": _explained_and_agreeing(answers, T_odom_robot)}
    tie_together(answers, log, question)
    numbers["tied"] = _explained_and_agreeing(answers, T_odom_robot)
    draw_trajectory([map], answers, picture)
    return numbers


def _explained_and_agreeing(answers: Answers, T_odom_robot: Sequence[landfall.Pose2]) -> dict:
    """Of the chosen hypotheses. Right: explained, and it agrees with the window before (the first: after)."""
    explained = [
        choice >= 0 and answers.kept[position].hypotheses[choice].explained >= EXPLAINED
        for position, choice in enumerate(answers.choices)
    ]
    agrees = _agreements(answers.poses, T_odom_robot)
    right = [e and a for e, a in zip(explained, [agrees[0], *agrees], strict=True)]
    return {
        "explained": sum(explained) / len(explained),
        "neighbours_agree": sum(agrees) / len(agrees),
        "right": sum(right) / len(right),
        "jumps": len(agrees) - sum(agrees),
    }


def _agreements(
    T_map_robot: Sequence[landfall.Pose2 | None], T_odom_robot: Sequence[landfall.Pose2]
) -> list[bool]:
    """Of each pose with the one before it: the step is odometry's, within AGREES_M."""
    return [
        before is not None
        and after is not None
        and landfall.translation_distance(before.inverse() * after, odom_before.inverse() * odom_after)
        <= AGREES_M
        for (before, after), (odom_before, odom_after) in zip(
            itertools.pairwise(T_map_robot), itertools.pairwise(T_odom_robot), strict=True
        )
    ]


def trace1(bag: Path, every: int) -> dict:
    """The second half of the drive on a map of the first, where the first half saw what the second sees."""
    log = landfall.load_log(bag).scans
    half = len(log) // 2
    map = landfall.PreparedMap(landfall.map_from_known_poses(log[:half]))
    second = [log[half:][query.last] for query in single_queries(len(log) - half, every)]
    overlapping = [scan for scan in second if _explained_where_recorded(map, scan) >= EXPLAINED]
    results = landfall.search(map, None, overlapping)
    right = [
        bool(result.hypotheses) and _near(result.hypotheses[0].T_map_robot, scan.T_map_robot)
        for result, scan in zip(results, overlapping, strict=True)
    ]
    found = [ok for result, ok in zip(results, right, strict=True) if result.verdict == "found"]
    return {
        "scans": len(log),
        "asked": len(second),
        "overlapping": len(overlapping),
        "success_rate": sum(right) / len(right),
        "found": len(found),
        "found_that_are_right": sum(found) / len(found) if found else None,
    }


def _explained_where_recorded(map: landfall.PreparedMap, scan: landfall.Scan) -> float:
    try:
        result = landfall.search(map, landfall.CandidatePoses([scan.T_map_robot]), scan)
    except landfall.InvalidArgument:  # off the map
        return 0.0
    return result.hypotheses[0].explained if result.hypotheses else 0.0


def _near(a: landfall.Pose2, b: landfall.Pose2) -> bool:
    close = landfall.translation_distance(a, b) <= LOCALIZER_M
    return close and landfall.angle_distance(a.theta_rad, b.theta_rad) <= LOCALIZER_RAD
