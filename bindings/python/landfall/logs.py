"""Logs: text formats through the engine, ROS bags through landfall.bags, arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from landfall._landfall import Log, Pose2, Scan, Sensor, load_text_log
from landfall.errors import FileFormat, InvalidArgument

BAG_ENDINGS = (".bag", ".mcap", ".db3")


def load_log(path: str | PathLike[str], sensors: Mapping[str, Sensor] | None = None) -> Log:
    """The scans of a log: CARMEN text, scan lines, a sonar table (told by content), or a ROS bag.

    A bag is a ROS 1 .bag, a ROS 2 folder with its metadata.yaml, or a .mcap or .db3 alone.

    sensors: replaces what the log implies, by the log's own names (CARMEN: "front_laser", "rear_laser",
    "sonar"; scan lines: their `sensor`; bags: the laser's topic). Raises FileNotFound, FileFormat.
    """
    if looks_like_a_bag(Path(path)):
        from landfall.bags import load_bag  # its dependencies take a while to import

        return load_bag(path, sensors)
    try:
        return load_text_log(path, dict(sensors or {}))
    except FileFormat:
        if _starts_as_a_bag(Path(path)):
            raise FileFormat(f"{path}: a ROS 1 bag, expected its name to end in .bag") from None
        raise


def looks_like_a_bag(path: Path) -> bool:
    """By its ending; a folder by the metadata.yaml that ROS 2 leaves in it."""
    return path.suffix.lower() in BAG_ENDINGS or (path / "metadata.yaml").is_file()


def _starts_as_a_bag(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(8) == b"#ROSBAG "


def make_scans(
    sensor: Sensor,
    ranges_m: ArrayLike,
    stamp_s: ArrayLike | None = None,
    T_odom_robot: Sequence[Pose2] | None = None,
) -> list[Scan]:
    """Scans of one sensor from an array of shape (scans, beams), metres; NaN is invalid.

    stamp_s: (scans,), by default the scan's index. Raises InvalidArgument.
    """
    ranges = np.ascontiguousarray(ranges_m, dtype=np.float32)
    if ranges.ndim != 2 or ranges.shape[1] != len(sensor):
        raise InvalidArgument(
            f"make_scans: ranges_m of shape {ranges.shape}, expected (scans, {len(sensor)}): one per beam"
        )
    stamps = np.arange(len(ranges), dtype=float) if stamp_s is None else np.asarray(stamp_s, dtype=float)
    odometry = [None] * len(ranges) if T_odom_robot is None else list(T_odom_robot)
    if len(stamps) != len(ranges) or len(odometry) != len(ranges):
        raise InvalidArgument(
            f"make_scans: {len(ranges)} scans, {len(stamps)} stamps, {len(odometry)} odometry poses; "
            "expected as many of each"
        )
    return [
        Scan(sensor, row, float(stamp), pose)
        for row, stamp, pose in zip(ranges, stamps, odometry, strict=True)
    ]
