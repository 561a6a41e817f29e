"""landfall.search from Python: answers, shapes of arguments, errors, the GIL."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import threading

import landfall
import numpy as np
import pytest
from conftest import POSES


def close(T_map_robot, truth):
    return (
        landfall.translation_distance(T_map_robot, truth) < 0.1
        and landfall.angle_distance(T_map_robot.theta_rad, truth.theta_rad) < 0.03
    )


def test_finds_every_scan_from_nothing(prepared, scans):
    results = landfall.search(prepared, None, scans)
    assert [close(r.hypotheses[0].T_map_robot, truth) for r, truth in zip(results, POSES, strict=True)] == [
        True
    ] * 12
    assert all(result.verdict == "found" and result.proven for result in results)
    assert [result.stamp_s for result in results] == [scan.stamp_s for scan in scans]


def test_one_scan_gives_one_result(prepared, scans):
    alone = landfall.search(prepared, None, scans[3])
    batch = landfall.search(prepared, None, scans)
    assert alone.hypotheses[0].score == batch[3].hypotheses[0].score
    assert alone.hypotheses[0].T_map_robot == batch[3].hypotheses[0].T_map_robot
    assert alone.hypotheses[0].covariance.shape == (3, 3)


def test_methods_agree(prepared, scans):
    options = {"rotation_step_rad": math.radians(5.0)}
    exhaustive = landfall.search(prepared, None, scans[:3], method="exhaustive", **options)
    bounded = landfall.search(prepared, None, scans[:3], method="branch_and_bound", **options)
    assert [r.hypotheses[0].score for r in exhaustive] == [r.hypotheses[0].score for r in bounded]
    names = [name for name, _, _ in landfall.methods()]
    assert {"exhaustive", "branch_and_bound"} <= set(names)


@pytest.mark.parametrize(
    "prior",
    [
        landfall.Anywhere(),
        landfall.Window(POSES[2], 0.5, 0.5, 0.5),
        landfall.Gaussian(POSES[2], sigma_xy_m=0.2, sigma_theta_rad=0.2),
        landfall.Region([(1, 1.5), (3, 1.5), (3, 3), (1, 3)]),
        landfall.Beacons([(POSES[2].x_m, POSES[2].y_m, 0.7)]),
        landfall.CandidatePoses([POSES[2], POSES[7]]),
        landfall.Mixture([0.5, 0.5], [landfall.Window(POSES[2]), landfall.Anywhere()]),
    ],
)
def test_every_prior_holds_the_answer(prepared, scans, prior):
    result = landfall.search(prepared, prior, scans[2])
    assert close(result.hypotheses[0].T_map_robot, POSES[2])


def test_one_prior_per_scan(prepared, scans):
    priors = [landfall.Window(pose, 0.3, 0.3, 0.3) for pose in POSES[:3]]
    results = landfall.search(prepared, priors, scans[:3])
    assert all(close(r.hypotheses[0].T_map_robot, truth) for r, truth in zip(results, POSES, strict=False))
    with pytest.raises(landfall.InvalidArgument):
        landfall.search(prepared, priors, scans[:2])


def test_several_maps_are_ranked_together(prepared, scans):
    empty = np.zeros((60, 60), dtype=np.uint8)
    empty[[0, -1], :] = empty[:, [0, -1]] = 1
    other = landfall.PreparedMap(landfall.GridMap(empty, 0.05), name="other")
    best = landfall.search([other, prepared], None, scans[4]).hypotheses[0]
    assert best.map_index == 1 and close(best.T_map_robot, POSES[4])


def test_no_valid_beam_is_lost_with_the_reason(prepared, laser):
    blind = landfall.Scan(laser, np.full(181, np.nan))
    result = landfall.search(prepared, None, blind)
    assert result.verdict == "lost" and result.hypotheses == [] and "beam" in result.reason


def test_prior_off_the_map_is_refused(prepared, scans):
    with pytest.raises(landfall.InvalidArgument, match="map"):
        landfall.search(prepared, landfall.Window((500, 500, 0)), scans[0])


def test_unknown_names_are_named(prepared, scans):
    with pytest.raises(landfall.UnknownName, match="magic"):
        landfall.search(prepared, None, scans[0], method="magic")
    with pytest.raises(TypeError, match="max_hypothesis"):
        landfall.search(prepared, None, scans[0], max_hypothesis=3)
    with pytest.raises(landfall.InvalidArgument, match="max_hypotheses"):
        landfall.search(prepared, None, scans[0], max_hypotheses="many")
    with pytest.raises(landfall.InvalidArgument, match="max_hypotheses"):
        landfall.search(prepared, None, scans[0], max_hypotheses=0)


def test_result_line_is_one_json_object(prepared, scans):
    line = landfall.search(prepared, None, scans[5]).to_json(5)
    result = json.loads(line)
    assert "\n" not in line
    assert result["index"] == 5 and result["stamp_s"] == 105.0 and result["verdict"] == "found"
    assert len(result["hypotheses"][0]["covariance"]) == 9


def test_gil_is_released(prepared, scans):
    """A thread counts while the search runs: impossible were the GIL held."""
    counted, finished = [0], threading.Event()

    def count():
        while not finished.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    try:
        landfall.search(prepared, None, scans * 4, method="exhaustive", rotation_step_rad=math.radians(2.0))
        during = counted[0]
    finally:
        finished.set()
        thread.join()
    assert during > 1000


def test_threads_share_a_map(prepared, scans):
    expected = [r.hypotheses[0].score for r in landfall.search(prepared, None, scans)]
    answers: dict[int, list[int]] = {}

    def work(k):
        answers[k] = [r.hypotheses[0].score for r in landfall.search(prepared, None, scans)]

    threads = [threading.Thread(target=work, args=(k,)) for k in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert list(answers.values()) == [expected] * 3


def test_consistent_follows_odometry(prepared, scans):
    results = landfall.search(prepared, None, scans)
    choices = landfall.consistent(results, [scan.T_odom_robot for scan in scans])
    assert choices == [0] * 12
    with pytest.raises(landfall.InvalidArgument):
        landfall.consistent(results, [])


def test_align_recovers_relative_poses(scans):
    window = scans[2:7]
    rng = np.random.default_rng(3)
    for scan in window[:-1]:
        scan.T_odom_robot = scan.T_odom_robot * landfall.Pose2(*rng.normal(0.0, 0.03, 3))
    T_last_robot = landfall.align(window)
    expected = [POSES[6].inverse() * pose for pose in POSES[2:7]]
    for found, truth in zip(T_last_robot, expected, strict=True):
        assert landfall.translation_distance(found, truth) < 0.06
        assert landfall.angle_distance(found.theta_rad, truth.theta_rad) < 0.03


def test_composites_whose_poses_may_be_off_settle(prepared, scans):
    wrong = [landfall.Pose2(0.3, 0.2, 0.0) * pose for pose in POSES[2:5]] + POSES[5:7]
    taken_as_given = landfall.search(prepared, None, landfall.merge(scans[2:7], wrong))
    noise = landfall.RelativePoseNoise(translation_m=0.03, rotation_rad=0.01)
    mended = landfall.search(prepared, None, landfall.merge(scans[2:7], wrong, noise=noise))
    assert close(mended.hypotheses[0].T_map_robot, POSES[6])
    assert mended.hypotheses[0].explained > taken_as_given.hypotheses[0].explained + 0.1
    with pytest.raises(landfall.InvalidArgument, match="rotation_rad is -1"):
        landfall.merge(scans[2:7], wrong, noise=landfall.RelativePoseNoise(rotation_rad=-1.0))


def test_polish_moves_the_chosen_to_where_all_fit(prepared, scans):
    results = landfall.search(prepared, None, scans)
    polished = landfall.polish([prepared], scans, results, [0] * 12)
    assert all(close(r.hypotheses[0].T_map_robot, truth) for r, truth in zip(polished, POSES, strict=True))
    untouched = landfall.polish([prepared], scans, results, [-1] * 12)
    assert [r.hypotheses[0].T_map_robot for r in untouched] == [r.hypotheses[0].T_map_robot for r in results]
    with pytest.raises(landfall.InvalidArgument, match="11 choices"):
        landfall.polish([prepared], scans, results, [0] * 11)


def test_follow_and_polish_take_what_consistent_takes(prepared, scans):
    results = landfall.search(prepared, None, scans[:3])
    # A scan that is misled: to odometry as bad as this, its wrong place is as good as any.
    misled = landfall.search(prepared, landfall.Window((6.0, 4.0, 0.0), 0.3, 0.3, 0.3), scans[1])
    shaken = landfall.OdometryNoise(translation_m=100.0, rotation_rad=100.0)
    listed = [results[0], misled, results[2]]
    assert len(landfall.follow([prepared], scans[:3], listed)[1].hypotheses) > len(misled.hypotheses)
    asked_too_widely = landfall.follow([prepared], scans[:3], listed, odometry=shaken)
    assert len(asked_too_widely[1].hypotheses) == len(misled.hypotheses)
    with pytest.raises(landfall.InvalidArgument, match=r"follow: jump_probability is 2"):
        landfall.follow([prepared], scans[:3], results, jump_probability=2.0)
    with pytest.raises(landfall.InvalidArgument, match=r"polish: odometry\.rotation_rad is -1"):
        landfall.polish(
            [prepared], scans[:3], results, [0] * 3, odometry=landfall.OdometryNoise(rotation_rad=-1.0)
        )


def test_a_wrong_instruction_set_is_named_whatever_comes_first():
    """In a process each: the choice holds for as long as one runs."""
    start = "import landfall as l\nfan = l.make_fan(4, 0.0, 1.5)\nscan = l.Scan(fan, [1.0] * 4)\n"
    for use in (
        "l.correlation_volume(l.PreparedMap(l.GridMap([[0, 1]], 0.5)), scan)",
        "l.Slam()",
        "l.simulate_ranges(l.PreparedMap(l.GridMap([[0, 1]], 0.5)), fan, [(0.2, 0.2, 0.0)])",
    ):
        done = subprocess.run(
            [sys.executable, "-c", start + use],
            env={**os.environ, "LANDFALL_ISA": "ABACUS"},
            capture_output=True,
            text=True,
        )
        assert "UnknownName" in done.stderr and "ABACUS" in done.stderr, use


def test_simulated_ranges_are_exact(plan, laser):
    """From (0.8, 2.2) along +x: the wall x = 4.6 from y = 3 is above; x = 8 is hit at 7.2 m."""
    ranges = landfall.simulate_ranges(landfall.PreparedMap(plan), laser, [(0.8, 2.2, 0.0)])
    assert ranges.shape == (1, 181) and ranges.dtype == np.float32
    assert ranges[0, 90] == pytest.approx(7.2, abs=1e-3)
    assert ranges[0, 0] == pytest.approx(2.2, abs=1e-3)
    assert ranges[0, 180] == pytest.approx(3.4 + 0.8 * 0.8 / 4.6 - 2.2, abs=1e-3)


def test_the_ray_caster_is_named_by_map_and_sensor(plan, laser):
    grid = landfall.PreparedMap(landfall.PreparedMap(plan).grid)
    sonar = landfall.make_fan(beams=4, first_rad=0.0, step_rad=1.0, range_max_m=5.0, half_angle_rad=0.1)
    assert landfall.ray_caster(landfall.PreparedMap(plan), laser) == "embree"
    assert landfall.ray_caster(grid, laser) == "distance_walk"
    assert landfall.ray_caster(grid, sonar) == "segment_tree"


def test_map_from_known_poses_finds_the_walls(scans):
    grid = landfall.map_from_known_poses(scans, resolution_m=0.1)
    row, col = grid.cell_of(8.05, 2.5)
    assert (grid.cells[row, col - 2 : col + 1] == 1).any()
    row, col = grid.cell_of(2.0, 2.2)
    assert grid.cells[row, col] == 0
