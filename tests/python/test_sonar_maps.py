"""Maps from sonars: the arrays, and `landfall map`."""

from __future__ import annotations

import math

import landfall
import numpy as np
import pytest
from landfall import Beam, Scan, Sensor

LOBE_RAD = math.radians(12.5)


def side_sonar() -> Sensor:
    beam = Beam((0.0, 0.0, math.pi / 2), LOBE_RAD, 0.1, 5.0)
    return Sensor([beam], "side", range_noise_m=0.01, range_noise_relative=0.01)


def drive_along_a_wall(scans: int = 60, odometry: bool = False) -> list[Scan]:
    """A wall 1 m to the left of a drive along x."""
    sensor, reading = side_sonar(), np.array([1.0], dtype=np.float32)
    poses = [(0.05 * i, 0.0, 0.0) for i in range(scans)]
    if odometry:
        return [Scan(sensor, reading, float(i), pose) for i, pose in enumerate(poses)]
    return [Scan(sensor, reading, float(i), None, pose) for i, pose in enumerate(poses)]


def test_points_covariances_and_supports_are_arrays():
    result = landfall.map_by_triangulation(drive_along_a_wall())
    assert result.points.shape == (59, 2)
    assert result.covariances.shape == result.supports.shape == (59, 3)
    assert result.values.shape == result.map.cells.shape
    assert np.abs(result.points[:, 1] - 1.0).max() < 0.02
    assert (result.covariances[:, [0, 2]] > 0.0).all()
    assert result.supports[:, 1].tolist() == list(range(1, 60))  # every scan but the first
    assert result.supports[0, 0] == 1
    assert 0.0 < result.values.max() <= 1.0
    assert len(result.scans) == 60


def test_the_three_maps_show_the_wall():
    scans = drive_along_a_wall()
    for make in (
        lambda: landfall.map_by_triangulation(scans).map,
        lambda: landfall.map_from_sonars(scans),
        lambda: landfall.map_of_end_points(scans),
    ):
        grid = make()
        row, col = grid.cell_of(1.5, 1.0)
        assert (grid.cells[row - 1 : row + 2, col] == 1).any()
        assert grid.cells[grid.cell_of(1.5, 0.5)] == 0


def test_the_box_shortens_readings_beyond_it():
    beams = [Beam((0.0, 0.0, math.radians(direction)), LOBE_RAD, 0.1, 5.0) for direction in (90, 45)]
    scan = Scan(Sensor(beams, "two"), np.array([1.0, 4.0], dtype=np.float32))
    corrected = landfall.correct_to_bounding_box(scan)
    assert corrected.ranges_m[0] == pytest.approx(1.0)
    assert corrected.ranges_m[1] == pytest.approx(math.sqrt(2.0), abs=1e-5)
    assert scan.ranges_m[1] == pytest.approx(4.0)


def test_faults_are_named():
    with pytest.raises(landfall.InvalidArgument, match="no scans"):
        landfall.map_by_triangulation([])
    with pytest.raises(landfall.InvalidArgument, match="window_scans"):
        landfall.map_by_triangulation(drive_along_a_wall(), window_scans=0)
    with pytest.raises(landfall.InvalidArgument, match="half_angle_rad"):
        landfall.map_from_sonars([Scan(Sensor([Beam()]), np.ones(1, np.float32), 0.0, None, (0, 0, 0))])


@pytest.mark.parametrize("method", ["tbf", "sonar-grid", "end-points"])
def test_the_command_maps_sonars(tmp_path, landfall_command, method):
    log, out = tmp_path / "drive.jsonl", tmp_path / "map.yaml"
    landfall.save_log(drive_along_a_wall(odometry=True), log)
    landfall_command("map", "--log", log, "--method", method, "--out", out).fails_with("--odometry")
    done = landfall_command("map", "--log", log, "--method", method, "--odometry", "--out", out)
    assert done.code == 0, done.err
    grid = landfall.load_grid_map(out)
    row, col = grid.cell_of(1.5, 1.0)
    assert (grid.cells[row - 1 : row + 2, col] == 1).any()


def test_the_commands_options_reach_the_method(tmp_path, landfall_command):
    log, out = tmp_path / "drive.jsonl", tmp_path / "map.yaml"
    landfall.save_log(drive_along_a_wall(odometry=True), log)
    common = ("map", "--log", log, "--method", "tbf", "--odometry", "--out", out)
    assert landfall_command(*common, "--window-scans", 1).code == 0
    assert not (landfall.load_grid_map(out).cells == 1).any()
    assert landfall_command(*common, "--bounding-box", "--connect-walls", "--resolution-m", 0.1).code == 0
    assert landfall.load_grid_map(out).resolution_m == pytest.approx(0.1)
    landfall_command(*common, "--window-scans", 0).fails_with("window_scans")
