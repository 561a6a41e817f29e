"""Tables on stdout."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console
from rich.table import Table


def print_table(rows: Iterable[Iterable[str]], header: Iterable[str] = (), title: str | None = None) -> None:
    """First column left, the others right."""
    columns = list(header)
    table = Table(title=title, title_justify="left", show_header=bool(columns))
    lines = [list(row) for row in rows]
    width = len(columns) or max((len(line) for line in lines), default=0)
    for i in range(width):
        table.add_column(columns[i] if columns else "", justify="left" if i == 0 else "right")
    for line in lines:
        table.add_row(*line)
    Console().print(table)
