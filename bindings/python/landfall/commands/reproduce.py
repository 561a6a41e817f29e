"""landfall reproduce: a paper's experiment, ours beside the paper's numbers."""

from __future__ import annotations

import importlib
import json
import pkgutil
from pathlib import Path
from typing import Annotated

import typer

from landfall import reproduce
from landfall.commands.options import Seed
from landfall.commands.tables import print_table
from landfall.errors import InvalidArgument, UnknownName
from landfall.outputs import make_folder


def run(
    paper: Annotated[str, typer.Argument(help="Which paper's: grid, fft, ...")],
    seed: Seed = 1,
    seeds: Annotated[int, typer.Option("--seeds", help="So many, counted up from --seed.")] = 20,
    out: Annotated[Path, typer.Option("--out", help="Folder of the pictures.")] = Path("out/reproduce"),
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> None:
    """A paper's experiment, ours beside the paper's numbers, its figures drawn."""
    papers = sorted(module.name for module in pkgutil.iter_modules(reproduce.__path__))
    if paper not in papers:
        raise UnknownName(f"reproduce: no paper '{paper}'; known: {', '.join(papers)}")
    if seeds < 1:
        raise InvalidArgument(f"--seeds {seeds}: expected at least 1")
    experiment = importlib.import_module(f"landfall.reproduce.{paper}")
    result = experiment.run(seed, seeds, make_folder(out))
    if as_json:
        print(json.dumps(result))
        return
    header, *rows = experiment.table(result)
    print_table(rows, header)
