"""The number of cells that the engine chooses for method `fsdn`, against others: expected processor time and
rays until the right mode, the same starts for every number, in search spaces of several sizes.

    .venv/bin/python bench/fsdn_cells.py [--starts 300] [--seed 301] [--spaces N] [--results bench/RESULTS.md]

Places are of other seeds than those of `landfall reproduce fsdn`.
"""

from __future__ import annotations

import argparse
import datetime
import json
import sys
from pathlib import Path

from landfall.reproduce._fsdn_cells import SPACES, chosen_cells, compare, make_starts, search_space
from landfall.reproduce._workshop import make_scanners
from results_page import rewrite_measured, table

NUMBERS = (16, 32, 64, 128, 256, 512, 1024, 2048)
LARGEST_OVER_CHOSEN = 8  # more cells than that were never better, and take longest


def parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--starts", type=int, default=300, help="in each space; a third in the largest")
    parser.add_argument("--seed", type=int, default=301, help="of the first place")
    parser.add_argument("--spaces", type=int, default=len(SPACES), help="the first so many")
    parser.add_argument("--json", type=Path, help="all numbers")
    parser.add_argument("--results", type=Path, help="a page whose part fsdn_cells is rewritten")
    return parser.parse_args(arguments)


def measure(spaces: int, starts: int, seed: int) -> dict:
    """By search space."""
    sensor = make_scanners()
    measured = {}
    for space in SPACES[:spaces]:
        asked = make_starts(space, starts // 3 if space == SPACES[-1] else starts, sensor, seed)
        chosen = chosen_cells(asked[0])
        numbers = [n for n in NUMBERS if n <= LARGEST_OVER_CHOSEN * chosen]
        measured[space] = {"regions": search_space(asked[0]), **compare(asked, numbers, chosen)}
        print(f"fsdn_cells: {space}: {_ratio(measured[space]['cpu_over_best'])}", file=sys.stderr, flush=True)
    return measured


def rows(measured: dict) -> list[list[str]]:
    header = ["search space", "cells", "expected processor ms", "median; 95 %", "expected 1,000 rays"]
    lines = [[*header, "right mode", "within 1 cm, 1 degree", "iterations"]]
    for space, found in measured.items():
        for row in found["rows"]:
            is_chosen = row["cells"] == found["chosen"]
            lines.append(
                [
                    space,
                    f"**{row['cells']}**" if is_chosen else str(row["cells"]),
                    f"{row['cpu_ms']:.2f}",
                    f"{row['cpu_ms_median']:.2f}; {row['cpu_ms_p95']:.1f}",
                    f"{1e-3 * row['rays']:.1f}",
                    f"{100.0 * row['success']:.1f} %",
                    f"{100.0 * row['success_raw']:.0f} %",
                    f"{row['iterations']:.0f}",
                ]
            )
    return lines


def ratio_rows(measured: dict) -> list[list[str]]:
    lines = [["search space", "regions", "starts", "cells chosen", "time over the best number's", "rays"]]
    for space, found in measured.items():
        lines.append(
            [
                space,
                f"{found['regions']:,.0f}",
                str(found["starts"]),
                str(found["chosen"]),
                _ratio(found["cpu_over_best"]),
                _ratio(found["rays_over_best"]),
            ]
        )
    return lines


def _ratio(ratio: tuple[float, float, float]) -> str:
    return f"{ratio[0]:.2f} ({ratio[1]:.2f} to {ratio[2]:.2f})"


def main(arguments: list[str] | None = None) -> None:
    options = parse(arguments)
    measured = measure(options.spaces, options.starts, options.seed)
    text = f"{datetime.date.today().isoformat()}\n\n{table(ratio_rows(measured))}\n\n{table(rows(measured))}"
    print(text)
    if options.json:
        options.json.write_text(json.dumps(measured, indent=1))
    if options.results:
        rewrite_measured(options.results, {"fsdn_cells": text})


if __name__ == "__main__":
    main()
