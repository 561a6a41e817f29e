"""Poses, maps, sensors, scans and priors: what they hold, what they share with NumPy, what they refuse."""

from __future__ import annotations

import gc
import math
import pickle

import landfall
import numpy as np
import pytest
from landfall import Pose2


def test_pose_composes_and_inverts():
    T_a_b = Pose2(1.0, 2.0, math.pi / 2)
    T_b_c = Pose2(3.0, 0.0, math.pi / 2)
    T_a_c = T_a_b * T_b_c
    assert list(T_a_c) == pytest.approx([1.0, 5.0, math.pi])
    assert list(T_a_b * T_a_b.inverse()) == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)


def test_pose_is_a_sequence_and_a_value():
    pose = Pose2(1.0, 2.0, 0.5)
    assert np.array([pose, (1, 2, 0.5)]).tolist() == [[1.0, 2.0, 0.5]] * 2
    assert pose == Pose2((1.0, 2.0, 0.5)) and hash(pose) == hash(Pose2(1.0, 2.0, 0.5))
    assert pickle.loads(pickle.dumps(pose)) == pose
    assert pose[-1] == 0.5
    with pytest.raises(IndexError):
        pose[3]


def test_grid_cells_are_a_read_only_view_with_row_zero_at_the_bottom():
    cells = np.array([[1, 0, 2], [0, 0, 1]], dtype=np.uint8)
    grid = landfall.GridMap(cells, 0.5, (10.0, 20.0, 0.0))
    assert np.array_equal(grid.cells, cells)
    assert np.shares_memory(grid.cells, grid.cells)
    assert not grid.cells.flags.writeable
    assert grid.center_of(row=1, col=2) == pytest.approx((11.25, 20.75))
    assert grid.cell_of(11.3, 20.6) == (1, 2)


def test_grid_cells_may_be_numbers_of_any_kind():
    expected = [[1, 0, 2]]
    for cells in (expected, np.array(expected, np.int64), np.array(expected, float)):
        assert landfall.GridMap(cells, 0.5).cells.tolist() == expected
    assert landfall.GridMap(np.array([[True, False]]), 0.5).cells.tolist() == [[1, 0]]
    with pytest.raises(TypeError):
        landfall.GridMap([["wall"]], 0.5)


def test_views_keep_their_owner_alive():
    cells = landfall.GridMap(np.ones((4, 5), dtype=np.uint8), 0.1).cells
    field = landfall.PreparedMap(landfall.GridMap(np.ones((4, 5), dtype=np.uint8), 0.1)).field()
    gc.collect()
    assert cells.sum() == 20
    assert field.shape == (4, 5) and (field == 255).all()


@pytest.mark.parametrize(
    ("cells", "resolution_m", "word"),
    [
        (np.full((2, 2), 3, dtype=np.uint8), 0.1, "expected 0 (free)"),
        (np.zeros(4, dtype=np.uint8), 0.1, "(4)"),
        (np.zeros((2, 2), dtype=np.uint8), 0.0, "resolution"),
        (np.zeros((0, 2), dtype=np.uint8), 0.1, "0"),
        # as bytes these would be 0, 255 and 1
        (np.array([[0.0, 0.9]]), 0.1, "column 1) is 0.9"),
        (np.array([[0, -1]]), 0.1, "column 1) is -1"),
        ([[257, 0]], 0.1, "column 0) is 257"),
        (np.array([[math.nan]]), 0.1, "is nan"),
    ],
)
def test_bad_grids_are_refused(cells, resolution_m, word):
    with pytest.raises(landfall.InvalidArgument, match=word.replace("(", r"\(").replace(")", r"\)")):
        landfall.GridMap(cells, resolution_m)


def test_walls_are_a_view(plan):
    assert plan.walls.shape == (13, 4) and plan.walls.dtype == np.float64
    assert plan.walls[1].tolist() == [8.0, 0.0, 8.0, 5.0]
    assert not plan.walls.flags.writeable


def test_walls_and_grid_become_each_other(plan, grid):
    assert grid.resolution_m == 0.05
    walls = grid.to_walls().walls
    assert walls[:, 0].min() == pytest.approx(-0.05, abs=0.051) and walls[:, 0].max() == pytest.approx(
        8.05, abs=0.051
    )


def test_field_follows_its_definition(prepared):
    squared = prepared.squared_distance_cells()
    expected = 255.0 * np.exp(-squared * 0.05**2 / (2 * prepared.field_sigma_m**2))
    assert np.abs(prepared.field().astype(float) - expected).max() <= 0.5 + 1e-6


def test_scan_ranges_are_a_writable_view(laser):
    scan = landfall.Scan(laser, np.full(181, 3.0), stamp_s=5.0)
    scan.ranges_m[7] = math.nan
    assert scan.count_valid() == 180
    scan.ranges_m = np.full(181, 20.0)
    assert scan.count_valid() == 181 and scan.count_echoes() == 0
    with pytest.raises(landfall.InvalidArgument, match="180 values"):
        scan.ranges_m = np.zeros(180)


def test_scan_needs_a_range_per_beam(laser):
    with pytest.raises(landfall.InvalidArgument, match="181"):
        landfall.Scan(laser, [1.0, 2.0])


def test_echo_points_use_the_mount():
    sensor = landfall.Sensor([landfall.Beam((1.0, 0.0, math.pi / 2)), landfall.Beam((0.0, 0.0, math.pi))])
    scan = landfall.Scan(sensor, [2.0, math.nan])
    assert scan.points_robot() == pytest.approx(np.array([[1.0, 2.0]]))


def test_scans_from_an_array(laser):
    made = landfall.make_scans(laser, np.full((3, 181), 2.0), stamp_s=[1.0, 2.0, 3.0])
    assert [scan.stamp_s for scan in made] == [1.0, 2.0, 3.0] and made[0].sensor.name == "laser"
    with pytest.raises(landfall.InvalidArgument, match="one per beam"):
        landfall.make_scans(laser, np.zeros((3, 180)))


def test_merge_sees_all_beams_from_the_reference(laser):
    ahead = landfall.Scan(laser, np.full(181, 2.0), 1.0, T_odom_robot=(0, 0, 0))
    turned = landfall.Scan(laser, np.full(181, 2.0), 2.0, T_odom_robot=(1, 0, 0))
    both = landfall.merge([ahead, turned])
    assert len(both) == 362 and both.stamp_s == 2.0
    points = both.points_robot()
    assert points[:181] == pytest.approx(points[181:] - np.array([1.0, 0.0]), abs=1e-5)


def test_merge_by_odometry_is_seen_from_any_reference(laser):
    ahead = landfall.Scan(laser, np.full(181, 2.0), 1.0, T_odom_robot=(0, 0, 0))
    turned = landfall.Scan(laser, np.full(181, 2.0), 2.0, T_odom_robot=(1, 0, 0))
    first = landfall.merge([ahead, turned], reference=0)
    assert first.stamp_s == 1.0
    given = landfall.merge([ahead, turned], [(0, 0, 0), (1, 0, 0)], reference=0)
    assert first.points_robot() == pytest.approx(given.points_robot())
    with pytest.raises(landfall.InvalidArgument, match="reference is 2"):
        landfall.merge([ahead, turned], reference=2)
    with pytest.raises(landfall.InvalidArgument, match="rotation_rad is -1"):
        landfall.merge([ahead, turned], noise=landfall.RelativePoseNoise(rotation_rad=-1.0))
    turned.T_odom_robot = None
    with pytest.raises(landfall.InvalidArgument, match="scan 1 has no T_odom_robot"):
        landfall.merge([ahead, turned])


def test_odometry_noise_has_every_part():
    parts = {
        "translation_m": 0.01,
        "translation_relative": 0.02,
        "translation_per_rad_m": 0.03,
        "rotation_rad": 0.04,
        "rotation_per_m_rad": 0.05,
        "rotation_relative": 0.06,
    }
    noise = landfall.OdometryNoise(**parts)
    assert {name: getattr(noise, name) for name in parts} == parts


@pytest.mark.parametrize(
    "make",
    [
        lambda: landfall.Window((0, 0, 0), half_x_m=-1.0),
        lambda: landfall.Gaussian((0, 0, 0), [[1, 0, 0], [0, -1, 0], [0, 0, 1]]),
        lambda: landfall.Gaussian((0, 0, 0), np.zeros((3, 2))),
        lambda: landfall.Region([(0, 0), (1, 1)]),
        lambda: landfall.Region([(0, 0, 0), (1, 1, 1)]),
        lambda: landfall.Beacons([]),
        lambda: landfall.CandidatePoses(np.zeros((0, 3))),
        lambda: landfall.Mixture([1.0], [landfall.Anywhere(), landfall.Anywhere()]),
        lambda: landfall.make_fan(0, 0.0, 0.1),
        lambda: landfall.Sensor([]),
        lambda: landfall.WallMap([[0, 0, math.nan, 1]]),
    ],
)
def test_bad_values_are_refused_where_they_are_made(make):
    with pytest.raises(landfall.Error) as raised:
        make()
    assert isinstance(raised.value, ValueError) and raised.value.code == "invalid argument"


def test_priors_keep_what_they_are_given():
    window = landfall.Window((1, 2, 0.5), half_theta_rad=0.1)
    gaussian = landfall.Gaussian((1, 2, 0.5), sigma_xy_m=0.5, sigma_theta_rad=0.1)
    assert np.diag(gaussian.covariance) == pytest.approx([0.25, 0.25, 0.01])
    mixture = landfall.Mixture([1, 3], [window, gaussian])
    assert mixture.weights == [1.0, 3.0]
    assert mixture.components[0].kind.half_theta_rad == 0.1
    assert landfall.Region([(0, 0), (1, 0), (1, 1)]).polygon_map[2] == (1.0, 1.0)
    assert landfall.CandidatePoses([Pose2(1, 2, 3)]).T_map_robot == [Pose2(1, 2, 3)]
    assert landfall.Beacons([(1, 2, 3)]).discs == [(1.0, 2.0, 3.0)]
