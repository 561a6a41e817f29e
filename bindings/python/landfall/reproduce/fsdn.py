"""Beattie & Bishop: self-localisation in the SENARIO autonomous wheelchair, by focused stochastic diffusion.

A workshop of 19.2 x 18.13 m with machines and pillars, two 180-degree scanners back to back, 720 beams with
1 cm of noise; 1,920 x 1,813 x 360 poses. Cold starts from anywhere, updates that know the previous pose,
things that the plan lacks, and time against the number of cells. Times are wall times of search() with all
threads, and, beside them, the processor time of the whole process, which a busy machine does not stretch.
"""

from __future__ import annotations

import math
import statistics
import time
from pathlib import Path

import numpy as np

from landfall._landfall import (
    Anywhere,
    Pose2,
    PreparedMap,
    Scan,
    SearchResult,
    Sensor,
    Window,
    active_isa,
    angle_distance,
    run_diffusion,
    simulate,
    time_bare_rays,
    translation_distance,
)
from landfall.progress import progress_bar
from landfall.reproduce._fsdn_cells import NEAR_M, chosen_cells, compare, make_starts, spend
from landfall.reproduce._fsdn_logs import ask_logs
from landfall.reproduce._workshop import (
    BEAMS,
    HEIGHT_M,
    WIDTH_M,
    Workshop,
    make_room,
    make_scanners,
    make_workshop,
)
from landfall.searching import search

STARTS_A_SEED = 50
OBSTRUCTED_A_SEED = 5
OBSTRUCTED_SHARES = (0.0, 0.1, 0.2, 0.3, 0.4)
OBSTACLE_RADIUS_M = 0.25
RIGHT_M, RIGHT_RAD = 0.01, math.radians(1.0)
PREVIOUS_M, PREVIOUS_RAD = 0.25, math.radians(10.0)
CELLS = (16, 64, 128, 256, 512, 1024, 2048, 4096, 16384)
CURVE_STARTS = 20
CHOICE_CELLS = (16, 32, 64, 128, 256, 512, 1024)
CHOICE_STARTS = 100
PLAIN_STARTS = 3
PAPER_COLD_MS, PAPER_WARM_MS, PAPER_CELLS = 120_000.0, 8_000.0, 200
BARE_RAYS = 200_000


def run(seed: int, seeds: int, out: Path) -> dict:
    """The JSON object; pictures under `out`."""
    result: dict = {"seed": seed, "seeds": seeds, "isa": active_isa(), "beams": BEAMS}
    result["poses"] = 1920 * 1813 * 360
    places = [make_workshop(s) for s in range(seed, seed + seeds)]
    maps = [workshop.map() for workshop in places]
    sensor = make_scanners()
    with progress_bar() as bar:
        task = bar.add_task("starts", total=seeds)
        cold = _Tally()
        warm = _Tally()
        obstructed = {share: _Tally() for share in OBSTRUCTED_SHARES}
        for s, workshop, map in zip(range(seed, seed + seeds), places, maps, strict=True):
            _ask_cold_and_warm(workshop, map, sensor, s, cold, warm)
            _ask_obstructed(workshop, map, sensor, s, obstructed)
            bar.advance(task)
        result |= _summary(cold, warm, obstructed)
        result |= _curve(sensor, seed)
        result["plain_room"] = _plain_in_a_room(sensor, seed)
    result |= _rays(places[0], maps[0], sensor, seed)
    result["logs"] = ask_logs(seed)
    result["pictures"] = _draw(places[0], maps[0], sensor, seed, result, out)
    return result


def table(result: dict) -> list[list[str]]:
    """The paper's numbers beside ours, header first."""
    paper = "not given"
    rows = [["", "paper (486, 100 MHz)", "landfall"]]
    rows += [
        [f"within 1 cm and 1 degree, {result['starts']} cold starts", paper, _percent(result["success"])],
        ["the network's own estimate", paper, _percent(result["success_raw"])],
        ["verdict found", paper, _percent(result["found"])],
        ["found, but elsewhere", paper, _percent(result["found_but_wrong"])],
        ["cold start, median; 95 % [ms]", "120,000", _two(result["cold_ms_median"], result["cold_ms_p95"])],
        ["the same, processor time [ms]", "", _two(result["cold_cpu_ms_median"], result["cold_cpu_ms_p95"])],
        [
            "pose before known, median; 95 % [ms]",
            "8,000",
            _two(result["warm_ms_median"], result["warm_ms_p95"]),
        ],
        ["the same, processor time [ms]", "", _two(result["warm_cpu_ms_median"], result["warm_cpu_ms_p95"])],
        ["the same, within 1 cm and 1 degree", paper, _percent(result["success_warm"])],
        ["cells", "200", str(result["cells"])],
        ["time with these over that with the best number", paper, _with_bounds(result["choice"])],
        ["share of time in ray casting", "most", _percent(result["cast_share"])],
        ["rays tested [M/s]; raycaster alone", "", f"{result['cast_mrays']:.1f}; {result['bare_mrays']:.1f}"],
    ]
    for share, success in result["success_by_obstacles"].items():
        rows.append([f"{100 * float(share):.0f} % of the beams shortened", "robust", _percent(success)])
    plain = result["plain_room"]
    rows.append(
        [
            "plain network, room of 4 x 4 m, processor time [ms]",
            paper,
            f"{plain['sdn_ms']:,.0f} ({_percent(plain['sdn_success'])})",
        ]
    )
    rows.append(
        [
            "focused network, the same room",
            paper,
            f"{plain['fsdn_ms']:,.0f} ({_percent(plain['fsdn_success'])})",
        ]
    )
    for building, methods in result["logs"].items():
        for method, row in methods.items():
            asked = f"{building}, {method}, {row['queries']} queries: right; processor time [ms]"
            rows.append([asked, "", f"{_percent(row['success'])}; {row['cpu_ms_median']:,.0f}"])
    return rows


class _Tally:
    """Answers and what they took."""

    def __init__(self) -> None:
        self.right: list[bool] = []
        self.right_raw: list[bool] = []
        self.found: list[bool] = []
        self.wall_ms: list[float] = []
        self.cpu_ms: list[float] = []

    def ask(
        self, map: PreparedMap, prior: Anywhere | Window, scan: Scan, T_map_robot: Pose2, seed: int
    ) -> None:
        wall_s, cpu_s = time.perf_counter(), time.process_time()
        result: SearchResult = search(map, prior, scan, method="fsdn", seed=seed)
        self.wall_ms.append(1e3 * (time.perf_counter() - wall_s))
        self.cpu_ms.append(1e3 * (time.process_time() - cpu_s))
        best = result.hypotheses[0] if result.hypotheses else None
        self.right.append(best is not None and is_right(best.T_map_robot, T_map_robot))
        self.right_raw.append(best is not None and is_right(best.T_map_robot_unrefined, T_map_robot))
        self.found.append(result.verdict == "found")


def more_tables(result: dict) -> dict[str, list[list[str]]]:
    """Expected time until the right mode is found, by the number of cells."""
    header = ["processor ms, 1 thread", "wall ms, 1 thread", "wall ms, 2 threads", "right mode", "iterations"]
    rows = [["cells", *header]]
    for row in result["curve"]:
        times = [row[key] for key in ("cpu_ms_1", "wall_ms_1", "wall_ms_2")]
        rows.append(
            [
                str(row["cells"]),
                *("-" if ms is None else f"{ms:.1f}" for ms in times),
                f"{100.0 * row['success_1']:.0f} %",
                f"{row['iterations']:.0f}",
            ]
        )
    return {"cells": rows}


def is_right(estimate: Pose2, truth: Pose2) -> bool:
    return (
        abs(estimate.x_m - truth.x_m) <= RIGHT_M
        and abs(estimate.y_m - truth.y_m) <= RIGHT_M
        and angle_distance(estimate.theta_rad, truth.theta_rad) <= RIGHT_RAD
    )


def _ask_cold_and_warm(
    workshop: Workshop, map: PreparedMap, sensor: Sensor, seed: int, cold: _Tally, warm: _Tally
) -> None:
    rng = np.random.default_rng([seed, 2])
    truths = workshop.random_poses(STARTS_A_SEED, rng)
    for i, (scan, truth) in enumerate(zip(simulate(map, sensor, truths, seed=seed), truths, strict=True)):
        cold.ask(map, Anywhere(), scan, truth, 1000 * seed + i)
        off = rng.uniform(-1.0, 1.0, 3) * (PREVIOUS_M, PREVIOUS_M, PREVIOUS_RAD)
        before = Pose2(truth.x_m + off[0], truth.y_m + off[1], truth.theta_rad + off[2])
        window = Window(before, PREVIOUS_M, PREVIOUS_M, PREVIOUS_RAD)
        warm.ask(map, window, scan, truth, 1000 * seed + i)


def _ask_obstructed(
    workshop: Workshop, map: PreparedMap, sensor: Sensor, seed: int, tallies: dict[float, _Tally]
) -> None:
    rng = np.random.default_rng([seed, 3])
    truths = workshop.random_poses(OBSTRUCTED_A_SEED, rng)
    scans = simulate(map, sensor, truths, seed=seed + 7_000_000)
    for i, (scan, truth) in enumerate(zip(scans, truths, strict=True)):
        for share, tally in tallies.items():
            shortened = obstruct(workshop, scan, truth, share, np.random.default_rng([seed, 4, i]))
            tally.ask(map, Anywhere(), shortened, truth, 1000 * seed + i)


def obstruct(
    workshop: Workshop, scan: Scan, T_map_robot: Pose2, share: float, rng: np.random.Generator
) -> Scan:
    """Discs that the plan lacks, one after the other, until so many of the beams are shortened."""
    mounts = np.array(
        [[T.x_m, T.y_m, T.theta_rad] for T in (T_map_robot * b.T_robot_beam for b in scan.sensor.beams)]
    )
    along = np.stack([np.cos(mounts[:, 2]), np.sin(mounts[:, 2])], axis=1)
    before = np.array(scan.ranges_m, dtype=float)
    ranges = before.copy()
    while np.mean(ranges < before) < share:
        center = rng.uniform((0.0, 0.0), (WIDTH_M, HEIGHT_M))
        away = math.hypot(center[0] - T_map_robot.x_m, center[1] - T_map_robot.y_m)
        if away < OBSTACLE_RADIUS_M + 0.5 or not workshop.is_free(*center):
            continue
        to = center - mounts[:, :2]
        ahead = (to * along).sum(axis=1)
        inside = OBSTACLE_RADIUS_M**2 - ((to**2).sum(axis=1) - ahead**2)
        hit = ahead - np.sqrt(np.maximum(0.0, inside))
        seen = (inside > 0.0) & (hit > 0.0) & (hit < ranges)
        noise = scan.sensor.range_noise_m * rng.standard_normal(len(hit))
        ranges[seen] = (hit + noise)[seen]
    return Scan(scan.sensor, ranges.astype(np.float32), scan.stamp_s)


def _summary(cold: _Tally, warm: _Tally, obstructed: dict[float, _Tally]) -> dict:
    found = np.array(cold.found)
    summary: dict = {
        "starts": len(cold.right),
        "success": float(np.mean(cold.right)),
        "success_raw": float(np.mean(cold.right_raw)),
        "found": float(np.mean(found)),
        "found_but_wrong": float(np.mean(found & ~np.array(cold.right))),
        "success_warm": float(np.mean(warm.right)),
        "success_by_obstacles": {f"{s:.1f}": float(np.mean(t.right)) for s, t in obstructed.items()},
        "paper_cold_ms": PAPER_COLD_MS,
        "paper_warm_ms": PAPER_WARM_MS,
        "paper_cells": PAPER_CELLS,
    }
    for name, tally in (("cold", cold), ("warm", warm)):
        for kind, times in (("ms", tally.wall_ms), ("cpu_ms", tally.cpu_ms)):
            summary[f"{name}_{kind}_median"] = statistics.median(times)
            summary[f"{name}_{kind}_p95"] = float(np.percentile(times, 95))
    return summary


def _curve(sensor: Sensor, seed: int) -> dict:
    """Expected time until the right mode is found, by the number of cells: on 1 and 2 threads up to very many
    cells, and on more starts for how the number that the engine chooses compares."""
    starts = make_starts("workshop", max(CURVE_STARTS, CHOICE_STARTS), sensor, seed)
    chosen = chosen_cells(starts[0])
    curve = []
    for cells in sorted({*CELLS, chosen}):
        row: dict = {"cells": cells}
        for threads in (1, 2):
            spent = [spend(start, cells, threads) for start in starts[:CURVE_STARTS]]
            success = float(np.mean([one.right for one in spent]))
            row[f"success_{threads}"] = success
            for kind, times in (
                ("wall_ms", [one.wall_ms for one in spent]),
                ("cpu_ms", [one.processor_ms for one in spent]),
            ):
                row[f"{kind}_{threads}"] = float(np.mean(times)) / success if success > 0.0 else None
            row["iterations"] = statistics.median(one.iterations for one in spent)
        curve.append(row)
    choice = compare(starts[:CHOICE_STARTS], CHOICE_CELLS, chosen)
    return {"cells": chosen, "curve": curve, "choice": choice, "cells_over_best": choice["cpu_over_best"][0]}


def _plain_in_a_room(sensor: Sensor, seed: int) -> dict:
    """Both networks in a room of 4 x 4 m, at the same resolution; processor time until the mode is found."""
    answer: dict = {}
    for name, focused in (("sdn", False), ("fsdn", True)):
        times, right = [], []
        for i in range(PLAIN_STARTS):
            room = make_room(seed + i)
            map = room.map()
            truth = room.random_poses(1, np.random.default_rng([seed, 6, i]))[0]
            scan = simulate(map, sensor, [truth], seed=seed + i)[0]
            for modes in (1, 32):  # the first is nearly always the right one
                run = run_diffusion(map, Anywhere(), scan, focused=focused, max_modes=modes, seed=seed + i)
                found = [m for m in run.modes if translation_distance(m.T_map_robot, truth) <= NEAR_M]
                if found:
                    break
            right.append(bool(found))
            times.append(found[0].found_processor_ms if found else run.processor_ms)
        answer |= {f"{name}_ms": statistics.median(times), f"{name}_success": float(np.mean(right))}
    return answer


def _rays(workshop: Workshop, map: PreparedMap, sensor: Sensor, seed: int) -> dict:
    """The share of ray casting, and its rate beside the raycaster's own on incoherent rays."""
    rng = np.random.default_rng([seed, 7])
    truths = workshop.random_poses(20, rng)
    cast_ms = all_ms = 0.0
    rays = 0
    for i, scan in enumerate(simulate(map, sensor, truths, seed=seed)):
        run = run_diffusion(map, Anywhere(), scan, threads=1, seed=seed + i)
        cast_ms += run.cast_ms
        all_ms += run.processor_ms
        rays += run.rays_cast
    poses = workshop.random_poses(2000, rng)
    spread = [poses[i % len(poses)] for i in range(BARE_RAYS)]
    bare_s = min(time_bare_rays(map, sensor, spread) for _ in range(5))
    return {
        "cast_share": cast_ms / all_ms,
        "cast_mrays": 1e-3 * rays / cast_ms,
        "bare_mrays": 1e-6 * BARE_RAYS / bare_s,
        "rays_a_start": rays / len(truths),
    }


def _draw(
    workshop: Workshop, map: PreparedMap, sensor: Sensor, seed: int, result: dict, out: Path
) -> list[str]:
    from landfall.reproduce._fsdn_pictures import draw_curves, draw_diffusion, draw_frames, draw_workshops

    truth = workshop.random_poses(1, np.random.default_rng([seed, 8]))[0]
    scan = simulate(map, sensor, [truth], seed=seed)[0]
    run = run_diffusion(
        map, Anywhere(), scan, max_modes=1, seed=seed, snapshot_iterations=list(range(0, 400, 2))
    )
    places = [make_workshop(seed + i) for i in range(3)]
    draw_workshops(
        places,
        [place.random_poses(12, np.random.default_rng(i)) for i, place in enumerate(places)],
        out / "workshops.png",
    )
    draw_diffusion(workshop, run.snapshots, truth, out / "cells.png")
    draw_frames(workshop, run.snapshots, truth, out / "cells.gif")
    draw_curves(result["curve"], result["cells"], result["success_by_obstacles"], out / "curves.png")
    return [str(out / name) for name in ("workshops.png", "cells.png", "cells.gif", "curves.png")]


def _with_bounds(choice: dict) -> str:
    ratio, low, high = choice["cpu_over_best"]
    return f"{ratio:.2f} ({low:.2f} to {high:.2f})"


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"


def _two(median: float, p95: float) -> str:
    return f"{median:.1f}; {p95:.1f}"
