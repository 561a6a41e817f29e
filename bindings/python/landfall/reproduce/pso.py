"""Okada & Fujimoto: grid-based localization and mapping without odometry, experiments I to IV.

A room with the nine sides of Table III, its other walls and its furniture made up (the paper's figure 5 is a
photograph), a UHG-08LX with uniform noise. Each seed is another room: mirrored or not, other furniture,
another track. "pso" is landfall's: the published swarm, refined point to line; "pso_raw" the
swarm alone, as published.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from landfall._landfall import GridMap, Pose2, Scan, Slam, SlamStep, active_isa, map_from_known_poses
from landfall.progress import progress_bar
from landfall.reproduce._people import wandering_people
from landfall.reproduce._wheelchair_judges import (
    chain,
    lost_cells,
    measured_sides,
    off_deg,
    off_mm,
    side_errors_mm,
    sides_right,
    traces,
)
from landfall.reproduce._wheelchair_room import (
    SIDES_M,
    Room,
    along_track,
    make_room,
    read_scans,
    straight,
    turn,
)
from landfall.scan_mapping import slam_options

PERIOD_S = 0.2
STEP_M, STEPS = 0.1, 20
TURN_RAD, TURNS = -math.pi, 100
TRACK_STEP_M, TRACK_STEP_RAD = 0.1, math.radians(9.0)
ALONE_SCANS, WANDER_SCANS, GONE_SCANS = 10, 100, 15  # before the people come, with them, after
CELL_M = 0.02
TIMED = 3  # each scan's time is the least of so many runs
OURS: dict[str, dict[str, Any]] = {"pso": {}, "pso_raw": {"refine": False}}
CONVENTIONAL = ("angle_histogram", "icp", "icp_point_to_line")
PAPER = {
    "angle_histogram": {"forward_error_mm": 30.03, "backward_error_mm": 25.16, "rotation_error_deg": 7.0},
    "pso_raw": {
        "forward_error_mm": 13.36,
        "backward_error_mm": 11.84,
        "rotation_error_deg": 0.4,
        "sides_error_percent": 6.41,
        "ms_mean": 66.0,
        "ms_max": 128.0,
    },
}


@dataclass
class Drive:
    """One drive by one method."""

    poses: list[Pose2]
    grid: GridMap
    steps: list[SlamStep]

    @property
    def failures(self) -> int:
        return sum(not step.accepted or step.recovered for step in self.steps)


def run(seed: int, seeds: int, out: Path) -> dict:
    """The JSON object; pictures of the first seed under `out`."""
    with progress_bar() as bar, ThreadPoolExecutor() as pool:
        task = bar.add_task("rooms", total=seeds)
        rows = []
        for row in pool.map(lambda one: _experiments(one), range(seed, seed + seeds)):
            rows.append(row)
            bar.advance(task)
    result: dict = {"seed": seed, "seeds": seeds, "isa": active_isa(), "paper": PAPER}
    for name in (*OURS, *CONVENTIONAL):
        result[name] = _worst([row[name] for row in rows]) | {"median": _median([row[name] for row in rows])}
    result["pso"] |= {"sides": _sides([row["pso"]["side_errors_mm"] for row in rows])}
    result["pso_raw"] |= {"sides": _sides([row["pso_raw"]["side_errors_mm"] for row in rows])}
    for name, options in OURS.items():
        result[name] |= _times(seed, options)
    result["branch_and_bound"] = _by_branch_and_bound(seed)
    result["pictures"] = _draw(seed, out)
    return result


def _experiments(seed: int) -> dict:
    """All methods on one room's drives."""
    room = make_room(seed)
    rng = np.random.default_rng([seed, 2])
    drives = {"I": straight(STEP_M, STEPS), "II": turn(TURN_RAD, TURNS), "III": along(room)}
    scans = {name: read_scans(room, poses, rng, PERIOD_S) for name, poses in drives.items()}
    row: dict = {}
    for name, options in OURS.items():
        done = {key: mapped(scans[key], **options) for key in drives}
        row[name] = _errors({key: drive.poses for key, drive in done.items()}, drives)
        errors_mm = side_errors_mm(measured_sides(done["III"].grid, room))
        row[name] |= {
            "side_errors_mm": errors_mm,
            "sides_error_percent": max(_percents(errors_mm)),
            "sides_right": sum(sides_right(errors_mm)),
            "track_error_mm": max(map(off_mm, done["III"].poses, drives["III"])),
            "track_error_deg": max(map(off_deg, done["III"].poses, drives["III"])),
            "failures": sum(drive.failures for drive in done.values()),
        }
        row[name] |= _people(seed, **options)
    for name in CONVENTIONAL:
        row[name] = _errors({key: chain(scans[key], name) for key in ("I", "II")}, drives)
    return row


def along(room: Room) -> list[Pose2]:
    return along_track(room, TRACK_STEP_M, TRACK_STEP_RAD)


def mapped(
    scans: Sequence[Scan], on_step: Callable[[int, Slam], None] | None = None, **options: Any
) -> Drive:
    """One drive by SLAM, on cells of 2 cm."""
    slam = Slam(slam_options(resolution_m=CELL_M, **options))
    steps = []
    for i, scan in enumerate(scans):
        steps.append(slam.add(scan))
        if on_step is not None:
            on_step(i, slam)
    return Drive([step.T_map_robot for step in steps], slam.map(), steps)


def _errors(done: dict[str, list[Pose2]], truth: dict[str, list[Pose2]]) -> dict:
    """Of the farthest and the last pose of I, and of the last heading of II; without sign."""
    return {
        "forward_error_mm": off_mm(done["I"][STEPS], truth["I"][STEPS]),
        "backward_error_mm": off_mm(done["I"][-1], truth["I"][-1]),
        "rotation_error_deg": off_deg(done["II"][-1], truth["II"][-1]),
    }


def _percents(errors_mm: Sequence[float]) -> list[float]:
    return [abs(error) / true / 10.0 for error, true in zip(errors_mm, SIDES_M, strict=True)]


def _people(seed: int, **options: Any) -> dict:
    """Experiment IV."""
    before: list[GridMap] = []

    def keep(i: int, slam: Slam) -> None:
        if i in (ALONE_SCANS - 1, ALONE_SCANS + WANDER_SCANS - 1):
            before.append(slam.map())

    room, scans = people_drive(seed)
    grid = mapped(scans, keep, **options).grid
    near, far = traces(grid, room)
    return {
        "trace_cells_left": near,
        "trace_cells_left_farther": far,
        "trace_cells_with_people": sum(traces(before[1], room)),
        "wall_cells_lost": lost_cells(before[0], grid),
    }


def people_drive(seed: int) -> tuple[Room, list[Scan]]:
    """A robot that stands in the middle; people come, wander for 20 s and are gone."""
    room = make_room(seed, in_the_middle=True)
    rng = np.random.default_rng([seed, 3])
    legs = wandering_people(room, rng, PERIOD_S, WANDER_SCANS)
    blockers = [*([[]] * ALONE_SCANS), *legs, *([[]] * GONE_SCANS)]
    return room, read_scans(room, [Pose2()] * len(blockers), rng, PERIOD_S, blockers)


def _worst(rows: Sequence[dict]) -> dict:
    """The largest of each error over the rooms, the sum of what is counted."""
    summed = (
        "failures",
        "trace_cells_left",
        "trace_cells_left_farther",
        "trace_cells_with_people",
        "wall_cells_lost",
    )
    worst: dict = {}
    for key in rows[0]:
        if key == "side_errors_mm":
            continue
        values = [row[key] for row in rows]
        worst[key] = sum(values) if key in summed else min(values) if key == "sides_right" else max(values)
    return worst


def _median(rows: Sequence[dict]) -> dict:
    keys = [key for key in rows[0] if key.endswith(("_mm", "_deg", "_percent")) and key != "side_errors_mm"]
    return {key: float(np.median([row[key] for row in rows])) for key in keys}


def _sides(errors_mm: Sequence[Sequence[float]]) -> dict:
    """Per side: the measured length of the first room, and the worst error of all."""
    worst = np.abs(np.array(errors_mm)).max(axis=0)
    return {
        f"S{k + 1}": {
            "true_mm": 1000.0 * true,
            "first_mm": 1000.0 * true + errors_mm[0][k],
            "worst_error_mm": float(worst[k]),
            "worst_error_percent": float(worst[k] / true / 10.0),
        }
        for k, true in enumerate(SIDES_M)
    }


def _times(seed: int, options: dict) -> dict:
    """Of experiment III, one core, mapping included, the founding scan and recoveries left out."""
    room = make_room(seed)
    scans = read_scans(room, along(room), np.random.default_rng([seed, 2]), PERIOD_S)
    runs = []
    for _ in range(TIMED):
        slam = Slam(slam_options(resolution_m=CELL_M, **options))
        times = []
        for scan in scans:
            start = time.thread_time()
            step = slam.add(scan)
            spent_ms = 1000.0 * (time.thread_time() - start)
            times.append(math.nan if step.recovery_ms > 0.0 else spent_ms)
        runs.append(times[1:])
    least = np.nanmin(runs, axis=0)
    return {"ms_mean": float(np.nanmean(least)), "ms_max": float(np.nanmax(least)), "ms_scans": len(least)}


def _by_branch_and_bound(seed: int) -> dict:
    """The other matcher in the same loop, one room, experiments I and II."""
    room = make_room(seed)
    rng = np.random.default_rng([seed, 2])
    drives = {"I": straight(STEP_M, STEPS), "II": turn(TURN_RAD, TURNS)}
    scans = {name: read_scans(room, poses, rng, PERIOD_S) for name, poses in drives.items()}
    done = {key: mapped(some, matcher="branch_and_bound") for key, some in scans.items()}
    spent = [step.match_ms + step.insert_ms for drive in done.values() for step in drive.steps[1:]]
    return _errors({key: drive.poses for key, drive in done.items()}, drives) | {
        "ms_mean": float(np.mean(spent)),
        "ms_max": float(np.max(spent)),
    }


def _draw(seed: int, out: Path) -> list[str]:
    from landfall.reproduce import _pso_pictures  # takes a while to import

    room = make_room(seed)
    rng = np.random.default_rng([seed, 2])
    drives = {"I": straight(STEP_M, STEPS), "II": turn(TURN_RAD, TURNS), "III": along(room)}
    files = []
    for name, poses in drives.items():
        scans = read_scans(room, poses, rng, PERIOD_S)
        conventional = chain(scans, "angle_histogram")
        panels = {
            "Weiss et al.: angle histograms": (_map_of(scans, conventional), conventional),
            **{label: _panel(mapped(scans, **OURS[key])) for label, key in _pso_pictures.LABELS.items()},
        }
        files.append(_pso_pictures.draw_maps(panels, poses, out / f"pso_experiment_{name}.png"))
    _, scans = people_drive(seed)
    moments: list[tuple[str, GridMap]] = []

    def keep(i: int, slam: Slam) -> None:
        said = {ALONE_SCANS - 1: "alone", ALONE_SCANS + WANDER_SCANS - 1: "after 20 s of people"}
        said[len(scans) - 1] = f"{GONE_SCANS * PERIOD_S:g} s after they have gone"
        if i in said:
            moments.append((said[i], slam.map()))

    mapped(scans, keep)
    files.append(_pso_pictures.draw_moments(moments, out / "pso_experiment_IV.png"))
    return files


def _panel(drive: Drive) -> tuple[GridMap, list[Pose2]]:
    return drive.grid, drive.poses


def _map_of(scans: Sequence[Scan], poses: Sequence[Pose2]) -> GridMap:
    for scan, pose in zip(scans, poses, strict=True):
        scan.T_map_robot = pose
    return map_from_known_poses(list(scans), resolution_m=CELL_M)


ROWS = (
    ("forward_error_mm", "I: 2 m forward", "mm", 1, 10.0),
    ("backward_error_mm", "I: and back", "mm", 1, 10.0),
    ("rotation_error_deg", "II: turn by 180 deg", "deg", 2, 0.3),
    ("sides_error_percent", "III: worst side", "%", 2, None),
    ("sides_right", "III: sides right, of 9", "", 0, None),
    ("track_error_mm", "III: worst on track", "mm", 1, None),
    ("failures", "I-III: failures", "", 0, None),
    ("ms_mean", "III: a scan, mean", "ms", 2, 2.0),
    ("ms_max", "III: a scan, largest", "ms", 2, 5.0),
    ("trace_cells_with_people", "IV: traces, people there", "", 0, None),
    ("trace_cells_left", "IV: traces within 2 m", "", 0, 0.0),
    ("trace_cells_left_farther", "IV: traces farther", "", 0, None),
    ("wall_cells_lost", "IV: walls lost", "", 0, 0.0),
)
COLUMNS = {
    "angle_histogram": "Weiss",
    "icp": "ICP",
    "icp_point_to_line": "ICP, lines",
    "branch_and_bound": "b. & b.",
    "pso_raw": "raw swarm",
    "pso": "pso",
}


def table(result: dict) -> list[list[str]]:
    """The worst of all rooms, beside the paper's two columns."""
    rows = [["", "unit", "paper, Weiss", "paper", "goal", *COLUMNS.values()]]
    for key, label, unit, digits, most in ROWS:
        cells = [_cell(PAPER[name].get(key), digits) for name in ("angle_histogram", "pso_raw")]
        cells.append("" if most is None else f"<= {most:g}")
        cells += [_cell(result[name].get(key), digits) for name in COLUMNS]
        rows.append([label, unit, *cells])
    return rows


PAPER_SIDES_MM = (4482, 601, 780, 781, 500, 1405, 2040, 6603, 4422)  # Table III, proposed method


def more_tables(result: dict) -> dict[str, list[list[str]]]:
    """The nine sides, of the refined swarm."""
    rows = [["side", "true [mm]", "paper [mm]", "first room [mm]", "worst of all rooms [mm]", "[%]"]]
    for (name, side), paper_mm in zip(result["pso"]["sides"].items(), PAPER_SIDES_MM, strict=True):
        lengths = [f"{side['true_mm']:.0f}", f"{paper_mm}", f"{side['first_mm']:.0f}"]
        rows.append([name, *lengths, f"{side['worst_error_mm']:.1f}", f"{side['worst_error_percent']:.2f}"])
    return {"sides": rows}


def _cell(value: float | None, digits: int) -> str:
    return "" if value is None else f"{value:.{digits}f}"
