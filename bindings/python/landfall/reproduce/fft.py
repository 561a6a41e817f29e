"""Espino, Moreno, Curto, Aguilar: autolocalization using the convolution of the extended robot.

A room of 6 x 9 m, eight sonars, a turn on the spot in 32 steps, 1 dm per pixel, 128 x 128 x 64 poses; the
paper's three points, and random poses in seeded rooms. Sonars meet the walls where they are, the map knows
them by cells.

The minimum filter is merge_turn_minima, over all sonars together; the paper's own, sonar by sonar, is
reported beside it. The environment's map is blurred by the mask (equation 15), the robot's not; with both
blurred (equation 16) about as many poses are found.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from landfall._landfall import (
    BareTransforms,
    CorrelationVolume,
    Pose2,
    PreparedMap,
    Scan,
    active_isa,
    angle_distance,
    correlation_volume,
    keep_local_minima,
    merge_turn,
    merge_turn_minima,
    transform_library,
    translation_distance,
)
from landfall.progress import progress_bar
from landfall.reproduce._fft_real import corridor8, intel
from landfall.reproduce._fft_volume import (
    HEADINGS,
    MASKS,
    STEP_RAD,
    argmax,
    correlate,
    correlate_wrapped,
    cut_to_walls,
)
from landfall.reproduce._sonar_room import CELL_M, TEST_POINTS, Room, make_room, random_poses, read_turn
from landfall.searching import search

POSES_A_ROOM = 15
WRAPPED_CASES = 60
RIGHT_M = 0.15
PAPER_ERROR_DM = {"A": 0.53, "B": 2.48, "C": 3.27}
TIMED = 15  # repetitions, interleaved


Filter = Callable[[list[Scan]], Scan]


def by_sonar(turn: list[Scan]) -> Scan:
    """Equation 14: each sonar's local minima along the turn."""
    return merge_turn(keep_local_minima(turn))


@dataclass
class Case:
    """A robot that turned on the spot at T_map_robot."""

    room: Room
    T_map_robot: Pose2
    turn: list[Scan]


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
    cases = make_cases(seed, seeds)
    result |= _random_poses(cases)
    result["wrapped"] = _wrapped(cases[:WRAPPED_CASES])
    result |= _times(points["A"])
    result["intel"], result["corridor8"] = intel(), corridor8()
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
        ["minimum filter sonar by sonar", "", _percent(result["success_paper_filter"])],
        ["without the minimum filter", "no similarity", _percent(result["success_without_filter"])],
        ["without masks", "not given", _percent(result["success_without_masks"])],
        ["both maps masked", "", _percent(result["success_both_masks"])],
        ["likelihood field, refined pose", "", _percent(result["success_search_refined"])],
        [
            f"map cut to its walls, {result['wrapped']['poses']} poses",
            "",
            _percent(result["wrapped"]["success_padded"]),
        ],
        ["the same, transforms that wrap", "", _percent(result["wrapped"]["success"])],
        [
            f"128 x 128 x 64 scores, one thread, {result['transforms']} [ms]",
            "low load",
            f"{result['volume_ms']:.1f}",
        ],
        ["64 bare transforms each way [ms]", "", f"{result['bare_fft_ms']:.1f}"],
        ["the volume on two threads, wall clock [ms]", "", f"{result['volume_two_threads_ms']:.1f}"],
        ["bare transforms, wall clock [ms]", "", f"{result['bare_fft_wall_ms']:.1f}"],
    ]
    return rows + _real_rows(result)


def _real_rows(result: dict) -> list[list[str]]:
    rows = []
    if (intel := result["intel"]) is not None:
        rows += [
            [
                f"intel, {intel['scans']} scans: best score is exhaustive's",
                "",
                _percent(intel["equal_to_exhaustive"]),
            ],
            ["intel, fft, one thread [ms]", "", f"{intel['fft_ms']:.1f}"],
            ["intel, branch_and_bound, one thread [ms]", "", f"{intel['branch_and_bound_ms']:.1f}"],
        ]
    if (corridor := result["corridor8"]) is not None:
        rows.append(
            [
                f"corridor8, {corridor['windows']} windows: within 0.5 m and 10 degrees",
                "",
                _percent(corridor["success"]),
            ]
        )
    return rows


def locate(case: Case, filter: Filter = merge_turn_minima, masks: int = MASKS) -> Pose2:
    """The free cell and heading of the largest correlation: the method's own, unrefined answer."""
    return argmax(case.room.map.grid, correlate(case.room.map, filter(case.turn), masks))


def _case(room: Room, T_map_robot: Pose2, seed: int) -> Case:
    return Case(room, T_map_robot, read_turn(room.walls, T_map_robot, seed))


def make_cases(seed: int, seeds: int) -> list[Case]:
    """Random poses in as many rooms as there are seeds."""
    cases = []
    for room_seed in range(seed, seed + seeds):
        room = make_room(room_seed)
        for i, pose in enumerate(random_poses(room.map, POSES_A_ROOM, room_seed)):
            cases.append(_case(room, pose, 1000 * room_seed + i))
    return cases


def _random_poses(cases: list[Case]) -> dict:
    """Shares of random poses that are found, with everything and with a part left out."""
    ways: dict[str, Callable[[Case], Pose2 | None]] = {
        "success": locate,
        "success_paper_filter": lambda case: locate(case, by_sonar),
        "success_without_filter": lambda case: locate(case, merge_turn),
        "success_without_masks": lambda case: locate(case, masks=0),
        "success_both_masks": lambda case: locate(case, masks=2),
        "success_search_refined": _search,
    }
    estimates: dict[str, list[Pose2 | None]] = {name: [] for name in ways}
    with progress_bar() as bar:
        task = bar.add_task("poses", total=len(cases))
        for case in cases:
            for name, way in ways.items():
                estimates[name].append(way(case))
            bar.advance(task)
    errors_dm = [
        translation_distance(estimate, case.T_map_robot) * 10.0
        for estimate, case in zip(estimates["success"], cases, strict=True)
        if estimate is not None
    ]
    shares = {
        name: _share(_is_right(one, case) for one, case in zip(found, cases, strict=True))
        for name, found in estimates.items()
    }
    return {"poses": len(cases), "median_error_dm": statistics.median(errors_dm)} | shares


def _wrapped(cases: list[Case]) -> dict:
    """The map cut to its walls: shares found by our padded transforms, and by the paper's, which wrap."""
    found: dict[str, list[bool]] = {"success": [], "success_padded": []}
    for case in cases:
        map, scan = PreparedMap(cut_to_walls(case.room.map.grid)), merge_turn_minima(case.turn)
        for name, volume in (
            ("success", correlate_wrapped(map, scan)),
            ("success_padded", correlate(map, scan)),
        ):
            found[name].append(_is_right(argmax(map.grid, volume), case))
    return {"poses": len(cases)} | {name: _share(iter(right)) for name, right in found.items()}


def _search(case: Case) -> Pose2 | None:
    """search() with method fft: the map's likelihood field in place of masks, refined below the grid."""
    result = search(
        case.room.map, None, merge_turn_minima(case.turn), method="fft", rotation_step_rad=STEP_RAD
    )
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
    """Medians, interleaved: the volume on one and two threads beside bare transforms of the same size.

    Two threads by the wall's clock, which needs a quiet machine; the others by the processor's.
    """
    map, scan = case.room.map, merge_turn_minima(case.turn)

    def volume(threads: int) -> CorrelationVolume:
        return correlation_volume(map, scan, rotation_step_rad=STEP_RAD, threads=threads)

    rows, cols = volume(1).transform_shape
    bare = BareTransforms(rows, cols)
    bare.run(1)
    clocks: dict[str, tuple[Callable[[], float], Callable[[], object]]] = {
        "volume_ms": (time.process_time, lambda: volume(1)),
        "bare_fft_ms": (time.process_time, lambda: bare.run(HEADINGS)),
        "volume_two_threads_ms": (time.perf_counter, lambda: volume(2)),
        "bare_fft_wall_ms": (time.perf_counter, lambda: bare.run(HEADINGS)),
    }
    times: dict[str, list[float]] = {name: [] for name in clocks}
    for _ in range(TIMED):
        for name, (now, work) in clocks.items():
            start = now()
            work()
            times[name].append(1e3 * (now() - start))
    medians: dict = {name: statistics.median(values) for name, values in times.items()}
    return medians | {"transform_shape": [rows, cols]}


def _draw(points: dict[str, Case], estimates: dict[str, Pose2], out: Path) -> list[str]:
    from landfall.reproduce._fft_pictures import draw_headings, draw_points, draw_slices, draw_wrap

    scans = {name: merge_turn_minima(case.turn) for name, case in points.items()}
    volumes = {name: correlate(case.room.map, scans[name]) for name, case in points.items()}
    maps = {name: case.room.map.grid for name, case in points.items()}
    turns = {name: (merge_turn(case.turn), scans[name]) for name, case in points.items()}
    truths = {name: case.T_map_robot for name, case in points.items()}
    draw_points(maps, turns, truths, estimates, out / "points.png")
    draw_slices(volumes, CELL_M, truths, out / "slices.png")
    draw_headings(volumes, out / "headings.png")
    cut = PreparedMap(cut_to_walls(maps["C"]))
    draw_wrap(cut.grid, correlate(cut, scans["C"]), correlate_wrapped(cut, scans["C"]), out / "wrap.png")
    return [str(out / name) for name in ("points.png", "slices.png", "headings.png", "wrap.png")]


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"
