"""landfall reproduce grid on real sonars and a real laser, where the data are."""

from __future__ import annotations

import landfall.reproduce._corridor8 as corridor8
import landfall.reproduce._grid_on_real_data as real
import numpy as np
import pytest
from landfall import translation_distance


@pytest.fixture
def halves(data, monkeypatch):
    monkeypatch.setenv("LANDFALL_DATA", str(data))
    log = corridor8.load_corridor8()
    if log is None:
        pytest.skip("no sonar/corridor8")
    return corridor8.make_halves(log)


def test_windows_are_of_the_stretches_that_are_not_mapped(halves):
    assert len(halves) == 2
    for half, other in zip(halves, reversed(halves), strict=True):
        assert len(half.windows) == len(half.T_map_robot) > 20
        cells = half.map.cells
        assert 0.01 < (cells == 1).mean() < 0.2
        for pose in half.T_map_robot:
            assert min(translation_distance(pose, mapped) for mapped in other.T_map_robot) > 0.3


def test_windows_see_a_metre_of_the_way(halves):
    beams = {len(window.ranges_m) for half in halves for window in half.windows}
    assert min(beams) >= 8 * 5
    assert all(count % 8 == 0 for count in beams)


def test_the_published_score_finds_half_of_the_windows(halves):
    rng = np.random.default_rng(1)
    near = []
    for half in halves:
        priors = [real._around(rng, pose) for pose in half.T_map_robot]
        results = real._ask_sonars(half.map, priors, half.windows, "grid_published")
        near += real._judge(results, half.T_map_robot, real.SONAR_NEAR)
    assert np.mean(near) > 0.4


def test_without_data_nothing_is_reported(monkeypatch, tmp_path, capsys):
    monkeypatch.setenv("LANDFALL_DATA", str(tmp_path))
    assert real.real_data(1) == {}
    assert real.real_rows({}) == []
    assert capsys.readouterr().err.count("skipped") == 2
