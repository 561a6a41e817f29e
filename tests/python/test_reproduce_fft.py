"""landfall reproduce fft: the experiment runs, small, and says what it should."""

from __future__ import annotations

import json
import math

import landfall
import landfall.reproduce.fft as fft
import numpy as np
import pytest
from landfall import Pose2, Scan
from landfall.reproduce._sonar_room import (
    CELL_M,
    NOISE_M,
    NOISE_RELATIVE,
    Room,
    amigobot,
    make_room,
    read_turn,
)


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fft, "TIMED", 2)


def test_the_papers_experiment(tmp_path, landfall_command, quick) -> None:
    done = landfall_command("reproduce", "fft", "--seeds", 2, "--out", tmp_path, "--json")
    assert done.code == 0, done.err
    result = json.loads(done.out)
    assert max(result["error_dm"].values()) <= 1.0
    assert set(result["error_dm"]) == {"A", "B", "C"}
    assert result["poses"] == 30
    assert result["success"] >= 0.96
    assert result["success"] > result["success_paper_filter"] > result["success_raw_paper_filter"]
    assert result["success_raw"] > result["success_raw_paper_filter"]
    assert result["success_raw"] > result["success_raw_without_filter"] > 0.5
    assert result["success_without_filter"] > result["success_raw_without_filter"]
    assert result["success_without_masks"] > result["success_raw_without_masks"]
    assert result["bare_fft_ms"] > 0.0
    for picture in result["pictures"]:
        assert (tmp_path / picture).stat().st_size > 10_000
    assert {len(row) for row in fft.table(result)} == {3}


@pytest.mark.parametrize(("room_seed", "pose"), [(5, 13), (5, 14), (8, 6), (14, 3), (16, 9), (16, 13)])
def test_readings_that_the_filter_drops_decide_where_its_end_points_mislead(
    room_seed: int, pose: int
) -> None:
    case = fft.make_cases(room_seed, 1)[pose]
    assert not fft._is_right(fft.locate(case), case)
    assert fft._is_right(fft.find(case), case)


def test_a_condensed_turn_keeps_its_readings() -> None:
    turn = fft.make_cases(3, 1)[0].turn
    scan = landfall.merge_turn_minima(turn)
    assert len(scan) < 256 == len(scan.measured)
    assert (scan.measured.ranges_m == landfall.merge_turn(turn).ranges_m).all()
    assert landfall.merge_turn(turn).measured is None
    with pytest.raises(landfall.InvalidArgument, match="condensed"):
        Scan(scan.sensor, scan.ranges_m, measured=scan)


def test_rooms_follow_their_seed_and_their_walls_run_through_occupied_cells() -> None:
    for seed in (1, 7):
        room = make_room(seed)
        cells = room.map.grid.cells
        assert (cells == make_room(seed).map.grid.cells).all()
        assert 0.15 < (cells == 0).mean() < 0.35
        pose = Pose2(6.4, 6.4, 0.3)
        hits = _end_points(_look(room, pose), pose)
        col, row = (hits / CELL_M).astype(int).T
        # a hair past the face, and the cell that holds it
        near = np.array(
            [(cells[r - 1 : r + 2, c - 1 : c + 2] == 1).any() for r, c in zip(row, col, strict=True)]
        )
        assert near.all()


def _look(room: Room, pose: Pose2) -> Scan:
    sensor = landfall.make_fan(90, 0.0, 2.0 * math.pi / 90)
    return landfall.simulate(room.walls, sensor, [pose], noise=False)[0]


def _end_points(scan: Scan, pose: Pose2) -> np.ndarray:
    x, y = scan.points_robot().T
    c, s = math.cos(pose.theta_rad), math.sin(pose.theta_rad)
    return np.stack([pose.x_m + c * x - s * y, pose.y_m + s * x + c * y], axis=1)


def test_sonars_read_what_faces_them_right_and_the_rest_too_long() -> None:
    room = make_room(3)
    pose = Pose2(6.211, 6.748, 0.2)
    ranges = np.array([scan.ranges_m for scan in read_turn(room.walls, pose, 1)])
    headings = [Pose2(pose.x_m, pose.y_m, pose.theta_rad + k * 2.0 * math.pi / 32) for k in range(32)]
    nearest = landfall.simulate(room.walls, amigobot(), headings, noise=False)
    nearest = np.array([scan.ranges_m for scan in nearest])
    echo = ranges < 4.8
    off = (ranges - nearest)[echo] / (NOISE_M + NOISE_RELATIVE * nearest[echo])
    assert off.min() > -5.0  # never too short but for noise
    assert 0.1 < (np.abs(off) < 3.0).mean() < 0.9
