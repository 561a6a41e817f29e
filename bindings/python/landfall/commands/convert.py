"""landfall convert: any log as scan lines."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import save_log
from landfall.commands.options import LogFile, SensorFile, read_log
from landfall.outputs import require_folder


def run(
    log: LogFile,
    out: Annotated[Path, typer.Option("--out", help="Scan lines, .jsonl.")],
    sensor: SensorFile = None,
) -> None:
    """Any log that landfall reads, as scan lines."""
    require_folder(out)
    content = read_log(log, sensor)
    save_log(content.scans, out)
    for warning in content.warnings:
        print(f"landfall: warning: {warning}", file=sys.stderr)
    print(f"{out}: {len(content.scans)} scans")
