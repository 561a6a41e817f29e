"""landfall map --method slam: a log whose poses nobody knows into a map, and the path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from landfall._landfall import Scan, Slam, SlamStep, save_grid_map, save_trajectory
from landfall.errors import InvalidArgument
from landfall.map_pictures import GrowingMapGif, save_built_map
from landfall.outputs import require_writable
from landfall.progress import progress_bar
from landfall.scan_mapping import SlamResult, slam

MOST_FRAMES = 120  # of an animation


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
    files = [request.trajectory, request.picture, request.animation]
    for file in files:
        if file is not None:
            require_writable(file)
    if not scans:
        raise InvalidArgument(f"{log}: no scans")
    result = _run(scans, request)
    path = [step.T_map_robot for step in result.steps]
    save_grid_map(result.map, request.out)
    save_built_map(result.map, path, request.picture or request.out.with_suffix(".path.png"))
    if request.trajectory is not None:
        save_trajectory([(s.stamp_s, p) for s, p in zip(scans, path, strict=True)], request.trajectory)
    print(_summary(request.out, result))


def _run(scans: Sequence[Scan], request: SlamRequest) -> SlamResult:
    every = max(1, -(-len(scans) // MOST_FRAMES))
    path = []
    with progress_bar() as bar, GrowingMapGif(request.animation or Path()) as gif:
        task = bar.add_task("scans", total=len(scans))

        def on_step(mapping: Slam, step: SlamStep) -> None:
            bar.advance(task)
            path.append(step.T_map_robot)
            if request.animation is not None and (len(path) % every == 0 or len(path) == len(scans)):
                gif.add(mapping.map(), path)

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
