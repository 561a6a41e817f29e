"""landfall reproduce fsdn: the experiment runs, small, and its parts do what they say."""

from __future__ import annotations

import json
import math

import landfall
import landfall.reproduce._fsdn_cells as cells
import landfall.reproduce._fsdn_logs as logs
import landfall.reproduce.fsdn as fsdn
import numpy as np
import pytest
from landfall import Pose2
from landfall.reproduce._workshop import HEIGHT_M, WIDTH_M, make_room, make_scanners, make_workshop


def test_workshops_follow_their_seed_and_have_room():
    for seed in range(5):
        workshop = make_workshop(seed)
        walls = np.array(workshop.walls)
        assert (walls == np.array(make_workshop(seed).walls)).all()
        assert walls[:, [0, 2]].min() == 0.0 and walls[:, [0, 2]].max() == pytest.approx(WIDTH_M)
        assert walls[:, [1, 3]].min() == 0.0 and walls[:, [1, 3]].max() == pytest.approx(HEIGHT_M)
        assert len(workshop.solids) >= 12
        assert len(workshop.random_poses(20, np.random.default_rng(seed))) == 20
    assert (np.array(make_workshop(0).walls[:10]) != np.array(make_workshop(1).walls[:10])).any()


def test_solid_things_are_not_free():
    workshop = make_workshop(3)
    for corners in workshop.solids:
        assert not workshop.is_free(*corners.mean(axis=0))
    assert not workshop.is_free(0.1, 5.0)
    assert not make_room(1).is_free(5.0, 2.0)


def test_the_scanners_look_all_around():
    sensor = make_scanners()
    bearings = np.sort([beam.T_robot_beam.theta_rad for beam in sensor.beams])
    assert len(bearings) == 720
    assert np.diff(bearings) == pytest.approx(math.radians(0.5))


def test_obstacles_shorten_as_many_beams_as_asked():
    workshop = make_workshop(2)
    map = workshop.map()
    pose = workshop.random_poses(1, np.random.default_rng(1))[0]
    scan = landfall.simulate(map, make_scanners(), [pose], noise=False)[0]
    for share in (0.0, 0.2, 0.4):
        shortened = fsdn.obstruct(workshop, scan, pose, share, np.random.default_rng(5))
        shorter = np.asarray(shortened.ranges_m) < np.asarray(scan.ranges_m) - 1e-6
        assert share <= shorter.mean() < share + 0.3
        assert (np.asarray(shortened.ranges_m)[~shorter] >= np.asarray(scan.ranges_m)[~shorter] - 1e-6).all()


def test_right_is_a_centimetre_in_either_axis_and_a_degree():
    truth = Pose2(1.0, 2.0, 3.14)
    assert fsdn.is_right(Pose2(1.009, 2.009, -3.14), truth)
    assert not fsdn.is_right(Pose2(1.011, 2.0, 3.14), truth)
    assert not fsdn.is_right(Pose2(1.0, 2.0, 3.12), truth)


def test_a_run_is_observed():
    room = make_room(1)
    map = room.map()
    pose = room.random_poses(1, np.random.default_rng(1))[0]
    scan = landfall.simulate(map, make_scanners(), [pose], seed=1)[0]
    run = landfall.run_diffusion(
        map, landfall.Anywhere(), scan, cells=200, max_modes=1, snapshot_iterations=[0, 5]
    )
    assert [snapshot.iteration for snapshot in run.snapshots][:2] == [0, 5]
    assert run.snapshots[0].poses.shape == (200, 3)
    assert sum(run.snapshots[-1].active) > sum(run.snapshots[0].active)
    assert landfall.translation_distance(run.modes[0].T_map_robot, pose) < 0.2
    assert 0.0 < run.cast_ms < run.processor_ms
    assert run.levels[0].half_m > run.levels[-1].half_m == pytest.approx(0.01)
    with pytest.raises(landfall.InvalidArgument):
        landfall.run_diffusion(map, landfall.Anywhere(), scan, cells=-1)


def test_the_expected_cost_counts_failures_and_resamples_starts_in_pairs():
    costs = np.array([[4.0, 6.0, 2.0], [2.0, 3.0, 1.0], [1.0, 1.0, 1.0]])
    right = np.array([[1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 0.0]])
    ratio, low, high = cells.over_best(costs, right, 0)
    assert ratio == 2.0  # 4 over 2; the third number costs 3, its failures counted
    assert low <= 2.0 <= high
    alone = cells.over_best(costs[:2], right[:2], 0)
    assert alone == pytest.approx((2.0, 2.0, 2.0))  # each start costs twice as much: in any resampling


@pytest.mark.parametrize("space", cells.SPACES)
def test_starts_are_in_their_search_space(space):
    starts = cells.make_starts(space, 7, make_scanners(), 3)
    assert len(starts) == 7 and len({start.seed for start in starts}) == 7
    for start in starts:
        T = start.truth
        if isinstance(start.prior, landfall.Window):
            center = start.prior.T_map_robot
            assert max(abs(T.x_m - center.x_m), abs(T.y_m - center.y_m)) <= 4.5
        again = landfall.simulate_ranges(start.map, start.scan.sensor, [T])[0]
        assert np.median(np.abs(again - np.asarray(start.scan.ranges_m))) < 0.02
    regions = cells.search_space(starts[0])
    assert {0: 300, 1: 800, 2: 8000, 3: 35000}[cells.SPACES.index(space)] < regions < 70000


def test_what_is_spent_until_the_right_mode():
    start = cells.make_starts("room of 4 x 4 m", 1, make_scanners(), 1)[0]
    spent = cells.spend(start, 128)
    run = landfall.run_diffusion(start.map, start.prior, start.scan, cells=128, max_modes=1, seed=start.seed)
    assert spent.right and spent.rays == run.rays_cast == run.modes[0].found_rays_cast
    assert spent.iterations == run.iterations and spent.processor_ms > 0.0
    start.truth = Pose2(start.truth.x_m + 1.0, start.truth.y_m, start.truth.theta_rad)
    failed = cells.spend(start, 128)
    assert not failed.right and failed.rays > spent.rays  # all that the whole search took


def test_fsdn_reproduces_the_paper(tmp_path, landfall_command, monkeypatch):
    monkeypatch.setattr(fsdn, "STARTS_A_SEED", 5)
    monkeypatch.setattr(fsdn, "OBSTRUCTED_A_SEED", 2)
    monkeypatch.setattr(fsdn, "OBSTRUCTED_SHARES", (0.0, 0.3))
    monkeypatch.setattr(fsdn, "CELLS", (256, 2048))
    monkeypatch.setattr(fsdn, "CURVE_STARTS", 3)
    monkeypatch.setattr(fsdn, "CHOICE_CELLS", (64, 256))
    monkeypatch.setattr(fsdn, "CHOICE_STARTS", 5)
    monkeypatch.setattr(fsdn, "PLAIN_STARTS", 1)
    monkeypatch.setattr(fsdn, "BARE_RAYS", 5000)
    monkeypatch.setattr(logs, "BUILDINGS", ())
    done = landfall_command("reproduce", "fsdn", "--seeds", 2, "--out", tmp_path / "out", "--json")
    assert done.code == 0, done.err
    result = json.loads(done.out)
    assert result["starts"] == 10
    assert result["success"] >= 0.8
    assert result["success_warm"] >= 0.8
    assert set(result["success_by_obstacles"]) == {"0.0", "0.3"}
    assert 0.1 < result["cast_share"] < 0.95
    assert result["cold_ms_median"] > result["warm_ms_median"] > 0.0
    assert result["cells"] in [row["cells"] for row in result["curve"]]
    assert result["choice"]["starts"] == 5 and 1.0 <= result["cells_over_best"] < 10.0
    assert result["plain_room"]["sdn_ms"] > result["plain_room"]["fsdn_ms"]
    for name in ("workshops.png", "cells.png", "cells.gif", "curves.png"):
        assert (tmp_path / "out" / name).stat().st_size > 10_000
    assert {len(row) for row in fsdn.table(result)} == {3}
