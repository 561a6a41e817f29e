"""landfall convert: any log as scan lines."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import save_log
from landfall.commands.options import LogFile, SensorFile, read_log, require_index_range
from landfall.outputs import require_distinct, require_writable, write_trajectory


def run(
    log: LogFile,
    out: Annotated[Path, typer.Option("--out", help="Scan lines, .jsonl.")],
    poses: Annotated[
        Path | None, typer.Option("--poses", help="Write the log's own T_map_robot here, as TUM.")
    ] = None,
    from_index: Annotated[int, typer.Option("--from-index", min=0, help="First scan.")] = 0,
    to_index: Annotated[int | None, typer.Option("--to-index", min=0, help="One past the last scan.")] = None,
    sensor: SensorFile = None,
) -> None:
    """Any log that landfall reads, as scan lines."""
    for path in (out, poses):
        if path is not None:
            require_writable(path)
    require_distinct({"--out": out, "--poses": poses}, [log, sensor])
    content = read_log(log, sensor)
    require_index_range(from_index, to_index, len(content.scans), log)
    scans = content.scans[from_index:to_index]
    save_log(scans, out)
    if poses is not None:
        recorded = [(scan.stamp_s, scan.T_map_robot) for scan in scans if scan.T_map_robot is not None]
        write_trajectory(recorded, poses)
    for warning in content.warnings:
        print(f"landfall: warning: {warning}", file=sys.stderr)
    print(f"{out}: {len(scans)} scans")
