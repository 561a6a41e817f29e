"""Espino, Moreno, Curto, Aguilar: autolocalization using the convolution of the extended robot.

A room of 6 x 9 m, eight sonars, a turn on the spot in 32 steps, 1 dm per pixel, 128 x 128 x 64 poses; the
paper's three points, and random poses in seeded rooms. Sonars meet the walls where they are, the map knows
them by cells.

`success` is of the complete method: the pose that search() with method fft ranks first. The volume's maxima,
refined, are judged by all readings of the turn, also those that the minimum filter drops; the likelihood
field stands for the masked map. What is left out of it, or done otherwise, goes the same way.
`success_raw` is of the volume's maximum alone (equation 11), on the lattice, of the map blurred by the mask.

The minimum filter is merge_turn_minima, over all sonars together; the paper's own, sonar by sonar, is
reported beside it. The environment's map is blurred (equation 15), the robot's not, but for
`success_raw_both_masks` (equation 16).
"""

from __future__ import annotations

import math
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
    return _condensed(merge_turn(keep_local_minima(turn)), turn)


def unfiltered(turn: list[Scan]) -> Scan:
    """Every reading is an end point."""
    return _condensed(merge_turn(turn), turn)


def _condensed(scan: Scan, turn: list[Scan]) -> Scan:
    return Scan(scan.sensor, scan.ranges_m, measured=merge_turn(turn))


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
    estimates = {name: find(case) for name, case in points.items()}
    result["error_dm"] = {name: _error_dm(estimates[name], case) for name, case in points.items()}
    result["error_raw_dm"] = {name: _error_dm(locate(case), case) for name, case in points.items()}
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
    rows += [
        [f"the same at {name}, the volume's maximum alone", "", f"{error_dm:.2f}"]
        for name, error_dm in result["error_raw_dm"].items()
    ]
    within = f"within {RIGHT_M * 10:g} dm and one heading step, {result['poses']} random poses"
    rows += [
        [within, "", _percent(result["success"])],
        ["minimum filter sonar by sonar", "", _percent(result["success_paper_filter"])],
        ["without the minimum filter", "no similarity", _percent(result["success_without_filter"])],
        ["without masks", "not given", _percent(result["success_without_masks"])],
        ["not judged by what the filter drops", "", _percent(result["success_unjudged"])],
        ["the volume's maximum alone, unrefined", "", _percent(result["success_raw"])],
        ["maximum, filter sonar by sonar", "", _percent(result["success_raw_paper_filter"])],
        ["maximum, no filter", "no similarity", _percent(result["success_raw_without_filter"])],
        ["maximum, no masks", "not given", _percent(result["success_raw_without_masks"])],
        ["maximum, both maps masked", "", _percent(result["success_raw_both_masks"])],
        [
            f"maximum, map cut to its walls, {result['wrapped']['poses']} poses",
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


def find(case: Case, filter: Filter = merge_turn_minima, masks: int = MASKS) -> Pose2 | None:
    """The complete method: what search() ranks first."""
    return _search(_with_masks(case.room.map, masks), filter(case.turn))


def _with_masks(map: PreparedMap, masks: int) -> PreparedMap:
    """Without masks: a likelihood field that is nothing but the occupied cells."""
    return map if masks else PreparedMap(map.grid, field_sigma_m=0.1 * CELL_M)


def _find_unjudged(case: Case) -> Pose2 | None:
    """By the end points that the filter keeps, alone."""
    scan = merge_turn_minima(case.turn)
    return _search(case.room.map, Scan(scan.sensor, scan.ranges_m))


def _search(map: PreparedMap, scan: Scan) -> Pose2 | None:
    hypotheses = search(map, None, scan, method="fft", rotation_step_rad=STEP_RAD).hypotheses
    return hypotheses[0].T_map_robot if hypotheses else None


def locate(case: Case, filter: Filter = merge_turn_minima, masks: int = MASKS) -> Pose2:
    """The free cell and heading of the largest correlation: the paper's answer."""
    return argmax(case.room.map.grid, correlate(case.room.map, filter(case.turn), masks))


def _error_dm(estimate: Pose2 | None, case: Case) -> float:
    return 10.0 * translation_distance(estimate, case.T_map_robot) if estimate else math.inf


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
        "success": find,
        "success_paper_filter": lambda case: find(case, by_sonar),
        "success_without_filter": lambda case: find(case, unfiltered),
        "success_without_masks": lambda case: find(case, masks=0),
        "success_unjudged": _find_unjudged,
        "success_raw": locate,
        "success_raw_paper_filter": lambda case: locate(case, by_sonar),
        "success_raw_without_filter": lambda case: locate(case, unfiltered),
        "success_raw_without_masks": lambda case: locate(case, masks=0),
        "success_raw_both_masks": lambda case: locate(case, masks=2),
    }
    estimates: dict[str, list[Pose2 | None]] = {name: [] for name in ways}
    with progress_bar() as bar:
        task = bar.add_task("poses", total=len(cases))
        for case in cases:
            for name, way in ways.items():
                estimates[name].append(way(case))
            bar.advance(task)
    medians = {
        name: statistics.median(
            _error_dm(estimate, case) for estimate, case in zip(estimates[found], cases, strict=True)
        )
        for name, found in (("median_error_dm", "success"), ("median_error_raw_dm", "success_raw"))
    }
    shares = {
        name: _share(_is_right(one, case) for one, case in zip(found, cases, strict=True))
        for name, found in estimates.items()
    }
    return {"poses": len(cases)} | medians | shares


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


def _draw(points: dict[str, Case], estimates: dict[str, Pose2 | None], out: Path) -> list[str]:
    from landfall.reproduce._fft_pictures import draw_headings, draw_points, draw_slices, draw_wrap

    scans = {name: merge_turn_minima(case.turn) for name, case in points.items()}
    volumes = {name: correlate(case.room.map, scans[name]) for name, case in points.items()}
    maps = {name: case.room.map.grid for name, case in points.items()}
    turns = {name: (merge_turn(case.turn), scans[name]) for name, case in points.items()}
    truths = {name: case.T_map_robot for name, case in points.items()}
    found = {name: pose for name, pose in estimates.items() if pose is not None}
    draw_points({name: maps[name] for name in found}, turns, truths, found, out / "points.png")
    draw_slices(volumes, CELL_M, truths, out / "slices.png")
    draw_headings(volumes, out / "headings.png")
    cut = PreparedMap(cut_to_walls(maps["C"]))
    draw_wrap(cut.grid, correlate(cut, scans["C"]), correlate_wrapped(cut, scans["C"]), out / "wrap.png")
    return [str(out / name) for name in ("points.png", "slices.png", "headings.png", "wrap.png")]


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"
