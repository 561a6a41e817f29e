"""A made-up building: what `landfall demo` relocalizes in; landfall/drives.py drives through it.

Two corridors run along the building and are joined at both ends; rooms of different widths, with doors,
furniture and pillars, lie on three rows beside and between them. Everything follows from the seed.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from landfall._landfall import WallMap

WIDTH_M = 42.0
CORRIDOR_M = 2.2
ROW_DEPTHS_M = (6.5, 7.5, 5.5)  # bottom, middle, top row of rooms
DOOR_M = 1.0
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
