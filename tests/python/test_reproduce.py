"""landfall reproduce: the experiments run, small, and say what they should."""

from __future__ import annotations

import json

import landfall.reproduce.grid as grid
import numpy as np
import pytest
from landfall import GridMap, Pose2, PreparedMap
from landfall.reproduce._furnished_rooms import make_room


def test_unknown_papers_are_named(landfall_command):
    landfall_command("reproduce", "nobody-1900").fails_with("nobody-1900", "grid")
    landfall_command("reproduce", "grid", "--seeds", 0).fails_with("--seeds 0")


def test_rooms_follow_their_seed_and_are_walled():
    for seed in range(20):
        cells = make_room(np.random.default_rng(seed)).cells
        assert (cells == make_room(np.random.default_rng(seed)).cells).all()
        assert cells[:3].all() and cells[-3:].all() and cells[:, :3].all() and cells[:, -3:].all()
        assert 0.4 < (cells == 0).mean() < 0.9


def test_right_is_within_a_cell_and_seven_degrees():
    truth = Pose2(1.0, 2.0, 3.1)
    assert grid.is_right(Pose2(1.1, 2.0, 3.1), truth)
    assert not grid.is_right(Pose2(1.08, 2.08, 3.1), truth)
    assert grid.is_right(Pose2(1.0, 2.0, -3.1), truth)  # 4.8 degrees, past pi
    assert not grid.is_right(Pose2(1.0, 2.0, 2.9), truth)


def test_estimates_are_off_within_the_window():
    room = np.zeros((60, 60), dtype=np.uint8)
    room[[0, -1], :] = room[:, [0, -1]] = 1
    map = PreparedMap(GridMap(room, 0.1))
    for on_lattice in (True, False):
        asked = grid.make_questions(np.random.default_rng(1), map, 200, on_lattice=on_lattice)
        off = np.array(
            [
                (p.T_map_robot.x_m - t.x_m, p.T_map_robot.y_m - t.y_m)
                for p, t in zip(asked.priors, asked.T_map_robot, strict=True)
            ]
        )
        assert np.abs(off).max() <= 0.8 + 0.05 + 1e-9
        assert np.abs(off).max() > 0.7
        in_cells = off / 0.1
        assert (np.abs(in_cells - in_cells.round()).max() < 1e-6) == on_lattice


def test_grid_reproduces_the_paper(tmp_path, landfall_command, monkeypatch):
    monkeypatch.setattr(grid, "POSES_PER_SEED", 150)
    monkeypatch.setattr(grid, "TIMED", 3)
    monkeypatch.setenv("LANDFALL_DATA", str(tmp_path / "none"))
    done = landfall_command("reproduce", "grid", "--seeds", 2, "--out", tmp_path / "out", "--json")
    assert done.code == 0, done.err
    result = json.loads(done.out)
    assert result["poses"] == 300
    assert "corridor8 is skipped" in done.err
    assert "laser is skipped" in done.err
    assert "corridor8" not in result
    assert result["success_corrected"] >= 0.98
    assert result["success_continuous"] >= 0.97
    assert result["success_with_crosstalk"] >= 0.95
    assert result["right_that_are_found"] >= 0.7
    assert result["found_but_wrong"] <= 0.02
    assert result["reduced_finds_the_same"] >= 0.95
    assert 0.0 < result["local_grids_ms"] < 50.0
    assert 0.0 < result["search_ms"] < 50.0
    by_score = result["by_score"]
    assert by_score["success_corrected"] >= 0.95
    assert by_score["success_uncorrected"] < by_score["success_corrected"]
    assert by_score["success_rotated_raster"] < by_score["success_corrected"]
    assert (tmp_path / "out" / "grid_rooms.png").stat().st_size > 10_000
    rows = grid.table(result)
    assert {len(row) for row in rows} == {5}
    assert "99" in rows[2]


@pytest.mark.parametrize("on_lattice", [True, False])
def test_the_same_seed_gives_the_same_poses(on_lattice):
    def ask() -> list[Pose2]:
        rng = np.random.default_rng(5)
        return grid.make_questions(rng, PreparedMap(make_room(rng)), 10, on_lattice=on_lattice).T_map_robot

    assert [list(pose) for pose in ask()] == [list(pose) for pose in ask()]
