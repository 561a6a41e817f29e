"""Which scans a window holds, by hand."""

from __future__ import annotations

import landfall
import pytest
from landfall.windows import Composition, Query, scan_windows, single_queries, time_windows, with_motion


@pytest.fixture
def log(laser):
    """Stamps 0, 1, 2, 3, 7, 8; the robot stands until 2, then drives a metre a scan."""
    stamps = [0.0, 1.0, 2.0, 3.0, 7.0, 8.0]
    x_m = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0]
    return [landfall.Scan(laser, [1.0] * 181, s, (x, 0, 0)) for s, x in zip(stamps, x_m, strict=True)]


def test_single():
    assert single_queries(5, every=2) == [Query(0, 0), Query(2, 2), Query(4, 4)]


def test_five_scans_answer_for_every_scan_from_the_fifth():
    assert scan_windows(7, 5, disjoint=False) == [Query(0, 4), Query(1, 5), Query(2, 6)]
    assert scan_windows(7, 3, disjoint=True) == [Query(0, 2), Query(3, 5)]
    assert scan_windows(3, 5, disjoint=False) == []


def test_sliding_seconds(log):
    assert time_windows(log, 2.0, disjoint=False) == [Query(1, 2), Query(2, 3), Query(4, 4), Query(4, 5)]


def test_disjoint_seconds(log):
    assert time_windows(log, 2.0, disjoint=True) == [Query(0, 1), Query(2, 3), Query(4, 5)]


def test_windows_without_motion_are_left_out(log):
    queries = time_windows(log, 2.0, disjoint=True)
    assert with_motion(log, queries, 0.5) == [Query(2, 3), Query(4, 5)]


def test_composite_is_seen_from_the_last_scan(scans):
    composite = Query(2, 6).scan(scans, Composition())
    assert len(composite) == 5 * 181 and composite.stamp_s == scans[6].stamp_s
    assert composite.ranges_m[-181:] == pytest.approx(scans[6].ranges_m)
    assert len(Query(2, 6).scan(scans, Composition(max_scans=3))) == 3 * 181


def test_odometry_as_it_is(scans):
    composite = Query(2, 3).scan(scans, Composition(aligned=False))
    assert composite.points_robot() == pytest.approx(landfall.merge(scans[2:4]).points_robot())
