"""The volume of correlations, the minimum filter and masks from Python."""

from __future__ import annotations

import math

import landfall
import numpy as np
import pytest
from landfall import Beam, GridMap, PreparedMap, Scan, Sensor


@pytest.fixture
def room() -> PreparedMap:
    """6 x 4 m in cells of 0.1 m, with a cupboard."""
    cells = np.zeros((40, 60), np.uint8)
    cells[[0, -1], :] = 1
    cells[:, [0, -1]] = 1
    cells[30:35, 10:25] = 1
    return PreparedMap(GridMap(cells, 0.1, (1.0, -2.0, 0.4)))


@pytest.fixture
def scan(room: PreparedMap) -> Scan:
    sensor = landfall.make_fan(60, -math.pi, 2.0 * math.pi / 60)
    return landfall.simulate(room, sensor, [(*room.grid.center_of(20, 40), 0.9)], noise=False)[0]


def test_the_volumes_maximum_is_the_searchs(room: PreparedMap, scan: Scan) -> None:
    step = math.pi / 36
    volume = landfall.correlation_volume(room, scan, rotation_step_rad=step)
    assert volume.scores.shape == (72, 40, 60)
    assert volume.scores.dtype == np.float32
    free = np.where(room.grid.cells == 0, volume.scores, -np.inf)
    result = landfall.search(room, None, scan, method="fft", rotation_step_rad=step)
    best = max(result.hypotheses, key=lambda hypothesis: hypothesis.score)
    assert round(float(free.max())) == best.score
    heading, row, col = np.unravel_index(int(np.argmax(free)), free.shape)
    x_m, y_m = room.grid.center_of(int(row), int(col))
    pose = best.T_map_robot_unrefined
    assert (pose.x_m, pose.y_m) == pytest.approx((x_m, y_m))
    assert landfall.angle_distance(pose.theta_rad, heading * step + 0.4) < 1e-9
    assert result.method.startswith("fft (")


def test_the_volume_is_read_only_and_outlives_its_owner(room: PreparedMap, scan: Scan) -> None:
    scores = landfall.correlation_volume(room, scan, rotation_step_rad=3.0).scores
    total = float(scores.sum())
    with pytest.raises(ValueError):
        scores[0, 0, 0] = 1.0
    assert float(scores.sum()) == total


def test_any_values_may_take_the_fields_place(room: PreparedMap, scan: Scan) -> None:
    values = np.zeros((40, 60), np.float32)
    values[5, 7] = 2.0
    volume = landfall.correlation_volume(room, scan, rotation_step_rad=7.0 / 2, values=values)
    # each echo sees that one cell from exactly one cell, unless that lies off the map
    assert volume.scores.sum() <= 2.0 * scan.count_echoes() + 1.0
    assert volume.scores.max() >= 2.0 - 1e-3
    with pytest.raises(landfall.InvalidArgument):
        landfall.correlation_volume(room, scan, values=np.zeros((3, 3)))
    with pytest.raises(landfall.InvalidArgument):
        landfall.correlation_volume(room, scan, values=np.zeros(2400))
    with pytest.raises(landfall.InvalidArgument, match=r"\(60, 40\), expected \(40, 60\)"):
        landfall.correlation_volume(room, scan, values=np.zeros((60, 40)))


def test_the_minimum_filter_keeps_what_faces_a_wall() -> None:
    sensor = Sensor([Beam((0.0, 0.0, 0.0), range_max_m=9.0)], "sonar")
    turn = [Scan(sensor, [range_m]) for range_m in (5.0, 4.0, 3.0, 4.0, 6.0)]
    kept = landfall.keep_local_minima(turn)
    assert [not math.isnan(scan.ranges_m[0]) for scan in kept] == [False, False, True, False, False]
    merged = landfall.merge_turn(kept)
    assert merged.count_echoes() == 1
    assert math.atan2(*merged.points_robot()[0][::-1]) == pytest.approx(4.0 * math.pi / 5)


def test_masks_blur_a_map(room: PreparedMap) -> None:
    mask = landfall.raised_cosine_mask(7)
    assert mask.shape == (7, 7)
    assert mask[3, 3] == 1.0
    assert not mask[0].any()
    blurred = landfall.blurred_map(room.grid, mask)
    assert blurred.shape == (40, 60)
    assert blurred[15, 30] == 0.0
    assert blurred[32, 15] == pytest.approx(mask.sum(), rel=1e-5)
    with pytest.raises(landfall.InvalidArgument):
        landfall.raised_cosine_mask(6)
    with pytest.raises(landfall.InvalidArgument):
        landfall.blurred_map(room.grid, np.zeros((3, 5)))
    with pytest.raises(landfall.InvalidArgument, match=r"\(1, 9\)"):
        landfall.blurred_map(room.grid, np.zeros((1, 9)))


def test_a_plateau_is_one_end_point_in_its_middle() -> None:
    beam = Beam((0.0, 0.0, 0.0), half_angle_rad=math.radians(15.0), range_max_m=9.0)
    sensor = Sensor([beam], "sonar", range_noise_m=0.01)
    ranges = [9.0] * 72
    ranges[10:17] = [2.0] * 7  # 50 to 80 degrees
    scan = landfall.merge_turn_minima([Scan(sensor, [range_m]) for range_m in ranges])
    points = scan.points_robot()
    assert len(points) == 3
    assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(2.0)
    assert np.degrees(np.arctan2(points[:, 1], points[:, 0])) == pytest.approx(65.0)
    with pytest.raises(landfall.InvalidArgument):
        landfall.merge_turn_minima([])
