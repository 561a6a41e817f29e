"""landfall evaluate: estimates against truth."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import load_trajectory
from landfall.commands.tables import print_table
from landfall.errors import InvalidArgument
from landfall.evaluation import Judged, judge, load_estimates, report


def run(
    estimate: Annotated[Path, typer.Option("--estimate", help="poses.tum or results.jsonl.")],
    truth: Annotated[Path, typer.Option("--truth", help="TUM trajectory of the robot's true poses.")],
    translation_m: Annotated[
        float, typer.Option("--translation-m", min=0.0, help="Right within this.")
    ] = 0.25,
    rotation_deg: Annotated[float, typer.Option("--rotation-deg", min=0.0, help="And within this.")] = 3.0,
    skip_first: Annotated[
        int,
        typer.Option(
            "--skip-first", min=0, help="Leave out the truth's first lines (a TUM file of windows)."
        ),
    ] = 0,
    exclude_index: Annotated[
        str, typer.Option("--exclude-index", help="Truth lines to set aside, from 0: 198,199.")
    ] = "",
    truth_map: Annotated[
        int | None,
        typer.Option("--truth-map", min=0, help="Which --map the truth lies on, from 0; elsewhere is wrong."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> None:
    """Success rate and errors; with results.jsonl also whether verdicts and probabilities are honest.

    All queries count, and no hypothesis is a failure. Queries are the lines of results.jsonl that truth
    knows; for a TUM file, which has no line where nothing was found, they are the lines of the truth.
    """
    estimates, estimates_are_queries = load_estimates(estimate)
    true_poses = load_trajectory(truth)
    judged = judge(
        true_poses,
        estimates,
        estimates_are_queries=estimates_are_queries,
        skip_first=skip_first,
        exclude=_indices(exclude_index, len(true_poses)),
        truth_map=truth_map,
    )
    _warn_of_maps(judged, truth_map)
    numbers = report(judged, translation_m, math.radians(rotation_deg))
    if as_json:
        print(json.dumps(numbers))
    else:
        print_report(numbers)


def _warn_of_maps(judged: Sequence[Judged], truth_map: int | None) -> None:
    """On floors that are copies of each other an answer one floor off would pass for right."""
    maps = sorted({q.estimate.map_index for q in judged if q.estimate and q.estimate.T_map_robot})
    if truth_map is None and len(maps) > 1:
        listed = ", ".join(map(str, maps))
        typer.echo(
            f"landfall: warning: answers lie on maps {listed}; --truth-map: on which the truth", err=True
        )


def _indices(text: str, lines: int) -> set[int]:
    try:
        indices = {int(part) for part in text.split(",") if part.strip()}
    except ValueError:
        raise InvalidArgument(f"--exclude-index {text!r}: expected whole numbers like 198,199") from None
    beyond = sorted(index for index in indices if not 0 <= index < lines)
    if beyond:
        raise InvalidArgument(f"--exclude-index {beyond[0]}: the truth has {lines} lines, counted from 0")
    return indices


def print_report(numbers: dict) -> None:
    """The tables that a person reads."""
    translation, rotation = numbers["translation_m"], numbers["rotation_deg"]
    within = numbers["within"]
    print_table(
        [
            ("queries", str(numbers["queries"])),
            ("answered", str(numbers["answered"])),
            (
                f"right (within {within['translation_m']:g} m and {within['rotation_deg']:g} deg)",
                str(numbers["right"]),
            ),
            ("success rate", _percent(numbers["success_rate"])),
            ("position error of the right, median / 95 %", _pair(translation, "m", 3)),
            ("heading error of the right, median / 95 %", _pair(rotation, "deg", 2)),
        ]
    )
    if "verdicts" in numbers:
        _print_verdicts(numbers["verdicts"])
        _print_probabilities(numbers["probability"])


def _print_verdicts(verdicts: dict) -> None:
    rows = [
        (name, str(verdicts[name]["queries"]), str(verdicts[name]["right"]))
        for name in ("found", "ambiguous", "lost")
    ]
    print_table(rows, ("verdict", "queries", "right"))
    print(f"of the found, right: {_percent(verdicts['found_that_are_right'])}")
    print(f"of the right, found: {_percent(verdicts['right_that_are_found'])}")


def _print_probabilities(bins: list[dict]) -> None:
    rows = [
        (
            f"{row['from']:g} to {row['to']:g}",
            str(row["queries"]),
            str(row["right"]),
            _percent(row["precision"]),
        )
        for row in bins
        if row["queries"]
    ]
    print_table(rows, ("probability", "queries", "right", "precision"))


def _percent(share: float | None) -> str:
    return "-" if share is None else f"{100.0 * share:.2f} %"


def _pair(quantiles: dict, unit: str, digits: int) -> str:
    if quantiles["median"] is None:
        return "-"
    return f"{quantiles['median']:.{digits}f} / {quantiles['p95']:.{digits}f} {unit}"
