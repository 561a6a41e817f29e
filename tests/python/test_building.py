"""The demo's building: a drive that nothing stands in the way of, the same for the same seed."""

from __future__ import annotations

import landfall
import numpy as np
import pytest
from landfall import building, drives


@pytest.mark.parametrize("seed", range(5))
def test_drive_keeps_clear_of_walls(seed):
    made = building.make_building(seed)
    grid = made.wall_map().to_grid(outside_unknown=True)
    clearance_m = 0.05 * np.sqrt(landfall.PreparedMap(grid).squared_distance_cells())
    cells = [grid.cell_of(pose.x_m, pose.y_m) for pose in drives.drive(made, seed)]
    assert len(cells) > 100
    assert min(clearance_m[row, col] for row, col in cells) > 0.2


def test_same_seed_same_building():
    assert building.make_building(3).walls == building.make_building(3).walls
    assert building.make_building(3).walls != building.make_building(4).walls


def test_people_hide_the_share_that_was_asked(prepared):
    poses = [landfall.Pose2(1.5, 2.0, 0.1 * k) for k in range(10)]
    seen = drives.record(prepared, poses, seed=1, people=0.0)
    crowded = drives.record(prepared, poses, seed=1, people=0.2)
    shorter = np.mean([a.ranges_m - b.ranges_m > 0.3 for a, b in zip(seen, crowded, strict=True)])
    assert 0.05 < shorter < 0.3
