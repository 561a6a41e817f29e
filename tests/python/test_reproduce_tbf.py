"""landfall reproduce tbf: its world, its scores, and what it finds."""

from __future__ import annotations

import json
import math

import landfall
import landfall.reproduce.tbf as tbf
import numpy as np
import pytest
from landfall import GridMap, Pose2, PreparedMap, WallMap
from landfall.reproduce._map_scores import Truth, found, score, wall_distance
from landfall.reproduce._office_corridor import STEP_M, drive, make_corridor
from landfall.reproduce._sonar_echoes import RANGE_MAX_M, SPECULAR_RAD, pioneer_2dx, read_sonars
from landfall.reproduce._tbf_real import WallFit, corridor8
from landfall.reproduce._tbf_scitos import agreement, lap_period, recover_motion

# A box of 8 x 6 m, its lower wall y = 0.
BOX = [(-4.0, 0.0, 4.0, 0.0), (4.0, 0.0, 4.0, 6.0), (4.0, 6.0, -4.0, 6.0), (-4.0, 6.0, -4.0, 0.0)]


def test_drives_keep_clear_of_the_walls():
    for seed in range(20):
        rng = np.random.default_rng(seed)
        corridor = make_corridor(rng)
        poses = drive(corridor, rng)
        assert wall_distance(poses[:, :2], np.array(corridor.walls)).min() > 0.3
        steps = np.hypot(*np.diff(poses[:, :2], axis=0).T)
        assert steps.max() < 2.0 * STEP_M
        assert poses[-1, 2] == pytest.approx(-math.pi / 2)
        assert poses[-1, 1] < -1.0  # in the room


def test_a_wall_is_heard_head_on_and_not_at_a_slant():
    map = PreparedMap(WallMap(BOX))
    pose = np.array([[0.0, 2.0, 0.0]])
    ranges = np.array([read_sonars(map, pose, np.random.default_rng(i))[0].ranges_m for i in range(200)])
    middle = np.median(ranges, axis=0)
    mount = pioneer_2dx().beams[7].T_robot_beam
    assert middle[7] == pytest.approx(2.0 + mount.y_m, abs=0.03)  # to the right, head on
    # 50 degrees to the right the wall is met at 27.5 degrees and more, beyond what comes back.
    assert math.radians(27.5) > SPECULAR_RAD
    straight = (2.0 + pioneer_2dx().beams[6].T_robot_beam.y_m) / math.sin(math.radians(50.0 + 12.5))
    assert middle[6] > 1.3 * straight


def test_readings_have_the_models_noise():
    map = PreparedMap(WallMap(BOX))
    pose = np.array([[0.0, 2.0, 0.0]])
    rng = np.random.default_rng(5)
    right = np.array([read_sonars(map, pose, rng)[0].ranges_m[7] for _ in range(1500)])
    right = right[np.abs(right - np.median(right)) < 0.2]  # without crosstalk
    assert right.std() == pytest.approx(0.01 + 0.01 * np.median(right), rel=0.1)


def test_someone_in_the_cone_is_heard():
    map = PreparedMap(WallMap(BOX))
    pose = np.array([[0.0, 2.0, 0.0]])
    scan = read_sonars(map, pose, np.random.default_rng(1), np.array([[1.5, 2.05]]))[0]
    assert scan.ranges_m[3] == pytest.approx(1.5 - 0.2 - 0.21, abs=0.1)


def test_scores_of_a_drawn_map():
    cells = np.zeros((20, 40), dtype=np.uint8)
    cells[0, :20] = 1  # half of the wall along the lower edge
    cells[10, 30] = 1  # an artefact
    grid = GridMap(cells, 0.1)
    points = np.column_stack([np.arange(0.01, 4.0, 0.02), np.full(200, 0.05)])
    truth = Truth(np.array([[0.0, 0.05, 4.0, 0.05]]), points, points, 4.0)
    result = score(grid, truth)
    assert result["coverage"] == pytest.approx(0.5 + 0.05 / 4.0, abs=0.006)  # the last centre is at 1.95
    assert result["artefacts_per_m2"] == pytest.approx(1.0 / 4.0)
    assert not found(grid, np.array([[-5.0, 9.0]]), 0.1).any()


def test_walls_are_fitted():
    x = np.arange(0.0, 8.0, 0.05)
    rng = np.random.default_rng(2)
    left = np.column_stack([x, 1.2 + 0.01 * x + 0.02 * rng.normal(size=len(x))])
    right = np.column_stack([x, -1.0 + 0.01 * x + 0.02 * rng.normal(size=len(x))])
    poses = np.column_stack([x, 0.01 * x, np.zeros(len(x))])
    stray = np.column_stack([x[::4], np.full(len(x[::4]), 0.1)])
    numbers = WallFit(np.concatenate([left, right, stray]), poses).numbers()
    assert numbers["spread_m"] == pytest.approx(0.02, abs=0.004)
    assert numbers["width_m"] == pytest.approx(2.2, abs=0.01)
    assert numbers["parallel_deg"] < 0.2
    assert numbers["off_walls"] == pytest.approx(40 / 360, abs=0.02)


def test_tbf_reproduces_the_paper(tmp_path, landfall_command, monkeypatch):
    monkeypatch.setattr(tbf, "WINDOWS", (5, 50))
    monkeypatch.setattr(tbf, "CIRCLE", (("tbf", "fft"),))
    monkeypatch.setenv("LANDFALL_DATA", str(tmp_path))  # without the real readings
    done = landfall_command(
        "reproduce", "tbf", "--seeds", 2, "--seed", 11, "--out", tmp_path / "out", "--json"
    )
    assert done.code == 0, done.err
    result = json.loads(done.out)
    raw, plain, box = (result[name] for name in ("raw", "tbf", "tbf_box"))
    assert plain["coverage"] >= 0.5
    assert box["coverage"] > plain["coverage"]
    assert plain["artefacts_per_m2"] <= 0.1 * raw["artefacts_per_m2"]
    assert plain["artefacts_per_m2"] < box["artefacts_per_m2"] <= 0.5 * raw["artefacts_per_m2"]
    assert result["windows"]["5"]["coverage"] < plain["coverage"]
    assert result["circle"]["tbf_fft"]["success"] > 0.4
    assert result["corridor8"] is None
    assert set(result["elfes"]) >= {"coverage", "artefacts_per_m2"}
    assert result["readings_per_s"] > 5_000  # a loose bound: other work may share the cores
    assert len({len(row) for row in tbf.table(result)}) == 1
    assert (tmp_path / "out" / "tbf_maps.png").stat().st_size > 10_000


def test_drives_follow_their_seed():
    one, other = tbf.make_drive(3), tbf.make_drive(3)
    assert all((a.ranges_m == b.ranges_m).all() for a, b in zip(one.scans, other.scans, strict=True))
    assert max(float(scan.ranges_m.max()) for scan in one.scans) <= RANGE_MAX_M


def test_the_box_sharpens_a_real_corridor(tmp_path, data, monkeypatch):
    monkeypatch.setenv("LANDFALL_DATA", str(data))
    fits = corridor8(tmp_path)
    assert fits is not None
    assert fits["tbf_box"]["spread_m"] < 0.5 * fits["raw"]["spread_m"]
    assert fits["tbf_box"]["off_walls"] < fits["tbf"]["off_walls"] < fits["raw"]["off_walls"]
    assert fits["tbf_box"]["parallel_deg"] < 2.0
    assert fits["tbf_box"]["walls_found"] > fits["tbf"]["walls_found"]


def test_motion_is_recovered_from_sonars_alone(data):
    """A lap's beginning: as far as the robot gets, and a map that stays as large as the room."""
    log = landfall.load_log(data / "sonar" / "scitos24.csv.gz")
    located = recover_motion(log.scans[:400])
    assert len(located) == 80
    x, y, _ = np.array([list(scan.T_map_robot) for scan in located]).T
    assert 1.0 < np.hypot(np.diff(x), np.diff(y)).sum() < 12.0
    assert np.ptp(x) < 5.0 and np.ptp(y) < 5.0


def test_scans_that_read_alike_tell_how_far_poses_drift():
    sensor = pioneer_2dx()
    laps = [np.full(16, 1.0 + 0.1 * (i % 200), dtype=np.float32) for i in range(400)]
    scans = [landfall.Scan(sensor, row) for row in laps]
    poses = [Pose2(0.01 * (i % 200) + 0.5 * (i >= 200), 0.0, 0.0) for i in range(400)]
    assert abs((lap_period(scans + scans[:150]) or 0) - 200) <= 8
    assert lap_period(scans[:50]) is None
    result = agreement(scans, poses)
    assert result["pairs"] == 200
    assert result["median_off_m"] == pytest.approx(0.5)
    assert result["median_off_deg"] == 0.0
