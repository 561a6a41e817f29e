"""Estimates against truth: success, errors, and whether probabilities and verdicts are honest."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from landfall._landfall import Pose2, angle_distance, load_trajectory, translation_distance
from landfall.errors import FileFormat, FileNotFound, InvalidArgument

STAMP_TOLERANCE_S = 1e-3
PROBABILITY_BINS = (0.0, 0.5, 0.8, 0.9, 0.95, 0.99, 0.999, 1.0)


@dataclass(frozen=True)
class Estimate:
    """The answer to one query; no pose where there was no hypothesis."""

    stamp_s: float
    T_map_robot: Pose2 | None
    probability: float | None = None
    verdict: str | None = None
    map_index: int = 0


@dataclass(frozen=True)
class Judged:
    """One query: its truth's line number (from 0), its errors; infinite without a pose, or on another map."""

    index: int
    translation_m: float
    rotation_rad: float
    estimate: Estimate | None

    def right(self, translation_m: float, rotation_rad: float) -> bool:
        return self.translation_m <= translation_m and self.rotation_rad <= rotation_rad


def load_estimates(path: Path) -> tuple[list[Estimate], bool]:
    """poses.tum or results.jsonl, told by the ending; and whether each line is a query (results.jsonl)."""
    if path.suffix != ".jsonl":
        return [Estimate(stamp_s, pose) for stamp_s, pose in load_trajectory(path)], False
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise FileNotFound(f"{path}: no such file") from None
    except (OSError, UnicodeDecodeError) as cause:
        raise FileFormat(f"{path}: cannot be read: {cause}") from cause
    lines = text.splitlines()
    return [_from_result(path, number, line) for number, line in enumerate(lines, 1) if line.strip()], True


def _from_result(path: Path, number: int, line: str) -> Estimate:
    """The first hypothesis, or the one `relocalize --consistent` chose."""
    try:
        result = json.loads(line)
        hypotheses = result["hypotheses"]
        chosen = result.get("chosen", 0 if hypotheses else -1)
        stamp_s, verdict = float(result["stamp_s"]), str(result["verdict"])
        if chosen < 0:
            return Estimate(stamp_s, None, None, verdict)
        best = hypotheses[chosen]
        pose = Pose2(best["x_m"], best["y_m"], best["theta_rad"])
        map_index = int(best.get("map_index", 0))
        return Estimate(stamp_s, pose, float(best["probability"]), verdict, map_index)
    except (ValueError, KeyError, IndexError, TypeError, AttributeError) as cause:
        what = f"no field {cause}" if isinstance(cause, KeyError) else " ".join(str(cause).split())
        raise FileFormat(f"{path}:{number}: not a result line: {what}") from None


def judge(
    truth: Sequence[tuple[float, Pose2]],
    estimates: Sequence[Estimate],
    *,
    estimates_are_queries: bool,
    skip_first: int = 0,
    exclude: Collection[int] = (),
    truth_map: int | None = None,
) -> list[Judged]:
    """One entry per query, in the truth's order. truth_map: the map on which the truth lies, elsewhere is
    wrong; None: positions alone count.

    Queries are the truth's lines, or where `estimates_are_queries` those that have an estimate. Estimates are
    matched by time stamp, equal ones in order. Raises InvalidArgument where no query is left.
    """
    matched = _match([stamp_s for stamp_s, _ in truth], estimates)
    judged = [
        _judged(index, T_map_robot, matched.get(index), truth_map)
        for index, (_, T_map_robot) in enumerate(truth)
        if index >= skip_first and index not in exclude and (index in matched or not estimates_are_queries)
    ]
    if not judged:
        raise InvalidArgument(
            f"no query to judge: {len(truth)} lines of truth, {len(estimates)} estimates, "
            f"{len(matched)} with the same time stamp"
        )
    return judged


def _match(truth_stamps_s: Sequence[float], estimates: Sequence[Estimate]) -> dict[int, Estimate]:
    """Truth's line number -> estimate: both in order of time, each used once."""
    matched: dict[int, Estimate] = {}
    order = iter(sorted(range(len(truth_stamps_s)), key=truth_stamps_s.__getitem__))
    line = next(order, None)
    for estimate in sorted(estimates, key=lambda e: e.stamp_s):
        while line is not None and truth_stamps_s[line] < estimate.stamp_s - STAMP_TOLERANCE_S:
            line = next(order, None)
        if line is not None and truth_stamps_s[line] <= estimate.stamp_s + STAMP_TOLERANCE_S:
            matched[line] = estimate
            line = next(order, None)
    return matched


def _judged(index: int, T_map_robot: Pose2, estimate: Estimate | None, truth_map: int | None) -> Judged:
    if estimate is None or estimate.T_map_robot is None:
        return Judged(index, math.inf, math.inf, estimate)
    if truth_map is not None and estimate.map_index != truth_map:
        return Judged(index, math.inf, math.inf, estimate)
    return Judged(
        index,
        translation_distance(T_map_robot, estimate.T_map_robot),
        angle_distance(T_map_robot.theta_rad, estimate.T_map_robot.theta_rad),
        estimate,
    )


def report(judged: Sequence[Judged], translation_m: float, rotation_rad: float) -> dict:
    """All numbers of `landfall evaluate`, as its --json prints them; shares are 0..1."""
    right = [query.right(translation_m, rotation_rad) for query in judged]
    good = [query for query, ok in zip(judged, right, strict=True) if ok]
    answer = {
        "queries": len(judged),
        "answered": sum(q.estimate is not None and q.estimate.T_map_robot is not None for q in judged),
        "right": len(good),
        "success_rate": len(good) / len(judged),
        "within": {"translation_m": translation_m, "rotation_deg": math.degrees(rotation_rad)},
        "translation_m": _quantiles([query.translation_m for query in good]),
        "rotation_deg": _quantiles([math.degrees(query.rotation_rad) for query in good]),
        "wrong_indices": [query.index for query, ok in zip(judged, right, strict=True) if not ok],
    }
    if any(query.estimate is not None and query.estimate.verdict is not None for query in judged):
        answer["verdicts"] = _verdicts(judged, right)
        answer["probability"] = _precision_by_probability(judged, right)
    return answer


def _quantiles(errors: Sequence[float]) -> dict[str, float | None]:
    """Of the successes."""
    if not errors:
        return {"median": None, "p95": None, "max": None}
    median, p95 = np.percentile(errors, [50, 95])
    return {"median": float(median), "p95": float(p95), "max": max(errors)}


def _verdicts(judged: Sequence[Judged], right: Sequence[bool]) -> dict:
    table: dict = {}
    for verdict in ("found", "ambiguous", "lost"):
        flags = [
            ok for q, ok in zip(judged, right, strict=True) if q.estimate and q.estimate.verdict == verdict
        ]
        table[verdict] = {"queries": len(flags), "right": sum(flags)}
    found = table["found"]
    table["found_that_are_right"] = _share(found["right"], found["queries"])
    table["right_that_are_found"] = _share(found["right"], sum(right))
    return table


def _precision_by_probability(judged: Sequence[Judged], right: Sequence[bool]) -> list[dict]:
    rows = []
    for low, high in itertools.pairwise(PROBABILITY_BINS):
        inside = [
            (q.estimate.probability, ok)
            for q, ok in zip(judged, right, strict=True)
            if q.estimate
            and q.estimate.probability is not None
            and _in_bin(q.estimate.probability, low, high)
        ]
        hits = sum(ok for _, ok in inside)
        rows.append(
            {
                "from": low,
                "to": high,
                "queries": len(inside),
                "right": hits,
                "precision": _share(hits, len(inside)),
                "mean_probability": float(np.mean([p for p, _ in inside])) if inside else None,
            }
        )
    return rows


def _in_bin(probability: float, low: float, high: float) -> bool:
    return low <= probability < high or (high == 1.0 and probability >= 1.0)


def _share(part: int, whole: int) -> float | None:
    return part / whole if whole else None
