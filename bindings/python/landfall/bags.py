"""ROS 1 and ROS 2 bags: sensor_msgs/LaserScan with nav_msgs/Odometry and tf, through PyPI's rosbags.

Frames are found along tf's chain from the laser upwards (REP-105): map -> odom -> robot -> laser. The robot's
frame is odometry's child; where a bag has neither tf nor odometry, robot and laser coincide.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from landfall._landfall import Beam, Log, Pose2, Scan, Sensor
from landfall.errors import FileFormat, FileNotFound
from landfall.transforms import StampedPoses, TransformTree

LASER = "sensor_msgs/msg/LaserScan"
ODOMETRY = "nav_msgs/msg/Odometry"
TF = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")


@dataclass
class BagContent:
    """What a bag holds, before frames are known."""

    lasers: list[tuple[str, Any]] = field(default_factory=list)  # (topic, message) in the bag's order
    transforms: TransformTree = field(default_factory=TransformTree)
    odometry: StampedPoses = field(default_factory=StampedPoses)
    odom_frame: str | None = None
    robot_frame: str | None = None


def load_bag(path: str | PathLike[str], sensors: Mapping[str, Sensor] | None = None) -> Log:
    """The laser scans of a ROS bag, in time order, with odometry; a localizer's tf is T_map_robot.

    path: a ROS 1 .bag; a ROS 2 folder with its metadata.yaml, or its .mcap or .db3 alone. sensors: replaces
    what the messages imply, by topic. Raises FileNotFound, FileFormat (a damaged bag; a bag without a laser
    topic, with the topics that it has).
    """
    bag = Path(path)
    if not bag.exists():
        raise FileNotFound(f"{bag}: no such file")
    content = _read(bag)
    builder = _ScanBuilder(content, dict(sensors or {}))
    scans = [builder.scan(topic, message) for topic, message in content.lasers]
    return Log(sorted(scans, key=lambda scan: scan.stamp_s))


def _read(bag: Path) -> BagContent:
    content = BagContent()
    undefined = get_typestore(Stores.ROS2_HUMBLE)  # before Iron, bags did not define their messages
    try:
        with AnyReader([bag], default_typestore=undefined) as reader:
            topics = sorted({(c.topic, c.msgtype) for c in reader.connections})
            if not any(kind == LASER for _, kind in topics):
                known = ", ".join(f"{topic} ({kind})" for topic, kind in topics) or "none"
                raise FileFormat(f"{bag}: no topic of type sensor_msgs/LaserScan; topics: {known}")
            wanted = [c for c in reader.connections if c.msgtype in (LASER, ODOMETRY, *TF)]
            for connection, _, raw in reader.messages(connections=wanted):
                _add(
                    content, connection.topic, connection.msgtype, reader.deserialize(raw, connection.msgtype)
                )
    except FileFormat:
        raise
    except Exception as cause:  # rosbags raises many kinds on damaged input, struct.error among them
        raise FileFormat(f"{bag}: truncated or damaged ROS bag: {_one_line(cause)}") from cause
    content.transforms.sort()
    content.odometry.sort()
    return content


def _one_line(cause: Exception) -> str:
    return " ".join(str(cause).split()) or type(cause).__name__


def _add(content: BagContent, topic: str, kind: str, message: Any) -> None:
    if kind == LASER:
        content.lasers.append((topic, message))
    elif kind == ODOMETRY:
        content.odom_frame = _frame(message.header.frame_id)
        content.robot_frame = _frame(message.child_frame_id) or None
        pose = message.pose.pose
        content.odometry.add(_stamp(message.header), _xyz(pose.position), _xyzw(pose.orientation))
    else:
        for transform in message.transforms:
            content.transforms.add(
                _frame(transform.header.frame_id),
                _frame(transform.child_frame_id),
                _stamp(transform.header),
                _xyz(transform.transform.translation),
                _xyzw(transform.transform.rotation),
            )


def _frame(name: str) -> str:
    return name.lstrip("/")


def _stamp(header: Any) -> float:
    return header.stamp.sec + 1e-9 * header.stamp.nanosec


def _xyz(v: Any) -> np.ndarray:
    return np.array([v.x, v.y, v.z])


def _xyzw(q: Any) -> np.ndarray:
    return np.array([q.x, q.y, q.z, q.w])


class _ScanBuilder:
    """Messages to scans: one Sensor per topic and geometry, poses from tf or odometry."""

    def __init__(self, content: BagContent, given: dict[str, Sensor]) -> None:
        self.content = content
        self.given = given
        self.made: dict[tuple, Sensor] = {}

    def scan(self, topic: str, message: Any) -> Scan:
        stamp_s = _stamp(message.header)
        frames = self._frames(_frame(message.header.frame_id))
        sensor = self.given.get(topic) or self._sensor(topic, message, frames.robot)
        T_odom_robot = self._odometry(frames, stamp_s)
        T_map_robot = None
        if frames.map is not None:
            T_map_robot = self.content.transforms.lookup(frames.map, frames.robot, stamp_s)
        ranges = np.array(message.ranges, dtype=np.float32)
        return Scan(sensor, ranges, stamp_s, T_odom_robot, T_map_robot)

    def _frames(self, laser: str) -> _Frames:
        chain = self.content.transforms.chain(laser)
        odom = next((f for f in chain if f == (self.content.odom_frame or "odom")), None)
        robot = self.content.robot_frame
        if robot not in chain:
            below_odom = chain[chain.index(odom) - 1] if odom in chain[1:] else None
            robot = below_odom or next((f for f in ("base_link", "base_footprint") if f in chain), laser)
        above = chain[chain.index(odom) + 1 :] if odom else chain[chain.index(robot) + 1 :]
        return _Frames(robot, odom, "map" if "map" in above else None)

    def _sensor(self, topic: str, message: Any, robot: str) -> Sensor:
        laser = _frame(message.header.frame_id)
        count = len(message.ranges)
        limits = (float(message.range_min), float(message.range_max))
        key = (topic, laser, count, float(message.angle_min), float(message.angle_increment), *limits)
        if key not in self.made:
            angles = key[3] + np.arange(count) * key[4]
            mount = self.content.transforms.mount(robot, laser)
            beams = [Beam(pose, 0.0, *limits) for pose in mount.beams(angles)]
            self.made[key] = Sensor(beams, topic)
        return self.made[key]

    def _odometry(self, frames: _Frames, stamp_s: float) -> Pose2 | None:
        if frames.odom is not None and frames.odom != frames.robot:
            return self.content.transforms.lookup(frames.odom, frames.robot, stamp_s)
        return self.content.odometry.at(stamp_s)


@dataclass(frozen=True)
class _Frames:
    robot: str
    odom: str | None
    map: str | None
