"""A log against maps, in chunks: progress, a clean stop, everything finished so far on disk."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from landfall._landfall import (
    Pose2,
    PosePrior,
    PreparedMap,
    Scan,
    SearchOptions,
    SearchResult,
    consistent,
    follow,
    polish,
    search_batch,
)
from landfall.interrupts import CleanStop
from landfall.outputs import ResultsFile
from landfall.windows import Composition, Query, compose, odometry

CHUNK_S = 1.0  # work between two looks at the clock: the bar moves and Ctrl-C is answered
MAX_CHUNK = 4096
CONSISTENT_HYPOTHESES = 20  # to choose among, at least


@dataclass
class Question:
    """What is asked of each query."""

    maps: Sequence[PreparedMap]
    prior: PosePrior
    options: SearchOptions
    one_at_a_time: bool = False  # each scan has all threads to itself
    composition: Composition = field(default_factory=Composition)

    def ask(self, log: Sequence[Scan], queries: Sequence[Query]) -> list[SearchResult]:
        scans = compose(log, queries, self.composition)
        if not self.one_at_a_time:
            return search_batch(self.maps, [self.prior], scans, self.options)
        return [search_batch(self.maps, [self.prior], [scan], self.options)[0] for scan in scans]


@dataclass
class Tally:
    """The numbers of the table at the end, without the results themselves."""

    verdicts: list[str] = field(default_factory=list)
    search_ms: list[float] = field(default_factory=list)
    reasons: Counter[str] = field(default_factory=Counter)  # why lost
    started_s: float = field(default_factory=time.monotonic)

    def add(self, result: SearchResult) -> None:
        self.verdicts.append(result.verdict)
        self.search_ms.append(result.times.total_ms)
        if result.verdict == "lost":
            self.reasons[result.reason] += 1

    def rows(self) -> list[tuple[str, str]]:
        count = len(self.verdicts)
        wall_s = time.monotonic() - self.started_s
        rows = [("queries", str(count))]
        for verdict in ("found", "ambiguous", "lost"):
            share = 100.0 * self.verdicts.count(verdict) / max(count, 1)
            rows.append((verdict, f"{self.verdicts.count(verdict)} ({share:.1f} %)"))
        rows += [(f"  {reason}", str(lost)) for reason, lost in self.reasons.most_common()]
        if count:
            median, p95 = np.percentile(self.search_ms, [50, 95])
            rows.append(("search_ms, median", f"{median:.2f}"))
            rows.append(("search_ms, 95th percentile", f"{p95:.2f}"))
        rate = count / max(wall_s, 1e-9)
        rows.append(("queries/s", f"{rate:.1f}" if rate >= 1 else f"{rate:.2g}"))
        return rows


@dataclass
class Answers:
    """What later steps need of every query: its best pose, and the result itself where it is kept."""

    queries: list[Query] = field(default_factory=list)
    stamps_s: list[float] = field(default_factory=list)
    poses: list[Pose2 | None] = field(default_factory=list)
    verdicts: list[str] = field(default_factory=list)
    map_indices: list[int] = field(default_factory=list)
    choices: list[int] = field(default_factory=list)  # of the hypotheses, -1: none
    tied: bool = False  # chosen by odometry over all queries
    kept: dict[int, SearchResult] = field(default_factory=dict)  # by position

    def add(self, query: Query, result: SearchResult, keep: bool) -> None:
        if keep:
            self.kept[len(self.queries)] = result
        self.queries.append(query)
        self.stamps_s.append(result.stamp_s)
        self.verdicts.append(result.verdict)
        self._append_choice(result, 0 if result.hypotheses else -1)

    def _append_choice(self, result: SearchResult, choice: int) -> None:
        best = result.hypotheses[choice] if choice >= 0 else None
        self.choices.append(choice)
        self.poses.append(best.T_map_robot if best else None)
        self.map_indices.append(best.map_index if best else 0)

    def choose(self, choices: Sequence[int]) -> None:
        """Replaces the first hypotheses by the chosen ones; every result must have been kept."""
        self.poses, self.map_indices, self.choices = [], [], []
        for position, choice in enumerate(choices):
            self._append_choice(self.kept[position], choice)

    def trajectory(self) -> list[tuple[float, Pose2]]:
        return [(s, pose) for s, pose in zip(self.stamps_s, self.poses, strict=True) if pose is not None]


def relocalize(
    log: Sequence[Scan],
    queries: Sequence[Query],
    question: Question,
    *,
    answers: Answers,
    tally: Tally,
    results_file: ResultsFile,
    keep: Callable[[int], bool],
    on_progress: Callable[[int], None],
    stop: CleanStop,
) -> None:
    """Asks the queries chunk by chunk until all are answered or a stop is requested.

    answers, tally: filled as answers come, so that they hold what is finished where an error ends the work.
    keep(position): whether that result stays in memory. on_progress(n): n more are done.
    """
    size, position = 1, 0
    while position < len(queries) and not stop.requested:
        chunk = queries[position : position + size]
        started_s = time.monotonic()
        for query, result in zip(chunk, question.ask(log, chunk), strict=True):
            results_file.write(result.to_json(query.last))
            answers.add(query, result, keep(len(answers.queries)))
            tally.add(result)
        results_file.flush()
        on_progress(len(chunk))
        position += len(chunk)
        size = _next_size(size, time.monotonic() - started_s)


def tie_together(answers: Answers, log: Sequence[Scan], question: Question) -> None:
    """Puts the most probable sequence of hypotheses in place of each query's first; every result was kept.

    Where odometry leads to a place which a query did not list, the query is asked again there. Scans asked
    alone then end up where they and their neighbours fit the map best together.
    """
    scans = compose(log, answers.queries, question.composition)
    kept = [answers.kept[position] for position in range(len(answers.queries))]
    results = follow(question.maps, scans, kept, question.options)
    choices = consistent(results, odometry(scans))
    results = polish(question.maps, scans, results, choices, question.options.threads)
    answers.kept = dict(enumerate(results))
    answers.choose(choices)
    answers.tied = True


def _next_size(size: int, took_s: float) -> int:
    """Twice as many while a chunk is quick, half as many when it is slow."""
    if took_s < CHUNK_S / 2:
        return min(2 * size, MAX_CHUNK)
    return max(size // 2, 1) if took_s > 2 * CHUNK_S else size
