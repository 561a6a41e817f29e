"""landfall reproduce pso and SLAM from Python: the experiments run, small, and say what they should."""

from __future__ import annotations

import json
import math

import landfall
import landfall.reproduce.pso as pso
import numpy as np
import pytest
from landfall import Pose2
from landfall.reproduce import _wheelchair_judges as judges
from landfall.reproduce import _wheelchair_room as wheelchair


def test_rooms_have_the_sides_of_table_iii():
    for seed in range(6):
        room = wheelchair.make_room(seed)
        for k, side_m in enumerate(wheelchair.SIDES_M):
            a, b = room.side(k)
            assert math.hypot(*(b - a)) == pytest.approx(side_m)
        assert len(room.boxes) == wheelchair.BOXES
        track = np.vstack([room.track, room.track[:1]])
        for box in room.boxes:
            assert wheelchair.distance_to_path(box.mean(axis=0), track) > wheelchair.CLEARANCE_M


def test_noise_is_that_of_the_data_sheet():
    room = wheelchair.make_room(1)
    scans = wheelchair.read_scans(room, [Pose2()] * 200, np.random.default_rng(1), 0.2)
    ranges = np.array([scan.ranges_m for scan in scans], dtype=float)
    exact = landfall.simulate_ranges(room.map, wheelchair.uhg_08lx(), [Pose2()])[0].astype(float)
    most = np.where(exact < 1.0, 0.03 * exact, 0.03)
    off = np.abs(ranges - exact) / most
    assert off.max() <= 1.0 + 1e-4
    assert off.mean() == pytest.approx(0.5, abs=0.01)  # uniform


def test_a_disc_hides_what_is_behind_it():
    room = wheelchair.make_room(1, in_the_middle=True)
    blockers = [[], [(1.0, 0.0, 0.1)]]
    scans = wheelchair.read_scans(room, [Pose2()] * 2, np.random.default_rng(1), 0.2, blockers)
    middle = wheelchair.BEAMS // 2
    assert scans[1].ranges_m[middle] == pytest.approx(0.9, abs=0.03)
    assert (scans[1].ranges_m < 1.03).sum() - (scans[0].ranges_m < 1.03).sum() == pytest.approx(33, abs=3)


def test_sides_are_measured_from_cells():
    """The room drawn on cells without noise: each side to a cell."""
    room = wheelchair.make_room(2)
    grid = landfall.WallMap(room.map.walls.walls).to_grid(resolution_m=0.02)
    errors = judges.side_errors_mm(judges.measured_sides(grid, room))
    assert np.abs(errors).max() < 20.0
    assert all(judges.sides_right(errors))
    assert not judges.sides_right([math.nan] * 9)[0]


def test_traces_and_lost_cells_are_counted():
    room = wheelchair.make_room(1, in_the_middle=True)
    clean = landfall.WallMap(room.map.walls.walls).to_grid(resolution_m=0.02)
    assert judges.traces(clean, room) == (0, 0)
    cells = clean.cells.copy()
    origin = clean.T_map_grid
    col, row = int((0.6 - origin.x_m) / 0.02), int((0.6 - origin.y_m) / 0.02)
    cells[row, col : col + 3] = 1
    wall_row, wall_col = np.argwhere(clean.cells == 1)[0]
    cells[wall_row, wall_col] = 0
    changed = landfall.GridMap(cells, 0.02, origin)
    assert sum(judges.traces(changed, room)) == 3
    assert judges.lost_cells(clean, changed) == 1
    assert judges.lost_cells(changed, clean) == 3


def test_pso_reproduces_the_paper(tmp_path, landfall_command):
    done = landfall_command("reproduce", "pso", "--seeds", 1, "--seed", 31, "--out", tmp_path, "--json")
    assert done.code == 0, done.err
    result = json.loads(done.out)
    ours = result["pso"]
    assert ours["forward_error_mm"] <= 10.0
    assert ours["backward_error_mm"] <= 10.0
    assert ours["rotation_error_deg"] <= 0.3
    assert ours["sides_right"] == 9
    assert ours["failures"] == 0
    assert ours["trace_cells_left"] == 0
    assert ours["wall_cells_lost"] == 0
    assert ours["trace_cells_with_people"] > 0  # there was something to delete
    assert 0.0 < ours["ms_mean"] <= ours["ms_max"]
    for name in ("angle_histogram", "icp"):
        assert result[name]["forward_error_mm"] > ours["forward_error_mm"]
    for name in ("I", "II", "III", "IV"):
        assert (tmp_path / f"pso_experiment_{name}.png").stat().st_size > 10_000
    rows = pso.table(result)
    assert {len(row) for row in rows} == {len(rows[0])}


def test_slam_from_python_and_its_faults():
    room = wheelchair.make_room(3)
    poses = wheelchair.straight(0.1, 3)
    scans = wheelchair.read_scans(room, poses, np.random.default_rng(1), 0.2)
    seen = []
    result = landfall.slam(scans, lambda mapping, step: seen.append(step.accepted), seed=2)
    assert seen == [True] * len(scans)
    assert landfall.translation_distance(result.steps[-1].T_map_robot, poses[-1]) < 0.01
    assert result.map.resolution_m == pytest.approx(0.02)
    step = landfall.match_scans(scans[0], scans[1], matcher="icp_point_to_line")
    assert step.x_m == pytest.approx(0.1, abs=0.02)
    with pytest.raises(landfall.UnknownName, match="matcher"):
        landfall.slam(scans, matcher="nobody")
    with pytest.raises(landfall.UnknownOption, match="speed"):
        landfall.slam(scans, speed=1)  # type: ignore[call-arg]
    with pytest.raises(landfall.InvalidArgument, match="resolution_m"):
        landfall.slam(scans, resolution_m=0.0)
    with pytest.raises(landfall.InvalidArgument, match="no scans"):
        landfall.slam([])


def test_map_by_slam_writes_map_path_and_animation(tmp_path, landfall_command):
    room = wheelchair.make_room(4)
    scans = wheelchair.read_scans(room, wheelchair.straight(0.1, 5), np.random.default_rng(1), 0.2)
    log = tmp_path / "drive.jsonl"
    landfall.save_log(scans, log)
    done = landfall_command(
        *("map", "--log", log, "--method", "slam", "--out", tmp_path / "room.yaml"),
        *("--trajectory", tmp_path / "path.tum", "--animation", tmp_path / "room.gif"),
    )
    assert done.code == 0, done.err
    assert "11 of 11 scans" in done.out
    assert len(landfall.load_trajectory(tmp_path / "path.tum")) == 11
    assert landfall.load_map(tmp_path / "room.yaml").grid.resolution_m == pytest.approx(0.02)
    assert (tmp_path / "room.path.png").stat().st_size > 5_000
    assert (tmp_path / "room.gif").read_bytes()[:6] == b"GIF89a"
    landfall_command(
        "map", "--log", log, "--method", "slam", "--out", tmp_path / "b.yaml", "--matcher", "nobody"
    ).fails_with("matcher", "nobody")
