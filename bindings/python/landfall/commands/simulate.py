"""landfall simulate: scans by ray casting."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import load_map, load_trajectory, save_log, simulate
from landfall.commands.options import OneMap, Seed, one_sensor
from landfall.errors import InvalidArgument
from landfall.outputs import require_distinct, require_writable


def run(
    map: OneMap,
    sensor: Annotated[Path, typer.Option("--sensor", help="Sensor .yaml.")],
    poses: Annotated[Path, typer.Option("--poses", help="TUM trajectory of T_map_robot.")],
    out: Annotated[Path, typer.Option("--out", help="Scan lines, .jsonl.")],
    sensor_name: Annotated[
        str | None, typer.Option("--sensor-name", help="Which, where the file has several.")
    ] = None,
    seed: Seed = 0,
    no_noise: Annotated[bool, typer.Option("--no-noise", help="Exact ranges.")] = False,
) -> None:
    """What a sensor would see from given poses, with the sensor's noise."""
    require_writable(out)
    require_distinct({"--out": out}, [map, sensor, poses])
    trajectory = load_trajectory(poses)
    if not trajectory:
        raise InvalidArgument(f"{poses}: no poses to simulate from")
    T_map_robot = [pose for _, pose in trajectory]
    scans = simulate(
        load_map(map), one_sensor(sensor, sensor_name), T_map_robot, noise=not no_noise, seed=seed
    )
    for scan, (stamp_s, _) in zip(scans, trajectory, strict=True):
        scan.stamp_s = stamp_s
    save_log(scans, out)
    print(f"{out}: {len(scans)} scans")
