"""What pictures are made of."""

from __future__ import annotations

import math

import landfall
import numpy as np
import pytest
from landfall.answer_picture import answer_figure
from landfall.echoes import EXPLAINED, LONG, SHORT, judge_echoes
from landfall.pictures import draw_scale, in_map, known_box, thin
from matplotlib.figure import Figure


def test_thinning_keeps_walls():
    cells = np.full((6, 7), 2, dtype=np.uint8)
    cells[0, 1] = 0
    cells[3, 3] = 1
    cells[3, 2] = 0
    assert thin(cells, 3).tolist() == [[0, 2, 2], [0, 1, 2]]
    assert thin(cells, 1) is cells


def test_points_go_to_the_map():
    moved = in_map(landfall.Pose2(1.0, 2.0, math.pi / 2), np.array([[3.0, 0.5]]))
    assert moved == pytest.approx(np.array([[0.5, 5.0]]))


def test_box_follows_known_cells():
    cells = np.full((40, 60), 2, dtype=np.uint8)
    cells[10:20, 30:50] = 0
    box = known_box(landfall.GridMap(cells, 0.1, (-1.0, 5.0, 0.0)))
    assert box == pytest.approx((2.0 - 0.04, 4.0 + 0.04, 6.0 - 0.04, 7.0 + 0.04))


def test_echoes_are_judged_one_by_one(prepared, laser):
    """A person before the wall, and a wall that was taken away: from the ranges that the map foretells."""
    at = landfall.Pose2(2.0, 2.0, 0.3)
    ranges_m = landfall.simulate_ranges(prepared, laser, [at])[0]
    scan = landfall.Scan(laser, ranges_m)
    points = in_map(at, scan.points_robot())
    assert (judge_echoes(prepared, scan, at, points) == EXPLAINED).all()
    ranges_m[40:50] = 0.7
    ranges_m[100:110] += 1.5
    ranges_m[0] = math.nan  # no echo, no judgement
    scan = landfall.Scan(laser, ranges_m)
    judged = judge_echoes(prepared, scan, at, in_map(at, scan.points_robot()))
    assert len(judged) == 180
    assert (judged[39:49] == SHORT).all() and (judged[99:109] == LONG).all()
    assert (judged == EXPLAINED).sum() == 160


def test_scale_is_a_round_length():
    axes = Figure().subplots()
    for width_m, expected in ((42.0, "5 m"), (12.0, "2 m"), (240.0, "20 m"), (3.0, "0.5 m")):
        axes.set_xlim(0, width_m)
        draw_scale(axes)
        assert axes.artists[-1].txt_label.get_text() == expected


@pytest.mark.parametrize(("verdicts", "panels"), [(["found"], 2), (["ambiguous"], 3)])
def test_a_rival_is_shown_where_the_best_is_not_sure(prepared, verdicts, panels):
    """Two mirrored poses in an empty square room cannot be told apart; in the small building they can."""
    square = landfall.PreparedMap(landfall.WallMap([[0, 0, 6, 0], [6, 0, 6, 6], [6, 6, 0, 6], [0, 6, 0, 0]]))
    map = prepared if verdicts == ["found"] else square
    laser = landfall.make_fan(181, -math.pi / 2, math.radians(1.0), range_max_m=20.0)
    (scan,) = landfall.simulate(map, laser, [landfall.Pose2(2.0, 2.2, 0.2)], seed=1)
    result = landfall.search(map, None, scan)
    assert [result.verdict] == verdicts
    assert len(answer_figure([map], scan, result).axes) == panels
