"""What pictures are made of."""

from __future__ import annotations

import math

import landfall
import numpy as np
import pytest
from landfall.pictures import in_map, known_box, thin


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
