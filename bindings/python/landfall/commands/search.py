"""landfall search: one scan, JSON on stdout."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import Scan, search_batch
from landfall.commands.options import (
    Maps,
    MaxHypotheses,
    Method,
    PriorText,
    RobotRadius,
    RotationStep,
    Seed,
    SensorFile,
    Threads,
    TimeBudget,
    TranslationStep,
    load_maps,
    naming_prior,
    read_log,
    read_prior,
    rotation_step_rad,
)
from landfall.errors import InvalidArgument
from landfall.outputs import require_picture
from landfall.searching import search_options


def run(
    map: Maps,
    scan: Annotated[Path, typer.Option("--scan", help="A log; --index says which of its scans.")],
    index: Annotated[int, typer.Option("--index", help="Which scan, from 0.")] = 0,
    picture: Annotated[Path | None, typer.Option("--picture", help="Draw the answer here.")] = None,
    method: Method = "auto",
    prior: PriorText = "anywhere",
    sensor: SensorFile = None,
    threads: Threads = 0,
    max_hypotheses: MaxHypotheses = 5,
    time_budget_s: TimeBudget = 0.0,
    translation_step_m: TranslationStep = 0.0,
    rotation_step_deg: RotationStep = 0.5,
    robot_radius_m: RobotRadius = 0.0,
    seed: Seed = 0,
) -> None:
    """Where was the robot when it took one scan?"""
    options = search_options(
        method=method,
        threads=threads,
        max_hypotheses=max_hypotheses,
        time_budget_s=time_budget_s,
        translation_step_m=translation_step_m,
        rotation_step_rad=rotation_step_rad(rotation_step_deg),
        robot_radius_m=robot_radius_m,
        seed=seed,
    )
    if picture is not None:
        require_picture(picture)
    maps = load_maps(map)
    asked = _pick(scan, index, sensor)
    with naming_prior(prior):
        result = search_batch(maps, [read_prior(prior, map)], [asked], options)[0]
    print(result.to_json(index))
    if picture is not None:
        from landfall.answer_picture import draw_answer  # matplotlib takes a while to import

        draw_answer(maps, asked, result, picture)


def _pick(log: Path, index: int, sensor: Path | None) -> Scan:
    scans = read_log(log, sensor).scans
    if not 0 <= index < len(scans):
        raise InvalidArgument(f"--index {index}: {log} has {len(scans)} scans, counted from 0")
    return scans[index]
