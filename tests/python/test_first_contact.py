"""What a newcomer meets: mistakes that say what to do instead, values that show themselves, whole help."""

from __future__ import annotations

import math

import landfall
import numpy as np
import pytest


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (lambda m, s: ("floor.yaml", None, s), r"load_map\('floor.yaml'\)"),
        (lambda m, s: (42, None, s), "map is a int, expected PreparedMap, GridMap or WallMap"),
        (lambda m, s: (m, "anywhere", s), "prior is a str, expected None or one of PosePrior, Anywhere"),
        (lambda m, s: (m, None, s[0].ranges_m), r"array of shape \(181,\): give make_scans"),
        (lambda m, s: (m, None, landfall.Log(s)), r"give log\.scans"),
        (lambda m, s: (m, None, [s[0], None]), "scan 1 is a NoneType"),
    ],
)
def test_wrong_types_say_what_to_give(prepared, scans, arguments, words):
    with pytest.raises(TypeError, match=words) as raised:
        landfall.search(*arguments(prepared, scans))
    assert isinstance(raised.value, landfall.WrongType)


def test_a_seed_is_not_negative(prepared, scans):
    with pytest.raises(landfall.InvalidArgument, match="seed is -1, expected a whole number from 0"):
        landfall.search(prepared, None, scans[0], seed=-1)


def test_cells_are_whole_numbers():
    """0.65 would have become free."""
    with pytest.raises(landfall.InvalidArgument, match=r"is 0\.65, expected 0"):
        landfall.GridMap(np.full((3, 4), 0.65), 0.05)
    assert landfall.GridMap(np.ones((3, 4), dtype=bool), 0.05).cells.sum() == 12
    assert landfall.GridMap([[0, 1], [2, 0]], 0.05).cells.tolist() == [[0, 1], [2, 0]]


@pytest.mark.parametrize("shape", [(2, 2), (9,), (1, 3), (0, 3)])
def test_covariances_are_three_by_three(shape):
    with pytest.raises(landfall.InvalidArgument, match=r"expected \(3, 3\)"):
        landfall.Gaussian((0, 0, 0), np.zeros(shape))


def test_maps_have_their_files_names(files, grid):
    (files.folder / "hall").mkdir()
    landfall.save_grid_map(grid, files.folder / "hall" / "map.yaml")
    assert landfall.load_map(files.map).name == "floor"
    assert landfall.load_map(files.folder / "hall" / "map.yaml").name == "hall"
    assert landfall.load_map(files.map, name="third").name == "third"


def test_values_show_themselves(prepared, scans):
    window = landfall.Window((1, 2, 0.5), 0.25)
    assert repr(window) == (
        "Window(T_map_robot=Pose2(x_m=1.0000, y_m=2.0000, theta_rad=0.50000), "
        f"half_x_m=0.25, half_y_m=0.5, half_theta_rad={math.pi})"
    )
    assert repr(landfall.Mixture([1], [landfall.Anywhere()])) == (
        "Mixture(weights=[1.0], components=[PosePrior(kind=Anywhere())])"
    )
    result = landfall.search(prepared, None, scans[0])
    assert repr(result).startswith("SearchResult(verdict='found', ") and "explained=" in repr(result)
    assert f"poses_covered={result.counts.poses_covered}," in repr(result.counts)
    assert "total_ms=" in repr(result.times)
    scans[0].ranges_m[:] = math.nan
    assert "no hypothesis: no " in repr(landfall.search(prepared, None, scans[0]))


def test_help_tells_every_command_in_whole_sentences(landfall_command):
    shown = landfall_command("-h").out
    assert "..." not in shown.split("Commands:")[1]
    assert "a pose per scan" in " ".join(shown.lower().split())


def test_a_map_that_is_likely_broken_is_said_to_be(files, scans, landfall_command):
    """Steps of 2 m and a quarter turn, which no prediction of standing still foresees; odometry does."""
    hops = [landfall.Pose2(1.0 + 1.9 * (i % 2), 2.0 + 0.1 * i, (i % 4) * math.pi / 2) for i in range(8)]
    plan = landfall.PreparedMap(landfall.load_map(files.map).grid)
    made = landfall.simulate(plan, scans[0].sensor, hops, seed=3)
    for i, scan in enumerate(made):
        scan.stamp_s, scan.T_odom_robot, scan.T_map_robot = float(i), hops[0].inverse() * hops[i], None
    landfall.save_log(made, files.log)
    command = ("map", "--method", "slam", "--log", files.log, "--out", files.folder / "m.yaml")
    assert "--prediction odometry maps better" in landfall_command(*command).err
    assert landfall_command(*command, "--prediction", "odometry").err == ""
