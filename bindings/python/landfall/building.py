"""A made-up building and a drive through it: what `landfall demo` relocalizes.

Two corridors run along the building and are joined at both ends; rooms of different widths, with doors,
furniture and pillars, lie on three rows beside and between them. Everything follows from the seed.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from landfall._landfall import (
    Pose2,
    PreparedMap,
    Scan,
    Sensor,
    WallMap,
    make_fan,
    simulate,
    translation_distance,
    wrap_angle,
)

WIDTH_M = 42.0
CORRIDOR_M = 2.2
ROW_DEPTHS_M = (6.5, 7.5, 5.5)  # bottom, middle, top row of rooms
DOOR_M = 1.0
STEP_M = 0.5
HATCH_M = 0.04

Segment = tuple[float, float, float, float]


@dataclass
class Room:
    """An axis-aligned room; its door is a gap in the wall y = door_y_m."""

    x0_m: float
    y0_m: float
    x1_m: float
    y1_m: float
    door_x_m: float
    door_y_m: float

    @property
    def center(self) -> tuple[float, float]:
        return (self.x0_m + self.x1_m) / 2, (self.y0_m + self.y1_m) / 2


@dataclass
class Building:
    """Walls, and the corridors and rooms that a drive can visit."""

    walls: list[Segment] = field(default_factory=list)
    rooms: list[Room] = field(default_factory=list)
    corridors_y_m: tuple[float, float] = (0.0, 0.0)

    def wall_map(self) -> WallMap:
        return WallMap(self.walls)


def make_building(seed: int) -> Building:
    """Rooms, corridors and furniture in metres; the lower-left corner is the origin."""
    rng = np.random.default_rng(seed)
    bottom, middle, top = ROW_DEPTHS_M
    lower = bottom  # the lower corridor's lower wall
    upper = bottom + CORRIDOR_M + middle
    height = upper + CORRIDOR_M + top
    building = Building(corridors_y_m=(lower + CORRIDOR_M / 2, upper + CORRIDOR_M / 2))
    building.walls += _rectangle(0, 0, WIDTH_M, height)
    _add_row(building, rng, (0, WIDTH_M), (0, lower), lower)
    _add_row(building, rng, (CORRIDOR_M, WIDTH_M - CORRIDOR_M), (lower + CORRIDOR_M, upper), None)
    _add_row(building, rng, (0, WIDTH_M), (upper + CORRIDOR_M, height), upper + CORRIDOR_M)
    for room in building.rooms:
        building.walls += _furniture(rng, room)
    building.walls += _corridor_cupboards(rng, building)
    return building


def _rectangle(x0: float, y0: float, x1: float, y1: float) -> list[Segment]:
    return [(x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)]


def _block(x0: float, y0: float, x1: float, y1: float) -> list[Segment]:
    """A rectangle hatched so densely that no cell of a map inside it stays free."""
    lines = math.ceil(abs(y1 - y0) / HATCH_M)
    hatch = [y0 + (y1 - y0) * k / lines for k in range(1, lines)]
    return [*_rectangle(x0, y0, x1, y1), *((x0, y, x1, y) for y in hatch)]


def _add_row(
    building: Building,
    rng: np.random.Generator,
    span_x: tuple[float, float],
    span_y: tuple[float, float],
    door_y_m: float | None,
) -> None:
    """Rooms side by side. Without door_y_m the row lies between the corridors and each room picks a side."""
    cuts = _cuts(rng, *span_x)
    for x0, x1 in itertools.pairwise(cuts):
        side = door_y_m if door_y_m is not None else span_y[int(rng.integers(2))]
        room = Room(x0, span_y[0], x1, span_y[1], float(rng.uniform(x0 + 0.9, x1 - 0.9)), side)
        building.rooms.append(room)
        building.walls += _room_walls(room, span_x, closed=door_y_m is None)


def _cuts(rng: np.random.Generator, start: float, end: float) -> list[float]:
    """Wall positions from start to end, rooms 3 to 8 m wide."""
    cuts = [start]
    while end - cuts[-1] > 11.0:
        cuts.append(cuts[-1] + float(rng.uniform(3.0, 8.0)))
    rest = end - cuts[-1]
    if rest > 8.0:
        cuts.append(cuts[-1] + rest * float(rng.uniform(0.4, 0.6)))
    return [*cuts, end]


def _room_walls(room: Room, span_x: tuple[float, float], closed: bool) -> Iterator[Segment]:
    """The wall with the door, the one opposite where it is not the building's, and the left partition."""
    door = (room.door_x_m - DOOR_M / 2, room.door_x_m + DOOR_M / 2)
    yield (room.x0_m, room.door_y_m, door[0], room.door_y_m)
    yield (door[1], room.door_y_m, room.x1_m, room.door_y_m)
    if closed:
        opposite = room.y1_m if room.door_y_m == room.y0_m else room.y0_m
        yield (room.x0_m, opposite, room.x1_m, opposite)
    if closed or room.x0_m > span_x[0]:
        yield (room.x0_m, room.y0_m, room.x0_m, room.y1_m)
    if closed and room.x1_m == span_x[1]:
        yield (room.x1_m, room.y0_m, room.x1_m, room.y1_m)


def _furniture(rng: np.random.Generator, room: Room) -> Iterator[Segment]:
    """Desks along the wall opposite the door, a shelf on one side, and in wide rooms a pillar."""
    away = 1.0 if room.door_y_m == room.y0_m else -1.0
    far_y = room.y1_m if away > 0 else room.y0_m
    x = room.x0_m + float(rng.uniform(0.2, 0.8))
    while x + 1.0 < room.x1_m:
        width, depth = float(rng.uniform(0.7, 1.6)), float(rng.uniform(0.4, 0.8))
        if rng.random() < 0.7:
            yield from _block(x, far_y - away * 0.03, min(x + width, room.x1_m - 0.1), far_y - away * depth)
        x += width + float(rng.uniform(0.3, 1.2))
    if rng.random() < 0.6:
        side_x = room.x0_m + 0.03 if rng.random() < 0.5 else room.x1_m - 0.43
        start_y = far_y - away * float(rng.uniform(2.2, 3.2))
        yield from _block(side_x, start_y, side_x + 0.4, start_y + away * float(rng.uniform(0.6, 1.2)))
    if room.x1_m - room.x0_m > 6.0:
        cx, cy = room.center
        px, py = cx + float(rng.uniform(1.2, 1.6)), cy + away * 0.6
        yield from _block(px, py, px + 0.35, py + 0.35)


def _corridor_cupboards(rng: np.random.Generator, building: Building) -> Iterator[Segment]:
    """Along all four corridors, clear of the doors: no two stretches look quite alike."""
    lower_y, upper_y = building.corridors_y_m
    for y in (lower_y, upper_y):
        doors = [(room.door_x_m, room.door_y_m) for room in building.rooms]
        yield from _cupboards(rng, (CORRIDOR_M, WIDTH_M - CORRIDOR_M), y, doors)
    for x in (CORRIDOR_M / 2, WIDTH_M - CORRIDOR_M / 2):
        for x0, y0, x1, y1 in _cupboards(rng, (lower_y + CORRIDOR_M, upper_y - CORRIDOR_M), x, []):
            yield y0, x0, y1, x1


def _cupboards(
    rng: np.random.Generator, span: tuple[float, float], middle: float, doors: Sequence[tuple[float, float]]
) -> Iterator[Segment]:
    """On either side of a corridor along x whose middle is y = middle."""
    x = span[0] + float(rng.uniform(0.3, 2.0))
    while x < span[1] - 1.6:
        width, depth = float(rng.uniform(0.5, 1.6)), float(rng.uniform(0.25, 0.45))
        side = 1.0 if rng.random() < 0.5 else -1.0
        wall_y = middle + side * CORRIDOR_M / 2
        beside = [door_x for door_x, door_y in doors if abs(door_y - wall_y) < 0.1]
        if all(door_x + DOOR_M < x or x + width < door_x - DOOR_M for door_x in beside):
            yield from _block(x, wall_y, x + width, wall_y - side * depth)
        x += width + float(rng.uniform(0.8, 3.0))


def laser(range_noise_m: float = 0.01) -> Sensor:
    """A scanner of 270 degrees at 1 degree, 0.15 m ahead of the robot's centre."""
    return make_fan(
        beams=271,
        first_rad=-0.75 * math.pi,
        step_rad=math.radians(1.0),
        T_robot_sensor=Pose2(0.15, 0.0, 0.0),
        range_max_m=25.0,
        range_noise_m=range_noise_m,
    )


def drive(building: Building, seed: int) -> list[Pose2]:
    """T_map_robot every STEP_M along the two corridors, with a visit to every second room."""
    rng = np.random.default_rng((seed, 1))
    lower_y, upper_y = building.corridors_y_m
    end_x = CORRIDOR_M / 2
    corners = [(end_x, lower_y)]
    for corridor_y, rightwards in ((lower_y, True), (upper_y, False)):
        corners += _visits(building, rng, corridor_y, rightwards)
        last_x = WIDTH_M - end_x if rightwards else end_x
        corners += [(last_x, corridor_y)]
        corners += [(last_x, upper_y if rightwards else lower_y)]
    return list(_poses_along(corners, rng))


def _visits(
    building: Building, rng: np.random.Generator, corridor_y: float, rightwards: bool
) -> Iterator[tuple[float, float]]:
    """Out of the corridor, through a door, to the room's centre and back, in the order of driving."""
    beside = [r for r in building.rooms if abs(r.door_y_m - corridor_y) < CORRIDOR_M]
    for room in sorted(beside, key=lambda r: r.door_x_m if rightwards else -r.door_x_m):
        if rng.random() < 0.5:
            continue
        inside_y = room.door_y_m + math.copysign(1.0, room.door_y_m - corridor_y)
        at_door = [(room.door_x_m, corridor_y), (room.door_x_m, inside_y)]
        yield from (*at_door, room.center, *reversed(at_door))


def _poses_along(corners: Sequence[tuple[float, float]], rng: np.random.Generator) -> Iterator[Pose2]:
    """A pose every STEP_M on each leg, weaving a little."""
    for (x0, y0), (x1, y1) in itertools.pairwise(corners):
        length = math.hypot(x1 - x0, y1 - y0)
        heading = math.atan2(y1 - y0, x1 - x0)
        for k in range(int(length / STEP_M)):
            share = k * STEP_M / length
            dx, dy = rng.normal(0.0, 0.03, 2)
            theta = wrap_angle(heading + float(rng.normal(0.0, 0.08)))
            yield Pose2(x0 + share * (x1 - x0) + float(dx), y0 + share * (y1 - y0) + float(dy), theta)


def record(map: PreparedMap, T_map_robot: Sequence[Pose2], seed: int, people: float = 0.1) -> list[Scan]:
    """The drive as a log: noisy ranges, a share of the beams ended early by people, drifting odometry."""
    rng = np.random.default_rng((seed, 2))
    scans = simulate(map, laser(), T_map_robot, seed=seed)
    odometry = _odometry(T_map_robot, rng)
    for i, scan in enumerate(scans):
        scan.stamp_s = float(i)
        scan.T_odom_robot = odometry[i]
        _add_people(scan.ranges_m, people, rng)
    return scans


def _add_people(ranges_m: np.ndarray, share: float, rng: np.random.Generator) -> None:
    """Runs of neighbouring beams that end at a body, until `share` of the beams do."""
    hit = np.zeros(len(ranges_m), dtype=bool)
    while hit.mean() < share:
        distance_m = float(rng.uniform(0.6, 5.0))
        half = max(round(math.degrees(0.2 / distance_m)), 1)  # a body is 0.4 m wide; a beam per degree
        center = int(rng.integers(len(ranges_m)))
        body = slice(max(center - half, 0), center + half + 1)
        blocked = ranges_m[body] > distance_m
        ranges_m[body][blocked] = distance_m + rng.normal(0.0, 0.02, int(blocked.sum()))
        hit[body] = True


def _odometry(T_map_robot: Sequence[Pose2], rng: np.random.Generator) -> list[Pose2]:
    """Increments of the true poses with 3 % and 0.01 rad per metre of noise."""
    T_odom_robot = [Pose2()]
    for before, after in itertools.pairwise(T_map_robot):
        step = before.inverse() * after
        driven_m = translation_distance(before, after)
        scale = 1.0 + float(rng.normal(0.0, 0.03))
        turn = step.theta_rad + float(rng.normal(0.0, 0.01 * driven_m))
        T_odom_robot.append(T_odom_robot[-1] * Pose2(step.x_m * scale, step.y_m * scale, turn))
    return T_odom_robot
