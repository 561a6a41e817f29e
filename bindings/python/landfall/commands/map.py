"""landfall map: a log into a map."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import Pose2, Scan, load_trajectory, map_from_known_poses, save_grid_map
from landfall.commands._map_slam import SlamRequest, map_by_slam
from landfall.commands.options import LogFile, Seed, SensorFile, read_log, require_index_range
from landfall.commands.sonar_maps import SONAR_METHODS, SonarSettings
from landfall.errors import InvalidArgument, UnknownName
from landfall.outputs import require_distinct, require_writable

METHODS = ("known-poses", "slam", *SONAR_METHODS)
MAP_ENDINGS = (".yaml", ".yml")
POSE_TOLERANCE_S = 0.02
TBF_WINDOW_SCANS = 50
CELL_M, SLAM_CELL_M = 0.05, 0.02
SLAM = "Method slam"


def run(
    log: LogFile,
    out: Annotated[Path, typer.Option("--out", help="ROS map .yaml; the image goes beside it.")],
    method: Annotated[str, typer.Option("--method", help=", ".join(METHODS))] = "known-poses",
    poses: Annotated[
        Path | None, typer.Option("--poses", help="TUM trajectory of T_map_robot instead of the log's poses.")
    ] = None,
    odometry: Annotated[
        bool, typer.Option("--odometry", help="Take the log's odometry for poses, drift and all.")
    ] = False,
    resolution_m: Annotated[
        float | None, typer.Option("--resolution-m", help="Cell size; default 0.05, slam: 0.02.")
    ] = None,
    range_max_m: Annotated[
        float, typer.Option("--range-max-m", help="Longer echoes free their first metres only; 0: no limit.")
    ] = 0.0,
    from_index: Annotated[int, typer.Option("--from-index", min=0, help="First scan.")] = 0,
    to_index: Annotated[int | None, typer.Option("--to-index", min=0, help="One past the last scan.")] = None,
    bounding_box: Annotated[
        bool, typer.Option("--bounding-box", help="tbf: correct readings to the box of the facing sonars.")
    ] = False,
    connect_walls: Annotated[
        bool, typer.Option("--connect-walls", help="tbf: join segments that line up, drop what is on none.")
    ] = False,
    window_scans: Annotated[
        int, typer.Option("--window-scans", help="tbf: scans that a reading's partners are sought in.")
    ] = TBF_WINDOW_SCANS,
    sensor: SensorFile = None,
    matcher: Annotated[
        str, typer.Option("--matcher", help="slam: pso or branch_and_bound.", rich_help_panel=SLAM)
    ] = "pso",
    prediction: Annotated[
        str,
        typer.Option(
            "--prediction", help="slam: still, constant_velocity or odometry.", rich_help_panel=SLAM
        ),
    ] = "still",
    raw: Annotated[
        bool, typer.Option("--raw", help="slam: matches as published, not refined.", rich_help_panel=SLAM)
    ] = False,
    seed: Seed = 0,
    trajectory: Annotated[
        Path | None, typer.Option("--trajectory", help="slam: TUM file of the path.", rich_help_panel=SLAM)
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", help="slam: map and path; default beside --out.", rich_help_panel=SLAM),
    ] = None,
    animation: Annotated[
        Path | None,
        typer.Option("--animation", help="slam: GIF of the map as it grows.", rich_help_panel=SLAM),
    ] = None,
) -> None:
    """An occupancy grid from scans whose poses are known (corrected logs, a localizer's tf, --poses), or from
    scans alone (--method slam).

    known-poses and slam take lasers; tbf, sonar-grid and end-points take sonars.
    """
    if method not in METHODS:
        raise UnknownName(f"--method {method}: unknown; known: {', '.join(METHODS)}")
    _require_of_method(
        method,
        tbf={
            "--bounding-box": bounding_box,
            "--connect-walls": connect_walls,
            "--window-scans": window_scans != TBF_WINDOW_SCANS,
        },
        slam={
            "--matcher": matcher != "pso",
            "--prediction": prediction != "still",
            "--raw": raw,
            "--trajectory": trajectory is not None,
            "--picture": picture is not None,
            "--animation": animation is not None,
        },
    )
    if method == "slam" and (poses is not None or odometry):
        raise InvalidArgument("--poses and --odometry are of known poses, and method slam finds its own")
    _require_map_name(out)
    require_writable(out)
    require_distinct(
        {"--out": out, "--trajectory": trajectory, "--picture": picture, "--animation": animation},
        [log, poses, sensor],
    )
    scans = read_log(log, sensor).scans
    require_index_range(from_index, to_index, len(scans), log)
    scans = scans[from_index:to_index]
    if method == "slam":
        map_by_slam(
            log,
            scans,
            SlamRequest(
                out=out,
                matcher=matcher,
                prediction=prediction,
                resolution_m=SLAM_CELL_M if resolution_m is None else resolution_m,
                range_max_m=range_max_m,
                seed=seed,
                raw=raw,
                trajectory=trajectory,
                picture=picture,
                animation=animation,
            ),
        )
        return
    if poses is not None:
        set_poses(scans, load_trajectory(poses))
    elif odometry:
        for scan in scans:
            scan.T_map_robot = scan.T_odom_robot
    located = [scan for scan in scans if scan.T_map_robot is not None]
    if not located:
        raise InvalidArgument(
            f"{log}: none of {len(scans)} scans has a known pose: give --poses or --odometry"
        )
    cell_m = CELL_M if resolution_m is None else resolution_m
    if method in SONAR_METHODS:
        settings = SonarSettings(cell_m, window_scans, bounding_box, connect_walls)
        grid = SONAR_METHODS[method](located, settings)
    else:
        grid = map_from_known_poses(located, resolution_m=cell_m, range_max_m=range_max_m)
    save_grid_map(grid, out)
    print(f"{out}: {grid.width_cells} x {grid.height_cells} cells from {len(located)} of {len(scans)} scans")


def _require_of_method(method: str, **options: dict[str, bool]) -> None:
    """An option of another method is refused rather than passed over."""
    for owner, given in options.items():
        for option in (name for name, is_given in given.items() if is_given and method != owner):
            raise InvalidArgument(f"{option} is of --method {owner}, and the method is {method}")


def _require_map_name(out: Path) -> None:
    if out.suffix.lower() not in MAP_ENDINGS:
        raise InvalidArgument(f"--out {out}: a map ends in {' or '.join(MAP_ENDINGS)}, not '{out.suffix}'")


def set_poses(scans: Sequence[Scan], trajectory: Sequence[tuple[float, Pose2]]) -> None:
    """Gives each scan the pose with its time stamp, or none."""
    ordered = sorted(trajectory, key=lambda stamped: stamped[0])
    stamps = [stamp_s for stamp_s, _ in ordered]
    for scan in scans:
        at = bisect_left(stamps, scan.stamp_s - POSE_TOLERANCE_S)
        near = at < len(stamps) and stamps[at] <= scan.stamp_s + POSE_TOLERANCE_S
        scan.T_map_robot = ordered[at][1] if near else None
