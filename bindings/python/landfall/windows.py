"""Queries of a log: each scan alone, or windows of consecutive scans, aligned and merged into one."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from landfall._landfall import ALIGNED_NOISE, Pose2, Scan, align, merge, translation_distance
from landfall.errors import InvalidArgument


@dataclass(frozen=True)
class Composition:
    """How the scans of a window become one."""

    max_scans: int = 0  # evenly spread ones of a longer window; 0: all
    aligned: bool = True  # odometry's relative poses polished by scan matching, or as they are
    threads: int = 0


@dataclass(frozen=True)
class Query:
    """Scans first..last of the log, asked as one and answered in scan last's robot frame, under its stamp."""

    first: int
    last: int

    def scan(self, log: Sequence[Scan], composition: Composition) -> Scan:
        """The scan to search: the log's own, or a composite."""
        members = [log[i] for i in _spread(self.first, self.last, composition.max_scans)]
        if len(members) == 1:
            return members[0]
        if not composition.aligned:
            return merge(members)
        reference = len(members) - 1
        return merge(members, align(members, reference, threads=1), reference, ALIGNED_NOISE)


def compose(log: Sequence[Scan], queries: Sequence[Query], composition: Composition) -> list[Scan]:
    """The scan of each query, in order; windows are put together side by side, each on one thread."""
    threads = composition.threads or os.cpu_count()
    with ThreadPoolExecutor(threads) as pool:  # align and merge release the GIL
        return list(pool.map(lambda query: query.scan(log, composition), queries))


def single_queries(count: int, every: int = 1) -> list[Query]:
    """Every n-th scan alone."""
    return [Query(i, i) for i in range(0, count, every)]


def scan_windows(count: int, size: int, disjoint: bool, every: int = 1) -> list[Query]:
    """Windows of `size` scans: i-size+1..i for each i, or one after the other; every n-th of them."""
    step = every * (size if disjoint else 1)
    return [Query(i - size + 1, i) for i in range(size - 1, count, step)]


def time_windows(log: Sequence[Scan], seconds: float, disjoint: bool, every: int = 1) -> list[Query]:
    """The scans of (t_i - seconds, t_i] for each i, or such windows one after the other; every n-th."""
    windows = _disjoint_times(log, seconds) if disjoint else _sliding_times(log, seconds)
    return windows[::every]


def _sliding_times(log: Sequence[Scan], seconds: float) -> list[Query]:
    windows, first = [], 0
    for last, scan in enumerate(log):
        while log[first].stamp_s <= scan.stamp_s - seconds:
            first += 1
        if scan.stamp_s - log[0].stamp_s >= seconds:
            windows.append(Query(first, last))
    return windows


def _disjoint_times(log: Sequence[Scan], seconds: float) -> list[Query]:
    windows, first = [], 0
    for i in range(1, len(log) + 1):
        if i == len(log) or log[i].stamp_s - log[first].stamp_s >= seconds:
            windows.append(Query(first, i - 1))
            first = i
    return windows


def with_motion(log: Sequence[Scan], queries: Sequence[Query], min_motion_m: float) -> list[Query]:
    """Those within which odometry drove at least min_motion_m."""
    return [q for q in queries if path_length_m(log[q.first : q.last + 1]) >= min_motion_m]


def path_length_m(scans: Sequence[Scan]) -> float:
    """Length of odometry's path. Raises InvalidArgument where a scan has no odometry."""
    return math.fsum(translation_distance(a, b) for a, b in itertools.pairwise(odometry(scans)))


def odometry(scans: Sequence[Scan]) -> list[Pose2]:
    """T_odom_robot of each scan. Raises InvalidArgument where one has none."""
    poses = [scan.T_odom_robot for scan in scans if scan.T_odom_robot is not None]
    if len(poses) < len(scans):
        raise InvalidArgument(f"{len(scans) - len(poses)} of {len(scans)} scans have no odometry")
    return poses


def _spread(first: int, last: int, max_scans: int) -> list[int]:
    count = last - first + 1
    if max_scans <= 0 or count <= max_scans:
        return list(range(first, last + 1))
    if max_scans == 1:
        return [last]
    return [first + round(k * (count - 1) / (max_scans - 1)) for k in range(max_scans)]
