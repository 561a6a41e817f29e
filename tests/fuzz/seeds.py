"""A small valid input for each fuzzer, to start from; drawn here, so that no data of others is shipped."""

import gzip
import json
import struct
import zlib
from pathlib import Path

MAP_YAML = b"""image: a.pgm
resolution: 0.05
origin: [-1, 2.5, 0.1]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""
LASER_CONFIG = "0 -1.570796 3.141593 1.570796 30.0 0.01 0"
CARMEN = f"""# CARMEN Logfile
PARAM robot_front_laser_max 50.0 host 0
PARAM laser_front_laser_resolution 1.0 host 0
PARAM robot_frontlaser_offset 0.25 host 0
PARAM robot_rearlaser_offset -0.25 host 0
PARAM robot_sonar_offsets 0.1 0 0.7 0.1 0 -0.7 1.0 host 0
ODOM 1 2 0.5 0 0 0 7.1 host 7.1
FLASER 3 1.5 2 81.91 1 2 0.5 1 2 0.5 7.2 host 7.2
RLASER 2 1.5 2 1 2 0.5 1 2 0.5 7.2 host 7.2
ROBOTLASER1 {LASER_CONFIG} 3 1 2 3 1 0.5 1 2 0.5 1 2 0.5 0.1 0 0.5 0.4 1e6 7.3 host 7.3
RAWLASER1 {LASER_CONFIG} 3 1 2 3 0 7.4 host 7.4
SONAR 0.5 2 1.25 4.0 0.1 0.2 1.5 -0.1 0.2 -1.5 7.5 host 7.5
SONAR 2 1.25 4.0 7.6 host 7.6
"""
FAN = {"beams": 3, "first_rad": -1.0, "step_rad": 1.0, "T_robot_sensor": [0.1, 0, 0], "range_max_m": 30.0}
BEAM = {"T_robot_beam": [0, 0.1, 1.5], "half_angle_rad": 0.1, "range_min_m": 0.2, "range_max_m": 5.0}
SCAN_LINES = "\n".join(
    json.dumps(line)
    for line in (
        {"sensor": {"name": "laser", "range_noise_m": 0.02, "fan": FAN}},
        {"sensor": {"name": "sonar", "range_noise_relative": 0.01, "beams": [BEAM, BEAM]}},
        {"stamp_s": 1.5, "sensor": "laser", "ranges_m": [1.5, None, 30], "T_odom_robot": [1, 2, 3]},
        {"stamp_s": 2.5, "sensor": "sonar", "ranges_m": [0.5, 5.0], "T_map_robot": [1, 2, 3]},
    )
)
PRIORS = (
    "anywhere",
    {"window": {"T_map_robot": [1, 2, 3], "half_x_m": 4, "half_y_m": 1, "half_theta_rad": 0.5}},
    {"gaussian": {"T_map_robot": [1, 2, 3], "covariance": [1, 0, 0, 0, 2, 0, 0, 0, 3]}},
    {"region": {"polygon_map": [[0, 0], [4, 0], [0, 3]], "theta_rad": 1, "half_theta_rad": 1}},
    {"beacons": [{"p_map": [1, 2], "radius_m": 3}]},
    {"mixture": [{"weight": 0.5, "prior": "anywhere"}, {"weight": 2, "prior": {"poses": [[1, 2, 3]]}}]},
)
CORRIDOR8 = b"2000 5110 1 2 3 4 5 6 1190\n2500 1 2 3 4 5 6 7 8\n"
SCITOS24 = b",".join([b"0.438"] * 24) + b",Move-Forward\n"


def png(color_type, bit_depth, row, rows=2, interlace=0, palette=b""):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", 2, rows, bit_depth, color_type, 0, 0, interlace)
    image = zlib.compress((b"\0" + row) * rows)
    plte = chunk(b"PLTE", palette) if palette else b""
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + plte + chunk(b"IDAT", image) + chunk(b"IEND", b"")


def images():
    return [
        b"P2\n# grey\n2 2\n255\n0 254\n205 0\n",
        b"P3 1 1 255\n0 128 255\n",
        b"P5 2 2 255\n\x00\xfe\xcd\x00",
        b"P5 1 2 65535\n\x00\x00\xff\xff",
        b"P6 1 1 255\n\x00\x80\xff",
        png(0, 8, b"\x00\xfe"),
        png(0, 1, b"\x40"),
        png(0, 16, b"\x00\x00\xff\xff"),
        png(2, 8, b"\x00\x01\x02\xfd\xfe\xff"),
        png(3, 8, b"\x00\x01", palette=b"\x00\x00\x00\xff\xff\xff"),
        png(4, 8, b"\x00\xff\xfe\xff"),
        png(6, 8, b"\x00\x01\x02\xff\xfd\xfe\xff\xff"),
    ]


def seeds():
    """Inputs by the fuzzer's name."""
    sensor = json.dumps({"name": "laser", "range_noise_m": 0.02, "fan": FAN})
    return {
        "carmen": [CARMEN.encode()],
        "grid_map": [MAP_YAML + mode + b"\0" + image for mode in (b"", b"mode: raw\n") for image in images()],
        "image": images(),
        "log": [CARMEN.encode(), gzip.compress(CARMEN.encode()), SCAN_LINES.encode(), CORRIDOR8, SCITOS24],
        "places": [
            b"kitchen: {polygon_map: [[0, 0], [4, 0], [4, 3]], theta_rad: 1, half_theta_rad: 0.5}\n",
            b"entry:\n  T_map_robot: [1, 2, 1.5]\n  half_x_m: 0.8\n  half_y_m: 0.8\n  half_theta_rad: 1\n",
        ],
        "prior": [json.dumps(prior).encode() for prior in PRIORS],
        "scan_lines": [SCAN_LINES.encode()],
        "sensor": [
            sensor.encode(),
            b"sensors:\n  - {name: a, beams: [" + json.dumps(BEAM).encode() + b"]}\n",
            SCAN_LINES.encode(),
        ],
        "sonar_tables": [CORRIDOR8 + b"\x002000 1500 -250 900\n2500 0 0 -1800\n", SCITOS24],
        "trajectory": [b"# t tx ty tz qx qy qz qw\n1.5 1 2 0 0 0 0.70710678 0.70710678\n2 0 0 0 0 0 1 0\n"],
        "wall_plan": [b'{"units": "cm", "walls": [[1, 2, 3, -4], [0.5, 1e3, 2, 2]]}'],
    }


def write(folder, inputs):
    folder.mkdir(parents=True, exist_ok=True)
    for index, data in enumerate(inputs):
        Path(folder / f"seed-{index}").write_bytes(data)
