"""landfall demo: a made-up building relocalized from nothing."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import (
    Anywhere,
    PosePrior,
    PreparedMap,
    Scan,
    load_trajectory,
    save_grid_map,
    save_log,
    save_trajectory,
)
from landfall.building import make_building
from landfall.commands.evaluate import print_report
from landfall.commands.options import Seed, Threads
from landfall.commands.tables import print_table
from landfall.drives import drive, record
from landfall.evaluation import judge, load_estimates, report
from landfall.interrupts import CleanStop
from landfall.outputs import ResultsFile, make_folder, write_trajectory
from landfall.progress import progress_bar
from landfall.relocalization import Answers, Question, Tally, relocalize
from landfall.searching import search_options
from landfall.windows import single_queries

PICTURES = 4


def run(
    out: Annotated[Path, typer.Option("--out", help="Folder of everything that the demo writes.")] = Path(
        "out/demo"
    ),
    seed: Seed = 7,
    threads: Threads = 0,
) -> None:
    """Makes a building and a noisy log, relocalizes it from nothing, prints the table, writes pictures."""
    folder = make_folder(out)
    map, scans = _make(folder, seed)
    size = f"{map.grid.width_cells} x {map.grid.height_cells} cells"
    print(f"a building of {size}, a drive of {len(scans)} scans; each scan alone, anywhere, any heading;")
    print("one beam in ten hits somebody whom the map does not know:")
    answers, stopped = _relocalize(map, scans, threads, folder)
    _print_success(folder)
    _draw(map, scans, answers, folder)
    print(f"map, log, truth, poses, results and pictures are in {folder}")
    raise typer.Exit(stopped)


def _make(folder: Path, seed: int) -> tuple[PreparedMap, list[Scan]]:
    """The building's map, and the log with its truth beside it."""
    building = make_building(seed)
    walls = building.wall_map()
    grid = walls.to_grid(outside_unknown=True)
    truth = drive(building, seed)
    scans = record(PreparedMap(walls), truth, seed)
    save_grid_map(grid, folder / "map.yaml")
    save_trajectory(
        [(scan.stamp_s, pose) for scan, pose in zip(scans, truth, strict=True)], folder / "truth.tum"
    )
    for scan in scans:
        scan.T_map_robot = None  # the log holds what a robot would have
    save_log(scans, folder / "drive.jsonl")
    return PreparedMap(grid, name="demo"), scans


def _relocalize(map: PreparedMap, scans: list[Scan], threads: int, folder: Path) -> tuple[Answers, int]:
    question = Question([map], PosePrior(Anywhere()), search_options(threads=threads))
    queries = single_queries(len(scans))
    answers, tally = Answers(), Tally()
    with CleanStop() as stop, progress_bar() as bar, ResultsFile(folder / "results.jsonl") as results_file:
        task = bar.add_task("relocalize", total=len(queries))
        relocalize(
            scans,
            queries,
            question,
            answers=answers,
            tally=tally,
            results_file=results_file,
            keep=lambda _: True,
            on_progress=lambda n: bar.advance(task, n),
            stop=stop,
        )
    write_trajectory(answers.trajectory(), folder / "poses.tum")
    print_table(tally.rows())
    return answers, stop.exit_code


def _print_success(folder: Path) -> None:
    estimates, _ = load_estimates(folder / "results.jsonl")
    judged = judge(load_trajectory(folder / "truth.tum"), estimates, estimates_are_queries=True)
    print_report(report(judged, 0.25, math.radians(3.0)))


def _draw(map: PreparedMap, scans: list[Scan], answers: Answers, folder: Path) -> None:
    """The overview, the least certain answers, and some evenly spread ones."""
    from landfall.answer_picture import draw_answer  # matplotlib takes a while to import
    from landfall.trajectory_picture import draw_trajectory

    for old in folder.glob("scan_*.png"):
        old.unlink()
    draw_trajectory([map], answers, folder / "poses.png")
    count = len(answers.queries)
    least_certain = sorted(answers.kept, key=lambda k: _probability(answers, k))[:2]
    for position in {*least_certain, *(k * count // PICTURES for k in range(PICTURES) if count)}:
        file = folder / f"scan_{position:04d}.png"
        draw_answer([map], scans[position], answers.kept[position], file)


def _probability(answers: Answers, position: int) -> float:
    hypotheses = answers.kept[position].hypotheses
    return hypotheses[0].probability if hypotheses else 0.0
