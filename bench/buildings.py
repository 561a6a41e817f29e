"""The five buildings: every query without prior, alone and in windows, and how honest the answers are."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import landfall
import numpy as np
from landfall.evaluation import Estimate, judge, report
from landfall.interrupts import CleanStop
from landfall.outputs import ResultsFile
from landfall.relocalization import Answers, Question, Tally, relocalize, tie_together
from landfall.searching import search_options
from landfall.windows import Query, scan_windows, single_queries

NAMES = ("intel", "csail", "aces", "acapulco", "infinite_corridor")
WRONG_TRUTH = {"csail": frozenset({198, 199})}  # headings wrong by 11 degrees
RIGHT_M, RIGHT_RAD = 0.25, math.radians(3.0)
STEP_M, STEP_RAD = 0.10, math.radians(1.5)
WINDOW_SCANS = 5
COARSE_RAD = math.radians(15.0)  # heading step at which exhaustive search is affordable


@dataclass
class Building:
    """A map, its queries and their truth."""

    name: str
    folder: Path
    wrong_truth: Collection[int] = field(init=False)

    def __post_init__(self) -> None:
        self.wrong_truth = WRONG_TRUTH.get(self.name, frozenset())

    @cached_property
    def map(self) -> landfall.PreparedMap:
        prepared = landfall.load_map(self.folder / "map.yaml")
        prepared.prepare()
        return prepared

    @cached_property
    def scans(self) -> list[landfall.Scan]:
        return landfall.load_log(self.folder / "query.log.gz").scans

    @cached_property
    def truth(self) -> list[tuple[float, landfall.Pose2]]:
        return landfall.load_trajectory(self.folder / "truth.tum")

    def ask(self, queries: Sequence[Query], one_at_a_time: bool = False) -> tuple[Answers, Tally]:
        return relocalize_all(self.scans, queries, self.question(one_at_a_time))

    def question(self, one_at_a_time: bool = False) -> Question:
        return Question([self.map], landfall.Anywhere(), search_options(), one_at_a_time)

    def judge(self, estimates: Sequence[Estimate], exclude: Collection[int] = ()) -> dict:
        judged = judge(self.truth, estimates, estimates_are_queries=True, exclude=exclude)
        return report(judged, RIGHT_M, RIGHT_RAD)


def relocalize_all(
    log: Sequence[landfall.Scan], queries: Sequence[Query], question: Question
) -> tuple[Answers, Tally]:
    """`landfall relocalize` without files and progress; every result is kept."""
    answers, tally = Answers(), Tally()
    relocalize(
        log,
        queries,
        question,
        answers=answers,
        tally=tally,
        results_file=ResultsFile(None),
        keep=lambda _: True,
        on_progress=lambda _: None,
        stop=CleanStop(),
    )
    return answers, tally


def first_hypotheses(answers: Answers) -> list[Estimate]:
    """What `landfall evaluate` reads from result lines."""
    estimates = []
    for result in answers.kept.values():
        best = result.hypotheses[0] if result.hypotheses else None
        pose, probability = (best.T_map_robot, best.probability) if best else (None, None)
        estimates.append(Estimate(result.stamp_s, pose, probability, result.verdict))
    return estimates


def measure(building: Building, others: Sequence[Building], every: int, say: Callable[[str], None]) -> dict:
    """All numbers of one building, as report.py --json prints them."""
    say("preparation")
    numbers: dict = {"every": every, "prepare": preparation(building)}
    say("exhaustive search")
    numbers["exhaustive"] = exhaustive(building)
    say("single scans")
    answers, numbers["single"] = single_scans(building, every)
    say("the log as a whole")
    T_map_tied, numbers["consistent"] = consistent(building, answers if every == 1 else None)
    say("one at a time")
    numbers["latency"] = latency(building, 100 // min(every, 5))
    numbers["tracking"] = tracking(building, 100 // min(every, 5))
    say("other buildings' maps")
    numbers["foreign"] = foreign(building, others, 50 // min(every, 10))
    say("windows")
    numbers["windows"] = windows(building, every)
    say("relative poses")
    numbers["align"] = aligned_steps(building, every, T_map_tied)
    return numbers


def preparation(building: Building) -> dict:
    grid = landfall.load_grid_map(building.folder / "map.yaml")
    start_s = time.perf_counter()
    fresh = landfall.PreparedMap(grid)
    fresh.prepare()
    return {"seconds": time.perf_counter() - start_s, "bytes": fresh.memory_bytes}


def exhaustive(building: Building) -> dict:
    """Branch and bound against exhaustive search on a lattice that is coarse in heading."""
    equal = 0
    scans = _evenly(building.scans, 3)
    for scan in scans:
        answers = [
            landfall.search(
                building.map, None, scan, method=method, rotation_step_rad=COARSE_RAD, max_hypotheses=8
            )
            for method in ("exhaustive", "branch_and_bound")
        ]
        poses = [[(h.score, *h.T_map_robot_unrefined) for h in answer.hypotheses] for answer in answers]
        equal += poses[0] == poses[1] and answers[1].proven
    return {"queries": len(scans), "share": equal / len(scans)}


def single_scans(building: Building, every: int) -> tuple[Answers, dict]:
    answers, tally = building.ask(single_queries(len(building.scans), every))
    numbers = building.judge(first_hypotheses(answers))
    numbers["scans_per_s"] = len(tally.verdicts) / (time.monotonic() - tally.started_s)
    return answers, numbers


def consistent(building: Building, answers: Answers | None) -> tuple[dict[int, landfall.Pose2 | None], dict]:
    """Of all queries, or where only some were asked, of a tenth of the log without gaps; the poses too."""
    if answers is None:
        count = len(building.scans) // 10
        middle = len(building.scans) // 2
        answers, _ = building.ask([Query(i, i) for i in range(middle - count // 2, middle + count // 2)])
    tie_together(answers, building.scans, building.question())
    estimates = [
        Estimate(stamp_s, pose) for stamp_s, pose in zip(answers.stamps_s, answers.poses, strict=True)
    ]
    T_map_tied = {query.last: pose for query, pose in zip(answers.queries, answers.poses, strict=True)}
    return T_map_tied, building.judge(estimates, building.wrong_truth)


def latency(building: Building, count: int) -> dict:
    """Each scan with all threads to itself."""
    queries = _evenly(single_queries(len(building.scans)), count)
    _, tally = building.ask(queries, one_at_a_time=True)
    median, p95, longest = np.percentile(tally.search_ms, [50, 95, 100])
    return {"queries": len(queries), "median_ms": median, "p95_ms": p95, "max_ms": longest}


def tracking(building: Building, count: int) -> dict:
    """Each scan in a window of 1 m and 30 degrees (full width) whose middle is off the truth, all threads."""
    off = landfall.Pose2(0.2, -0.13, 0.05)
    search_ms = []
    for k in _evenly(range(len(building.scans)), count):
        window = landfall.Window(building.truth[k][1] * off, 0.5, 0.5, math.radians(15.0))
        search_ms.append(landfall.search(building.map, window, building.scans[k]).times.total_ms)
    return {"queries": len(search_ms), "median_ms": float(np.median(search_ms))}


def foreign(building: Building, others: Sequence[Building], count: int) -> dict:
    """Queries asked on maps that they were not taken in: none should be found."""
    scans = _evenly(building.scans, count)
    found = {
        other.name: sum(result.verdict == "found" for result in landfall.search(other.map, None, scans))
        for other in others
    }
    asked = len(scans) * len(others)
    return {"asked": asked, "found": found, "share": sum(found.values()) / asked if asked else None}


def windows(building: Building, every: int) -> dict:
    queries = scan_windows(len(building.scans), WINDOW_SCANS, disjoint=False, every=every)
    answers, _ = building.ask(queries)
    return building.judge(first_hypotheses(answers), building.wrong_truth)


def aligned_steps(building: Building, every: int, T_map_tied: Mapping[int, landfall.Pose2 | None]) -> dict:
    """align()'s relative poses of neighbouring scans against the truth's; either against those of the log as
    a whole, which knows the map."""
    queries = scan_windows(len(building.scans), WINDOW_SCANS, disjoint=False, every=every)
    with ThreadPoolExecutor() as pool:  # align releases the GIL
        poses = list(
            pool.map(lambda q: landfall.align(building.scans[q.first : q.last + 1], threads=1), queries)
        )
    errors, aligned_as_tied, true_as_tied = [], [], []
    for query, T_window_robot in zip(queries, poses, strict=True):
        for k in range(WINDOW_SCANS - 1):
            before, after = query.first + k, query.first + k + 1
            if {before, after} & set(building.wrong_truth):
                continue
            step = T_window_robot[k].inverse() * T_window_robot[k + 1]
            true_step = building.truth[before][1].inverse() * building.truth[after][1]
            errors.append(_step_error(step, true_step))
            T_map_before, T_map_after = T_map_tied.get(before), T_map_tied.get(after)
            if T_map_before is None or T_map_after is None:
                continue
            tied_step = T_map_before.inverse() * T_map_after
            aligned_as_tied.append(_is_small(_step_error(step, tied_step)))
            true_as_tied.append(_is_small(_step_error(true_step, tied_step)))
    right = sum(map(_is_small, errors))
    return {
        "steps": len(errors),
        "right": right,
        "share": right / len(errors),
        "as_consistent": _mean(aligned_as_tied),
        "truth_as_consistent": _mean(true_as_tied),
        "median_m": float(np.median([metres for metres, _ in errors])),
        "median_deg": math.degrees(np.median([radians for _, radians in errors])),
    }


def _step_error(step: landfall.Pose2, true_step: landfall.Pose2) -> tuple[float, float]:
    return (
        landfall.translation_distance(step, true_step),
        landfall.angle_distance(step.theta_rad, true_step.theta_rad),
    )


def _is_small(error: tuple[float, float]) -> bool:
    metres, radians = error
    return metres <= STEP_M and radians <= STEP_RAD


def _mean(flags: Sequence[bool]) -> float | None:
    return sum(flags) / len(flags) if flags else None


def _evenly(items: Sequence, wanted: int) -> list:
    wanted = min(wanted, len(items))
    return [items[round(k * (len(items) - 1) / max(wanted - 1, 1))] for k in range(wanted)]
