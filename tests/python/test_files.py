"""Files from Python: what is written is read, what is broken is named."""

from __future__ import annotations

import gzip

import landfall
import pytest


def test_log_round_trip(files, scans):
    log = landfall.load_log(files.log)
    assert len(log) == 12 and log.warnings == []
    assert log.scans[3].stamp_s == 103.0
    assert list(log.scans[3].T_odom_robot) == pytest.approx(list(scans[3].T_odom_robot))
    assert log.scans[3].ranges_m == pytest.approx(scans[3].ranges_m, abs=1e-4)
    assert len(log.scans[3].sensor) == 181


def test_map_round_trip(files, grid):
    again = landfall.load_grid_map(files.map)
    assert (again.cells == grid.cells).all() and again.resolution_m == grid.resolution_m


def test_sensor_and_trajectory_round_trip(files, laser):
    (sensor,) = landfall.load_sensors(files.sensor).values()
    assert len(sensor) == len(laser) and sensor.range_noise_m == laser.range_noise_m
    trajectory = landfall.load_trajectory(files.truth)
    assert len(trajectory) == 12 and trajectory[0][0] == 100.0


def test_wall_plan_round_trip(tmp_path, plan):
    landfall.save_wall_map(plan, tmp_path / "plan.json")
    assert (landfall.load_wall_map(tmp_path / "plan.json").walls == plan.walls).all()


def test_errors_are_ours_and_pythons(tmp_path):
    missing = tmp_path / "missing.yaml"
    with pytest.raises(FileNotFoundError) as raised:
        landfall.load_map(missing)
    assert isinstance(raised.value, landfall.Error) and str(missing) in str(raised.value)
    (tmp_path / "bad.log.gz").write_bytes(gzip.compress(b"FLASER 2 1 1 0 0 0 0 0 0 1 h 1\n" * 50)[:40])
    with pytest.raises(landfall.FileFormat, match=r"bad\.log\.gz"):
        landfall.load_log(tmp_path / "bad.log.gz")
    with pytest.raises(landfall.Error):
        landfall.save_trajectory([], tmp_path / "no" / "folder.tum")


def test_carmen_log_through_the_front_door(data):
    log = landfall.load_log(data / "intel" / "query.log.gz")
    assert len(log) == 455 and len(log.scans[0]) == 180
    assert log.scans[0].ranges_m[:3] == pytest.approx([1.72, 1.66, 1.64])
