"""Espino, Moreno, Curto, Aguilar: autolocalization using the convolution of the extended robot.

A room of 6 x 9 m, eight sonars, a turn on the spot in 32 steps, 1 dm per pixel, 128 x 128 x 64 poses; the
paper's three points, and random poses in seeded rooms.

Not reproduced yet: with sonars as _sonar_room.py simulates them the minimum filter loses more than it gains,
and the method finds more poses without it (of 300, 85 % against 15 %). A cone's minimum is reached anywhere
within its 30 degrees, and readings that are too long have local minima of their own.
"""

from __future__ import annotations

import math
import statistics
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from landfall._landfall import (
    Pose2,
    PreparedMap,
    Scan,
    active_isa,
    angle_distance,
    blurred_map,
    correlation_volume,
    keep_local_minima,
    merge_turn,
    raised_cosine_mask,
    time_bare_transforms,
    transform_library,
    translation_distance,
)
from landfall.reproduce._sonar_room import CELL_M, TEST_POINTS, make_room, random_poses, read_turn
from landfall.searching import search

HEADINGS = 64
MASK_CELLS = 7
POSES_A_ROOM = 15
RIGHT_M = 0.15
STEP_RAD = 2.0 * math.pi / HEADINGS
PAPER_ERROR_DM = {"A": 0.53, "B": 2.48, "C": 3.27}
TIMED = 15  # repetitions, interleaved


@dataclass
class Case:
    """A robot that turned on the spot at T_map_robot."""

    map: PreparedMap
    T_map_robot: Pose2
    turn: list[Scan]

    def scan(self, minimum_filter: bool = True) -> Scan:
        return merge_turn(keep_local_minima(self.turn) if minimum_filter else self.turn)


def run(seed: int, seeds: int, out: Path) -> dict:
    """The JSON object; pictures under `out`."""
    room = make_room(seed)
    points = {
        name: _case(room, Pose2(x, y, 0.0), seed + i) for i, (name, (x, y)) in enumerate(TEST_POINTS.items())
    }
    result = {"seed": seed, "seeds": seeds, "isa": active_isa(), "transforms": transform_library()}
    estimates = {name: locate(case) for name, case in points.items()}
    result["error_dm"] = {
        name: translation_distance(estimates[name], case.T_map_robot) * 10.0 for name, case in points.items()
    }
    result["paper_error_dm"] = PAPER_ERROR_DM
    result |= _random_poses(seed, seeds)
    result |= _times(points["A"])
    result["pictures"] = _draw(points, estimates, out)
    return result


def table(result: dict) -> list[list[str]]:
    """The paper's table 1 and more, header first."""
    rows = [["", "paper", "landfall"]]
    for name, paper in result["paper_error_dm"].items():
        rows.append([f"error at point {name} [dm]", f"{paper:.2f}", f"{result['error_dm'][name]:.2f}"])
    within = f"within {RIGHT_M * 10:g} dm and one heading step, {result['poses']} random poses"
    rows += [
        [within, "", _percent(result["success"])],
        ["without the minimum filter", "no similarity", _percent(result["success_without_filter"])],
        ["without masks", "not given", _percent(result["success_without_masks"])],
        ["likelihood field, refined pose", "", _percent(result["success_search_refined"])],
        ["128 x 128 x 64 scores, one thread [ms]", "low load", f"{result['volume_ms']:.1f}"],
        ["the same, two threads [ms]", "", f"{result['volume_two_threads_ms']:.1f}"],
        ["64 bare transforms each way [ms]", "", f"{result['bare_fft_ms']:.1f}"],
    ]
    return rows


def locate(case: Case, minimum_filter: bool = True, masks: bool = True) -> Pose2:
    """The free cell and heading of the largest correlation: the method's own, unrefined answer."""
    volume = correlate(case, minimum_filter, masks)
    free = np.where(case.map.grid.cells == 0, volume, -np.inf)
    heading, row, col = np.unravel_index(int(np.argmax(free)), free.shape)
    x_m, y_m = case.map.grid.center_of(int(row), int(col))
    return Pose2(x_m, y_m, int(heading) * STEP_RAD)


def correlate(case: Case, minimum_filter: bool = True, masks: bool = True) -> np.ndarray:
    """C over heading, row, column. Both maps blurred: the same as the environment's blurred twice."""
    grid = case.map.grid
    blurred = blurred_map(grid, raised_cosine_mask(MASK_CELLS), 2 if masks else 0)
    return correlation_volume(
        case.map, case.scan(minimum_filter), rotation_step_rad=STEP_RAD, values=blurred
    ).scores


def _case(map: PreparedMap, T_map_robot: Pose2, seed: int) -> Case:
    return Case(map, T_map_robot, read_turn(map, T_map_robot, seed))


def _random_poses(seed: int, seeds: int) -> dict:
    """Shares of random poses that are found, with everything and with a part left out."""
    cases = []
    for room_seed in range(seed, seed + seeds):
        map = make_room(room_seed)
        for i, pose in enumerate(random_poses(map, POSES_A_ROOM, room_seed)):
            cases.append(_case(map, pose, 1000 * room_seed + i))
    estimates = [locate(case) for case in cases]
    errors_dm = [
        translation_distance(estimate, case.T_map_robot) * 10.0
        for estimate, case in zip(estimates, cases, strict=True)
    ]
    return {
        "poses": len(cases),
        "success": _share(_is_right(estimate, case) for estimate, case in zip(estimates, cases, strict=True)),
        "success_without_filter": _share(
            _is_right(locate(case, minimum_filter=False), case) for case in cases
        ),
        "success_without_masks": _share(_is_right(locate(case, masks=False), case) for case in cases),
        "success_search_refined": _share(_is_right(_search(case), case) for case in cases),
        "median_error_dm": statistics.median(errors_dm) if errors_dm else None,
    }


def _search(case: Case) -> Pose2 | None:
    """search() with method fft: the map's likelihood field in place of masks, refined below the grid."""
    result = search(case.map, None, case.scan(), method="fft", rotation_step_rad=STEP_RAD)
    return result.hypotheses[0].T_map_robot if result.hypotheses else None


def _is_right(estimate: Pose2 | None, case: Case) -> bool:
    return (
        estimate is not None
        and translation_distance(estimate, case.T_map_robot) <= RIGHT_M
        and angle_distance(estimate.theta_rad, case.T_map_robot.theta_rad) <= STEP_RAD
    )


def _share(found) -> float:
    answers = list(found)
    return sum(answers) / len(answers) if answers else 0.0


def _times(case: Case) -> dict:
    """Medians, interleaved: the volume on one and two threads beside bare transforms of the same size."""
    scan = case.scan()
    rows, cols = correlation_volume(case.map, scan, rotation_step_rad=STEP_RAD).transform_shape
    time_bare_transforms(rows, cols, 1)
    times: dict[str, list[float]] = {"volume_ms": [], "volume_two_threads_ms": [], "bare_fft_ms": []}
    for _ in range(TIMED):
        for name, threads in (("volume_ms", 1), ("volume_two_threads_ms", 2)):
            start = time.perf_counter()
            correlation_volume(case.map, scan, rotation_step_rad=STEP_RAD, threads=threads)
            times[name].append(1e3 * (time.perf_counter() - start))
        times["bare_fft_ms"].append(1e3 * time_bare_transforms(rows, cols, HEADINGS))
    medians: dict = {name: statistics.median(values) for name, values in times.items()}
    return medians | {"transform_shape": [rows, cols]}


def _draw(points: dict[str, Case], estimates: dict[str, Pose2], out: Path) -> list[str]:
    from landfall.reproduce._fft_pictures import draw_headings, draw_points, draw_slices

    volumes = {name: correlate(case) for name, case in points.items()}
    maps = {name: case.map.grid for name, case in points.items()}
    turns = {name: (case.scan(False), case.scan()) for name, case in points.items()}
    truths = {name: case.T_map_robot for name, case in points.items()}
    draw_points(maps, turns, truths, estimates, out / "points.png")
    draw_slices(volumes, CELL_M, truths, out / "slices.png")
    draw_headings(volumes, out / "headings.png")
    return [str(out / name) for name in ("points.png", "slices.png", "headings.png")]


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"
