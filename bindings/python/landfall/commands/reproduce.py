"""landfall reproduce: a paper's experiment, ours beside the paper's numbers, its figures drawn."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from landfall.commands.options import Seed
from landfall.commands.tables import print_table
from landfall.errors import InvalidArgument
from landfall.outputs import make_folder
from landfall.reproduce import experiment


def run(
    paper: Annotated[str, typer.Argument(help="Name of the method whose paper it is.")],
    seed: Seed = 1,
    seeds: Annotated[int, typer.Option("--seeds", help="How many made-up places to average over.")] = 20,
    out: Annotated[Path | None, typer.Option("--out", help="Folder of the pictures.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> None:
    """A paper's experiment: ours beside the paper's numbers, its figures drawn."""
    module = experiment(paper)
    if seeds < 1:
        raise InvalidArgument(f"--seeds {seeds}: expected at least 1")
    result = module.run(seed=seed, seeds=seeds, out=make_folder(out or Path("out/reproduce") / paper))
    if as_json:
        print(json.dumps(result))
    else:
        header, *rows = module.table(result)
        print_table(rows, header)
