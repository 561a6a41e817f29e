"""landfall methods: the search methods, from the code."""

from __future__ import annotations

import json
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from landfall._landfall import active_executor, active_isa, methods


def run(
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> None:
    """The search methods, the instruction set that the kernels run with, and what schedules threads."""
    rows, isa, executor = methods(), active_isa(), active_executor()
    if as_json:
        found = [dict(zip(("name", "summary", "source"), row, strict=True)) for row in rows]
        print(json.dumps({"isa": isa, "executor": executor, "methods": found}))
        return
    table = Table()
    for column in ("method", "what it is", "source"):
        table.add_column(column)
    for row in rows:
        table.add_row(*row)
    console = Console()
    console.print(table)
    console.print(f"kernels: {isa}, threads: {executor}")
