"""ROS 1 bags, made here with rosbags' writer, and the real one."""

from __future__ import annotations

import math
from pathlib import Path

import landfall
import numpy as np
import pytest
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

STORE = get_typestore(Stores.ROS1_NOETIC)
STORE.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
T = STORE.types


def header(stamp_s: float, frame: str):
    nanoseconds = round(stamp_s * 1e9)
    stamp = T["builtin_interfaces/msg/Time"](sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)
    return T["std_msgs/msg/Header"](seq=0, stamp=stamp, frame_id=frame)


def yaw(theta: float):
    return T["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=math.sin(theta / 2), w=math.cos(theta / 2))


UPSIDE_DOWN = T["geometry_msgs/msg/Quaternion"](x=1.0, y=0.0, z=0.0, w=0.0)  # half a turn about x


def transform(stamp_s: float, parent: str, child: str, x: float, y: float, rotation):
    vector = T["geometry_msgs/msg/Vector3"](x=x, y=y, z=0.3)
    return T["geometry_msgs/msg/TransformStamped"](
        header=header(stamp_s, parent),
        child_frame_id=child,
        transform=T["geometry_msgs/msg/Transform"](translation=vector, rotation=rotation),
    )


def laser_scan(stamp_s: float, ranges: list[float]):
    return T["sensor_msgs/msg/LaserScan"](
        header=header(stamp_s, "laser"),
        angle_min=-0.5,
        angle_max=0.5,
        angle_increment=0.5,
        time_increment=0.0,
        scan_time=0.1,
        range_min=0.1,
        range_max=10.0,
        ranges=np.array(ranges, dtype=np.float32),
        intensities=np.array([], dtype=np.float32),
    )


def write_bag(path: Path, messages: list[tuple[str, str, float, object]]) -> Path:
    """messages: (topic, type, stamp_s, message)."""
    with Writer(path) as writer:
        connections = {}
        for topic, kind, stamp_s, message in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=STORE)
            writer.write(connections[topic], round(stamp_s * 1e9), STORE.serialize_ros1(message, kind))
    return path


def tf(stamp_s: float, *transforms) -> tuple[str, str, float, object]:
    return (
        "/tf",
        "tf2_msgs/msg/TFMessage",
        stamp_s,
        T["tf2_msgs/msg/TFMessage"](transforms=list(transforms)),
    )


def scan_message(stamp_s: float) -> tuple[str, str, float, object]:
    return ("/scan", "sensor_msgs/msg/LaserScan", stamp_s, laser_scan(stamp_s, [1.0, 2.0, math.inf]))


def test_poses_are_interpolated_along_the_chain(tmp_path):
    bag = write_bag(
        tmp_path / "drive.bag",
        [
            tf(0.5, transform(0.5, "base_link", "laser", 0.2, 0.0, yaw(0.1))),
            tf(1.0, transform(1.0, "odom", "base_link", 0.0, 0.0, yaw(0.0))),
            tf(1.0, transform(1.0, "map", "odom", 10.0, 20.0, yaw(math.pi / 2))),
            scan_message(1.25),
            tf(2.0, transform(2.0, "odom", "base_link", 4.0, 0.0, yaw(0.4))),
        ],
    )
    (scan,) = landfall.load_log(bag).scans
    assert scan.stamp_s == 1.25
    assert list(scan.T_odom_robot) == pytest.approx([1.0, 0.0, 0.1])
    assert list(scan.T_map_robot) == pytest.approx([10.0, 21.0, math.pi / 2 + 0.1])
    assert list(scan.sensor.beams[1].T_robot_beam) == pytest.approx([0.2, 0.0, 0.1])
    assert scan.sensor.beams[0].range_max_m == 10.0 and scan.count_echoes() == 2


def test_laser_upside_down_sweeps_the_other_way(tmp_path):
    mount = transform(1.0, "base_link", "laser", 0.0, 0.0, UPSIDE_DOWN)
    (scan,) = landfall.load_log(write_bag(tmp_path / "a.bag", [tf(1.0, mount), scan_message(1.0)])).scans
    headings = [beam.T_robot_beam.theta_rad for beam in scan.sensor.beams]
    assert headings == pytest.approx([0.5, 0.0, -0.5], abs=1e-6)


def test_bare_laser_coincides_with_the_robot(tmp_path):
    (scan,) = landfall.load_log(write_bag(tmp_path / "a.bag", [scan_message(1.0)])).scans
    assert scan.T_odom_robot is None and scan.T_map_robot is None
    assert list(scan.sensor.beams[1].T_robot_beam) == pytest.approx([0, 0, 0])


def test_bag_without_laser_names_its_topics(tmp_path, landfall_command):
    link = transform(1.0, "odom", "base_link", 0.0, 0.0, yaw(0.0))
    bag = write_bag(tmp_path / "nolaser.bag", [tf(1.0, link)])
    landfall_command("convert", "--log", bag, "--out", tmp_path / "o.jsonl").fails_with(
        "nolaser.bag", "LaserScan", "/tf"
    )


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.9])
def test_truncated_bag(tmp_path, landfall_command, share):
    bag = write_bag(tmp_path / "cut.bag", [scan_message(0.1 * k) for k in range(1, 50)])
    content = bag.read_bytes()
    bag.write_bytes(content[: int(share * len(content))])
    landfall_command("convert", "--log", bag, "--out", tmp_path / "o.jsonl").fails_with("cut.bag")


def test_missing_bag():
    with pytest.raises(FileNotFoundError, match=r"none\.bag"):
        landfall.load_log("none.bag")


def test_real_bag(data):
    log = landfall.load_log(data / "rosbag" / "trace1.bag")
    assert len(log) == 906 and len(log.scans[0]) == 726
    assert all(scan.T_odom_robot is not None and scan.T_map_robot is not None for scan in log.scans)
    assert list(log.scans[0].sensor.beams[0].T_robot_beam) == pytest.approx([0.135, 0.0, -2.356194], abs=1e-5)


def test_second_half_on_a_map_of_the_first(data):
    """Where the places overlap (the robot turns back half way): against its localizer (10 to 20 cm)."""
    scans = landfall.load_log(data / "rosbag" / "trace1.bag").scans
    floor = landfall.PreparedMap(landfall.map_from_known_poses(scans[:453]))
    back = scans[453:663:15]
    results = landfall.search(floor, None, back)
    errors_m = [
        landfall.translation_distance(result.hypotheses[0].T_map_robot, scan.T_map_robot)
        for result, scan in zip(results, back, strict=True)
    ]
    assert np.mean(np.array(errors_m) < 0.3) >= 0.8
