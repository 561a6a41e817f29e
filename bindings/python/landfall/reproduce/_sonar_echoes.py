"""What sonars hear among smooth walls: specular reflection, crosstalk, noise, someone walking by.

A sonar returns the shortest of these paths, each with its nearest point in the cone:
- a wall that a ray of the cone meets at less than SPECULAR_RAD from its normal;
- a wall's end or corner in sight within EDGE_RANGE_M;
- a ray that a wall reflects away, as a mirror does, up to BOUNCES times, and that then meets a wall head on:
  it comes back the way it went, and the reading is too long; with probability SHARE_HEARD, as it is weak;
- a person in sight.
None of them: no echo. With probability SHARE_CROSSTALK another sonar's sound comes first, at any time before.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from landfall._landfall import Beam, PreparedMap, Scan, Sensor, simulate_ranges

HALF_ANGLE_RAD = math.radians(12.5)
RANGE_MIN_M, RANGE_MAX_M = 0.15, 5.0
NOISE_M, NOISE_RELATIVE = 0.01, 0.01
SPECULAR_RAD = math.radians(15.0)
EDGE_RANGE_M = 2.5
BOUNCES = 2
SHARE_HEARD = 0.5
SHARE_CROSSTALK = 0.02
RAYS = 11  # of a cone
PERSON_RADIUS_M = 0.2

# Pioneer 2DX: x, y in metres, direction in degrees. Eight before, eight behind.
PIONEER_2DX = tuple(
    (side * x, y, (direction if side > 0 else 180 - direction))
    for side in (1, -1)
    for x, y, direction in (
        (0.115, 0.130, 90),
        (0.155, 0.115, 50),
        (0.190, 0.080, 30),
        (0.210, 0.025, 10),
        (0.210, -0.025, -10),
        (0.190, -0.080, -30),
        (0.155, -0.115, -50),
        (0.115, -0.130, -90),
    )
)


def pioneer_2dx() -> Sensor:
    beams = [
        Beam((x, y, math.radians(direction)), HALF_ANGLE_RAD, RANGE_MIN_M, RANGE_MAX_M)
        for x, y, direction in PIONEER_2DX
    ]
    return Sensor(beams, "pioneer2dx", range_noise_m=NOISE_M, range_noise_relative=NOISE_RELATIVE)


def read_sonars(
    map: PreparedMap, T_map_robot: np.ndarray, rng: np.random.Generator, person: np.ndarray | None = None
) -> list[Scan]:
    """A scan per pose (poses, 3), T_map_robot set. person: (poses, 2), where someone is meanwhile."""
    sensor = pioneer_2dx()
    mounts = _mounts(T_map_robot, sensor)
    rays = np.repeat(mounts, RAYS, axis=0)
    rays[:, 2] += np.tile(np.linspace(-HALF_ANGLE_RAD, HALF_ANGLE_RAD, RAYS), len(mounts))
    direct, mirrored = _ray_echoes(map, rays)
    ranges = direct.reshape(-1, RAYS).min(axis=1)
    ranges = np.minimum(ranges, _edge_echoes(map, mounts))
    late = mirrored.reshape(-1, RAYS).min(axis=1)
    ranges = np.where(rng.random(len(ranges)) < SHARE_HEARD, np.minimum(ranges, late), ranges)
    if person is not None:
        ranges = np.minimum(ranges, _person_echoes(map, mounts, np.repeat(person, len(sensor), axis=0)))
    early = rng.random(len(ranges)) < SHARE_CROSSTALK
    ranges[early] = rng.uniform(RANGE_MIN_M, np.minimum(ranges[early], RANGE_MAX_M))
    heard = np.isfinite(ranges)
    ranges[heard] += (NOISE_M + NOISE_RELATIVE * ranges[heard]) * rng.normal(size=int(heard.sum()))
    ranges = np.minimum(ranges, RANGE_MAX_M).astype(np.float32).reshape(len(T_map_robot), -1)
    return [
        Scan(sensor, row, float(i), None, tuple(pose))
        for i, (row, pose) in enumerate(zip(ranges, T_map_robot.tolist(), strict=True))
    ]


def _mounts(T_map_robot: np.ndarray, sensor: Sensor) -> np.ndarray:
    """(poses x beams, 3): where each sonar is and looks, pose by pose."""
    beams = np.array([list(beam.T_robot_beam) for beam in sensor.beams])
    x, y, theta = (column[:, None] for column in T_map_robot.T)
    cos, sin = np.cos(theta), np.sin(theta)
    placed = (x + cos * beams[:, 0] - sin * beams[:, 1], y + sin * beams[:, 0] + cos * beams[:, 1])
    return np.stack([*placed, theta + beams[:, 2]], axis=-1).reshape(-1, 3)


def _ray_echoes(map: PreparedMap, rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Per ray the range of a wall met head on, and that after reflections; inf: none."""
    direct, mirrored = np.full(len(rays), np.inf), np.full(len(rays), np.inf)
    travelled, going, at = np.zeros(len(rays)), np.arange(len(rays)), rays.copy()
    for bounce in range(BOUNCES + 1):
        length, normal_rad = _meet(map, at)
        total = travelled[going] + length
        incidence = np.abs(_wrap(at[:, 2] + math.pi - normal_rad))
        back = incidence < SPECULAR_RAD
        (direct if bounce == 0 else mirrored)[going[back]] = total[back]
        on = ~back & (total < RANGE_MAX_M) & np.isfinite(normal_rad)
        travelled[going] = total
        going, at = going[on], _reflected(at[on], length[on], normal_rad[on])
    return direct, mirrored


def _meet(map: PreparedMap, rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How far a wall is, and where its normal (towards the ray's origin) points; nan where it has none."""
    aside_rad = 1e-3
    aside = rays + np.array([0.0, 0.0, aside_rad])
    length, beside = _cast(map, rays), _cast(map, aside)
    with np.errstate(invalid="ignore"):
        dx = beside * np.cos(aside[:, 2]) - length * np.cos(rays[:, 2])
        dy = beside * np.sin(aside[:, 2]) - length * np.sin(rays[:, 2])
        normal_rad = np.arctan2(dy, dx) + math.pi / 2
        apart = np.hypot(dx, dy) > 30.0 * aside_rad * length  # two walls, or one grazed
    return length, np.where(apart, np.nan, normal_rad)


def _cast(map: PreparedMap, rays: np.ndarray) -> np.ndarray:
    ray = Sensor([Beam((0.0, 0.0, 0.0), 0.0, 0.0, RANGE_MAX_M)], "ray")
    return simulate_ranges(map, ray, rays)[:, 0].astype(float)


def _reflected(rays: np.ndarray, length: np.ndarray, normal_rad: np.ndarray) -> np.ndarray:
    """From where they met the wall, a millimetre before it."""
    off = 1e-3
    x = rays[:, 0] + length * np.cos(rays[:, 2]) + off * np.cos(normal_rad)
    y = rays[:, 1] + length * np.sin(rays[:, 2]) + off * np.sin(normal_rad)
    return np.column_stack([x, y, 2.0 * normal_rad + math.pi - rays[:, 2]])


def _edge_echoes(map: PreparedMap, mounts: np.ndarray) -> np.ndarray:
    """Of the walls' ends and corners."""
    ranges = np.full(len(mounts), np.inf)
    for edge in _edges(np.asarray(map.walls.walls)):
        ranges = np.minimum(ranges, _point_echoes(map, mounts, edge, 0.0, EDGE_RANGE_M, 0.0))
    return ranges


def _edges(walls: np.ndarray) -> np.ndarray:
    """(edges, 2): where walls end or meet, but for where one goes straight on."""
    directions: dict[tuple[float, float], list[float]] = {}
    for x1, y1, x2, y2 in walls.round(6).tolist():
        direction_rad = math.atan2(y2 - y1, x2 - x1) % math.pi
        for end in ((x1, y1), (x2, y2)):
            directions.setdefault(end, []).append(direction_rad)
    return np.array([end for end, met in directions.items() if len(met) == 1 or np.ptp(np.sin(met)) > 1e-6])


def _person_echoes(map: PreparedMap, mounts: np.ndarray, person: np.ndarray) -> np.ndarray:
    return _point_echoes(map, mounts, person, PERSON_RADIUS_M, RANGE_MAX_M, 0.5)


def _point_echoes(
    map: PreparedMap,
    mounts: np.ndarray,
    target: np.ndarray,
    radius_m: float,
    most_m: float,
    share_seen: float,
) -> np.ndarray:
    """Range to a round target in sight, inf elsewhere.

    share_seen: of its half-width that may be off the cone.
    """
    x, y = target.T[0] - mounts[:, 0], target.T[1] - mounts[:, 1]
    distance = np.hypot(x, y)
    bearing_rad = np.arctan2(y, x)
    wide_rad = share_seen * np.arcsin(np.clip(radius_m / np.maximum(distance, 1e-9), 0.0, 1.0))
    off = np.abs(_wrap(bearing_rad - mounts[:, 2]))
    near = np.flatnonzero((off < HALF_ANGLE_RAD + wide_rad) & (distance - radius_m < most_m))
    ranges = np.full(len(mounts), np.inf)
    sight = _cast(map, np.column_stack([mounts[near, :2], bearing_rad[near]]))
    seen = near[sight > distance[near] - 0.02]
    ranges[seen] = np.maximum(distance[seen] - radius_m, RANGE_MIN_M)
    return ranges


def _wrap(angle_rad: np.ndarray) -> np.ndarray:
    return (angle_rad + math.pi) % (2.0 * math.pi) - math.pi


def walk_by(T_map_robot: np.ndarray, from_m: Sequence[float], step_m: Sequence[float]) -> np.ndarray:
    """(poses, 2): someone who starts at from_m and moves step_m a scan, whatever is in the way."""
    scans = np.arange(len(T_map_robot))[:, None]
    return np.asarray(from_m) + scans * np.asarray(step_m)
