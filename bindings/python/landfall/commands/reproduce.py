"""landfall reproduce: a paper's experiment, ours beside the paper's numbers, its figures drawn."""

from __future__ import annotations

import importlib
import json
import pkgutil
from pathlib import Path
from types import ModuleType
from typing import Annotated

import typer

import landfall.reproduce
from landfall.commands.options import Seed
from landfall.commands.tables import print_table
from landfall.errors import InvalidArgument, UnknownName
from landfall.outputs import make_folder


def run(
    paper: Annotated[str, typer.Argument(help="Name of the method whose paper it is.")],
    seed: Seed = 1,
    seeds: Annotated[int, typer.Option("--seeds", help="How many made-up places to average over.")] = 20,
    out: Annotated[Path | None, typer.Option("--out", help="Folder of the pictures.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> None:
    """A paper's experiment: ours beside the paper's numbers, its figures drawn."""
    module = _module_of(paper)
    if seeds < 1:
        raise InvalidArgument(f"--seeds {seeds}: expected at least 1")
    result = module.run(seed=seed, seeds=seeds, out=make_folder(out or Path("out/reproduce") / paper))
    if as_json:
        print(json.dumps(result))
    else:
        header, *rows = module.table(result)
        print_table(rows, header)


def _module_of(paper: str) -> ModuleType:
    """landfall.reproduce.<paper>, if it is an experiment. Raises UnknownName."""
    known = [
        info.name for info in pkgutil.iter_modules(landfall.reproduce.__path__) if _is_experiment(info.name)
    ]
    if paper not in known:
        raise UnknownName(f"reproduce: unknown paper '{paper}'; known: {', '.join(sorted(known))}")
    return importlib.import_module(f"landfall.reproduce.{paper}")


def _is_experiment(name: str) -> bool:
    """Modules that only help others begin with an underscore."""
    return not name.startswith("_")
