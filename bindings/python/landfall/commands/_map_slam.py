"""landfall map --method slam: a log whose poses nobody knows into a map, and the path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import typer

from landfall._landfall import Scan, Slam, SlamStep, save_grid_map, save_trajectory
from landfall.errors import InvalidArgument
from landfall.interrupts import CleanStop
from landfall.map_pictures import GrowingMapGif, save_built_map
from landfall.outputs import require_picture, require_writable
from landfall.progress import progress_bar
from landfall.scan_mapping import SlamResult, slam

MOST_FRAMES = 120  # of an animation
MOST_LOST = 0.1  # share of the scans that a good map may have had to be sought for


@dataclass
class SlamRequest:
    """What the command was asked."""

    out: Path
    matcher: str
    prediction: str
    resolution_m: float
    range_max_m: float
    seed: int
    raw: bool
    trajectory: Path | None
    picture: Path | None
    animation: Path | None


def map_by_slam(log: Path, scans: Sequence[Scan], request: SlamRequest) -> None:
    """Writes the map, its picture beside it, and what else was asked for; prints one line."""
    for file in (request.trajectory, request.animation):
        if file is not None:
            require_writable(file)
    if request.picture is not None:
        require_picture(request.picture)
    if request.animation is not None and request.animation.suffix.lower() != ".gif":
        raise InvalidArgument(f"--animation {request.animation}: an animation ends in .gif")
    if not scans:
        raise InvalidArgument(f"{log}: no scans")
    with CleanStop() as stop:
        result = _run(scans, request, stop)
    path = [step.T_map_robot for step in result.steps]
    save_grid_map(result.map, request.out)
    save_built_map(result.map, path, request.picture or request.out.with_suffix(".path.png"))
    if request.trajectory is not None:
        save_trajectory([(s.stamp_s, p) for s, p in zip(scans, path, strict=False)], request.trajectory)
    print(_summary(request.out, result))
    _warn(result, scans, request.prediction)
    if stop.requested:
        typer.echo(f"landfall: stopped after {len(path)} of {len(scans)} scans", err=True)
        raise typer.Exit(stop.exit_code)


def _run(scans: Sequence[Scan], request: SlamRequest, stop: CleanStop) -> SlamResult:
    every = max(1, -(-len(scans) // MOST_FRAMES))
    path = []
    with progress_bar() as bar, GrowingMapGif(request.animation or Path()) as gif:
        task = bar.add_task("scans", total=len(scans))

        def on_step(mapping: Slam, step: SlamStep) -> bool:
            bar.advance(task)
            path.append(step.T_map_robot)
            last = len(path) == len(scans) or stop.requested
            if request.animation is not None and (len(path) % every == 0 or last):
                gif.add(mapping.map(), path)
            return not stop.requested

        return slam(
            scans,
            on_step,
            matcher=request.matcher,
            prediction=request.prediction,
            resolution_m=request.resolution_m,
            range_max_m=request.range_max_m,
            refine=not request.raw,
            seed=request.seed,
        )


def _warn(result: SlamResult, scans: Sequence[Scan], prediction: str) -> None:
    """Says that a map is likely broken, as a person sees at once and a summary's numbers do not say."""
    lost = sum(step.recovered or not step.accepted for step in result.steps)
    if lost <= MOST_LOST * len(result.steps):
        return
    advice = "a slower drive or more scans a second map better"
    if prediction != "odometry" and all(scan.T_odom_robot is not None for scan in scans):
        advice = "the log has odometry: --prediction odometry maps better"
    sought = f"{lost} of {len(result.steps)} scans did not fit where they were predicted"
    typer.echo(f"landfall: warning: {sought}; {advice}", err=True)


def _summary(out: Path, result: SlamResult) -> str:
    accepted = sum(step.accepted for step in result.steps)
    recovered = sum(step.recovered for step in result.steps)
    spent_ms = [step.match_ms + step.insert_ms for step in result.steps]
    mean_ms = sum(spent_ms) / len(spent_ms)
    return (
        f"{out}: {result.map.width_cells} x {result.map.height_cells} cells from {accepted} of "
        f"{len(result.steps)} scans, {recovered} by the wider search; {mean_ms:.2f} ms a scan, "
        f"at most {max(spent_ms):.2f} (wall time)"
    )
