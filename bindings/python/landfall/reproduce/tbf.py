"""Ivanjko, Petrovic, Miklic 2005: triangulation-based fusion mapping with bounding-box correction.

The paper shows pictures of one corridor. Here a Pioneer 2DX drives along seeded office corridors and by a
right turn into a room; the same readings at the same, true poses become every map. Then real readings, where
there are some, and the circle: other drives locate themselves in the map.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from landfall._landfall import GridMap, PreparedMap, Scan, WallMap, map_by_triangulation
from landfall.progress import progress_bar
from landfall.reproduce._map_scores import Truth, make_truth, score
from landfall.reproduce._office_corridor import Corridor, drive, make_corridor
from landfall.reproduce._sonar_echoes import RANGE_MAX_M, read_sonars, walk_by
from landfall.reproduce._sonar_maps import FOUR, LABELS, make_maps
from landfall.reproduce._tbf_circle import composites, is_right, is_within_a_metre, localize

WINDOWS = (2, 5, 10, 20, 50, 100, 200)
WINDOW_SEEDS = 5  # of the seeds: how map and cost depend on the window
PERSON_STEP_M = 0.06  # a scan, towards the robot
PERSON_OFF_M = 0.35  # from the left wall
CIRCLE = (("raw", "fft"), ("tbf", "fft"), ("tbf_box", "fft"), ("tbf", "grid"))
CIRCLE_LABELS = {
    "raw_fft": "sonars located in the raw map: fft, anywhere",
    "tbf_fft": "sonars located in the TBF map: fft, anywhere",
    "tbf_box_fft": "sonars located in the map of TBF + box: fft, anywhere",
    "tbf_grid": "sonars located in the TBF map: grid, within 0.8 m and 45 degrees",
}


@dataclass
class Drive:
    """One corridor, what the sonars read in it, and what could be seen."""

    corridor: Corridor
    map: PreparedMap
    T_map_robot: np.ndarray
    scans: list[Scan]
    truth: Truth


def make_drive(seed: int) -> Drive:
    rng = np.random.default_rng([seed, 8])
    corridor = make_corridor(rng)
    poses = drive(corridor, rng)
    map = PreparedMap(WallMap(corridor.walls))
    start = (0.7 * corridor.length_m, corridor.width_m - PERSON_OFF_M)
    scans = read_sonars(map, poses, rng, walk_by(poses, start, (-PERSON_STEP_M, 0.0)))
    return Drive(corridor, map, poses, scans, make_truth(map, poses, RANGE_MAX_M))


def run(seed: int, seeds: int, out: Path) -> dict:
    """The JSON object; pictures under `out`."""
    from landfall.reproduce._tbf_real import corridor8
    from landfall.reproduce._tbf_scitos import scitos24

    scores: dict[str, list[dict[str, float]]] = {}
    windows: dict[int, list[dict[str, float]]] = {}
    circle: dict[str, list[tuple[bool, bool, bool]]] = {}
    first: tuple[Drive, dict[str, GridMap]] | None = None
    for place in _with_progress(range(seed, seed + seeds)):
        here = make_drive(place)
        maps = make_maps(here.scans)
        for name, grid in maps.items():
            scores.setdefault(name, []).append(score(grid, here.truth))
        if place < seed + WINDOW_SEEDS:
            for scans in WINDOWS:
                windows.setdefault(scans, []).append(_window_row(here, scans))
        _close_circle(here, maps, place, circle)
        first = first or (here, maps)
    result: dict = {name: _mean(rows) for name, rows in scores.items()}
    result["least"] = {name: _least(rows) for name, rows in scores.items()}
    result["windows"] = {str(scans): _mean(rows) for scans, rows in windows.items()}
    result["readings_per_s"] = result["windows"]["50"]["readings_per_s"]
    result["box_raises_coverage"] = float(
        np.mean(
            [b["coverage"] > a["coverage"] for a, b in zip(scores["tbf"], scores["tbf_box"], strict=True)]
        )
    )
    result["circle"] = {name: _shares(answers) for name, answers in circle.items()}
    result |= {"seed": seed, "seeds": seeds}
    assert first is not None
    result["pictures"] = _draw(*first, out)
    result["corridor8"] = corridor8(out)
    result["scitos24"] = scitos24(out)
    return result


def _with_progress(places: Sequence[int]) -> Iterator[int]:
    with progress_bar() as bar:
        yield from bar.track(places, description="corridors")


def _window_row(here: Drive, window_scans: int) -> dict[str, float]:
    """readings_per_s: echoes fused a second of processor time, by the thread that does it all."""
    start = time.thread_time()
    result = map_by_triangulation(here.scans, window_scans=window_scans)
    spent_s = time.thread_time() - start
    echoes = sum(scan.count_echoes() for scan in here.scans)
    return score(result.map, here.truth) | {"readings_per_s": echoes / spent_s}


def _close_circle(
    here: Drive, maps: dict[str, GridMap], place: int, circle: dict[str, list[tuple[bool, bool, bool]]]
) -> None:
    """Another drive along the same corridor, nobody walking by."""
    rng = np.random.default_rng([place, 9])
    asked = composites(read_sonars(here.map, drive(here.corridor, rng), rng), rng)
    for name, method in CIRCLE:
        answers = localize(maps[name], asked, method, rng)
        circle.setdefault(f"{name}_{method}", []).extend(
            (is_right(truth, answer), is_within_a_metre(truth, answer), answer.verdict == "found")
            for (truth, _), answer in zip(asked, answers, strict=True)
        )


def _shares(answers: Sequence[tuple[bool, bool, bool]]) -> dict[str, float]:
    right, near, found = np.array(answers, dtype=float).T
    return {
        "success": float(right.mean()),
        "within_a_metre": float(near.mean()),
        "found": float(found.mean()),
        "found_but_wrong": float((found * (1.0 - right)).mean()),
        "queries": float(len(right)),
    }


def _mean(rows: Sequence[dict[str, float]]) -> dict[str, float]:
    return {key: float(np.mean([row[key] for row in rows])) for key in rows[0]}


def _least(rows: Sequence[dict[str, float]]) -> dict[str, float]:
    """The worst seed: least coverage, most artefacts."""
    return {
        "coverage": min(row["coverage"] for row in rows),
        "artefacts_per_m2": max(row["artefacts_per_m2"] for row in rows),
    }


def table(result: dict) -> list[list[str]]:
    """Header first: maps, windows, and drives that locate themselves in the maps."""
    rows = [["", "share", "worst seed", "artefacts / m2", "of raw", "worst seed", "readings / s"]]
    for name, label in LABELS.items():
        least = result["least"][name]
        rows.append(
            [
                f"walls found: {label}",
                _percent(result[name]["coverage"]),
                _percent(least["coverage"]),
                *_artefacts(result, result[name]),
                f"{least['artefacts_per_m2']:.2f}",
                "",
            ]
        )
    for scans, mean in result["windows"].items():
        rows.append(
            [
                f"walls found: TBF, window of {scans} scans",
                _percent(mean["coverage"]),
                "",
                *_artefacts(result, mean),
                "",
                f"{mean['readings_per_s']:.0f}",
            ]
        )
    for name, shares in result["circle"].items():
        rows.append([CIRCLE_LABELS[name], _percent(shares["success"]), *[""] * 5])
    return rows


def _artefacts(result: dict, mean: dict[str, float]) -> list[str]:
    """Per square metre, and beside those of the raw map of all seeds."""
    share = mean["artefacts_per_m2"] / max(result["raw"]["artefacts_per_m2"], 1e-9)
    return [f"{mean['artefacts_per_m2']:.2f}", _percent(share)]


def _draw(here: Drive, maps: dict[str, GridMap], out: Path) -> list[str]:
    from landfall.reproduce._tbf_pictures import draw_maps

    paths = {"tbf_maps.png": FOUR, "tbf_variants.png": [name for name in maps if name not in FOUR]}
    for file, names in paths.items():
        draw_maps(
            {LABELS[name]: maps[name] for name in names},
            here.T_map_robot,
            out / file,
            walls=np.asarray(here.map.walls.walls),
        )
    return [str(out / file) for file in paths]


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"
