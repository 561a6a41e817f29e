"""ROS 2 bags, made here with rosbags' writer: the same content as a ROS 1 bag gives the same scans."""

from __future__ import annotations

import math
from pathlib import Path

import landfall
import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_HUMBLE)
T = STORE.types
TF, LASER = "tf2_msgs/msg/TFMessage", "sensor_msgs/msg/LaserScan"


def header(stamp_s: float, frame: str):
    nanoseconds = round(stamp_s * 1e9)
    stamp = T["builtin_interfaces/msg/Time"](sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)
    return T["std_msgs/msg/Header"](stamp=stamp, frame_id=frame)


def tf(stamp_s: float, parent: str, child: str, x: float, yaw: float):
    turned = T["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))
    moved = T["geometry_msgs/msg/Vector3"](x=x, y=0.0, z=0.2)
    stamped = T["geometry_msgs/msg/TransformStamped"](
        header=header(stamp_s, parent),
        child_frame_id=child,
        transform=T["geometry_msgs/msg/Transform"](translation=moved, rotation=turned),
    )
    return T[TF](transforms=[stamped])


def laser_scan(stamp_s: float):
    return T[LASER](
        header=header(stamp_s, "laser"),
        angle_min=-0.5,
        angle_max=0.5,
        angle_increment=0.5,
        time_increment=0.0,
        scan_time=0.1,
        range_min=0.1,
        range_max=10.0,
        ranges=np.array([1.0, 2.0, math.inf], dtype=np.float32),
        intensities=np.array([], dtype=np.float32),
    )


def write_bag(folder: Path, storage: StoragePlugin) -> Path:
    messages = [
        ("/tf_static", TF, 0.5, tf(0.5, "base_link", "laser", 0.2, 0.1)),
        ("/tf", TF, 1.0, tf(1.0, "odom", "base_link", 0.0, 0.0)),
        ("/tf", TF, 1.0, tf(1.0, "map", "odom", 10.0, math.pi / 2)),
        ("/scan", LASER, 1.25, laser_scan(1.25)),
        ("/tf", TF, 2.0, tf(2.0, "odom", "base_link", 4.0, 0.4)),
    ]
    with Writer(folder, version=8, storage_plugin=storage) as writer:
        connections = {}
        for topic, kind, stamp_s, message in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=STORE)
            writer.write(connections[topic], round(stamp_s * 1e9), STORE.serialize_cdr(message, kind))
    return folder


@pytest.mark.parametrize("storage", [StoragePlugin.SQLITE3, StoragePlugin.MCAP])
def test_ros2_bag(tmp_path, storage):
    (scan,) = landfall.load_log(write_bag(tmp_path / "drive", storage)).scans
    assert scan.stamp_s == 1.25 and scan.sensor.name == "/scan" and scan.count_echoes() == 2
    assert list(scan.T_odom_robot) == pytest.approx([1.0, 0.0, 0.1])
    assert list(scan.T_map_robot) == pytest.approx([10.0, 1.0, math.pi / 2 + 0.1])
    assert list(scan.sensor.beams[1].T_robot_beam) == pytest.approx([0.2, 0.0, 0.1])


def test_one_file_of_a_ros2_bag(tmp_path):
    (file,) = write_bag(tmp_path / "drive", StoragePlugin.MCAP).glob("*.mcap")
    assert len(landfall.load_log(file)) == 1


def test_folder_that_is_no_bag(tmp_path, landfall_command):
    landfall_command("convert", "--log", tmp_path, "--out", tmp_path / "o.jsonl").fails_with("directory")
    (tmp_path / "metadata.yaml").write_text("rosbag2_bagfile_information: 3\n")
    landfall_command("convert", "--log", tmp_path, "--out", tmp_path / "o.jsonl").fails_with(
        str(tmp_path), "damaged ROS bag"
    )


def test_ros1_bag_under_another_name(tmp_path, landfall_command):
    log = tmp_path / "drive.dat"
    log.write_bytes(b"#ROSBAG V2.0\nE\0\0\0")
    landfall_command("convert", "--log", log, "--out", tmp_path / "o.jsonl").fails_with("drive.dat", ".bag")
