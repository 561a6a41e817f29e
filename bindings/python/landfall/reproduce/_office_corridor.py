"""Office corridors with doors, and a drive along one and by a right turn into a room.

The corridor lies along x; rooms on both sides have one door each, open or shut and set back a little. Walls
are thick, so that doorways have jambs. Everything follows from the generator.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field

import numpy as np

WALL_M = 0.12
DOOR_M = 1.0
STEP_M = 0.05  # from one scan to the next
TURN_RADIUS_M = 0.7
START_M = 1.0
INTO_ROOM_M = 2.5
SHARE_OPEN = 0.35

Segment = tuple[float, float, float, float]


@dataclass
class Room:
    """Beside the corridor from x0_m to x1_m; below it (side -1) or above (side 1)."""

    x0_m: float
    x1_m: float
    side: int
    depth_m: float
    door_x_m: float
    is_open: bool


@dataclass
class Corridor:
    """Walls, x1, y1, x2, y2 in metres; the corridor is 0 to length_m by 0 to width_m."""

    length_m: float
    width_m: float
    rooms: list[Room]
    target: Room  # that the drive turns into
    walls: list[Segment] = field(default_factory=list)


def make_corridor(rng: np.random.Generator) -> Corridor:
    length_m, width_m = float(rng.uniform(18.0, 26.0)), float(rng.uniform(1.8, 2.4))
    right = _rooms(rng, length_m, -1)
    target = right[-1]
    target.is_open = True
    corridor = Corridor(length_m, width_m, right + _rooms(rng, length_m, 1), target)
    corridor.walls = [(0.0, 0.0, 0.0, width_m), (length_m, 0.0, length_m, width_m)]
    for room in corridor.rooms:
        corridor.walls += _walls_of(rng, room, width_m)
    for _ in range(int(rng.integers(1, 4))):
        corridor.walls += _cupboard(rng, corridor)
    return corridor


def _rooms(rng: np.random.Generator, length_m: float, side: int) -> list[Room]:
    """Side by side, 3 to 5.5 m wide and equally deep."""
    cuts = [0.0]
    while length_m - cuts[-1] > 8.5:
        cuts.append(cuts[-1] + float(rng.uniform(3.0, 5.5)))
    if length_m - cuts[-1] > 5.5:
        cuts.append((cuts[-1] + length_m) / 2)
    depth_m = float(rng.uniform(3.5, 5.0))
    return [
        Room(
            x0,
            x1,
            side,
            depth_m,
            float(rng.uniform(x0 + 0.5 + DOOR_M / 2, x1 - 0.5 - DOOR_M / 2)),
            bool(rng.random() < SHARE_OPEN),
        )
        for x0, x1 in itertools.pairwise([*cuts, length_m])
    ]


def _walls_of(rng: np.random.Generator, room: Room, width_m: float) -> list[Segment]:
    """The wall to the corridor, both faces and jambs; the room's others; furniture in an open room."""
    near = 0.0 if room.side < 0 else width_m
    inner = near + room.side * WALL_M
    back = inner + room.side * room.depth_m
    left, right = room.door_x_m - DOOR_M / 2, room.door_x_m + DOOR_M / 2
    x0, x1 = room.x0_m, room.x1_m
    walls = [(x0, near, left, near), (right, near, x1, near)]
    if not room.is_open:
        shut = near + room.side * float(rng.uniform(0.03, 0.1))
        return [*walls, (left, near, left, shut), (left, shut, right, shut), (right, shut, right, near)]
    a, b = x0 + WALL_M / 2, x1 - WALL_M / 2
    walls += [(left, near, left, inner), (right, near, right, inner)]
    walls += [(a, inner, left, inner), (right, inner, b, inner)]
    walls += [(a, inner, a, back), (a, back, b, back), (b, back, b, inner)]
    return walls + _furniture(rng, room, a, b, back)


def _furniture(rng: np.random.Generator, room: Room, a: float, b: float, back: float) -> list[Segment]:
    """Desks and shelves against the wall opposite the door."""
    walls: list[Segment] = []
    x = a + float(rng.uniform(0.1, 0.8))
    while x + 0.8 < b:
        width, depth = float(rng.uniform(0.6, 1.6)), float(rng.uniform(0.4, 0.8))
        if rng.random() < 0.6:
            walls += _box(x, back, min(x + width, b), back - room.side * depth)
        x += width + float(rng.uniform(0.3, 1.0))
    return walls


def _cupboard(rng: np.random.Generator, corridor: Corridor) -> list[Segment]:
    """Against a wall of the corridor where no door is, or none."""
    side = -1 if rng.random() < 0.5 else 1
    x, width, depth = (float(rng.uniform(*span)) for span in ((2.0, 14.0), (0.6, 1.2), (0.2, 0.35)))
    wall_y = 0.0 if side < 0 else corridor.width_m
    doors = [room.door_x_m for room in corridor.rooms if room.side == side]
    if any(x - DOOR_M < door < x + width + DOOR_M for door in doors):
        return []
    return _box(x, wall_y, x + width, wall_y - side * depth)


def _box(x0: float, y0: float, x1: float, y1: float) -> list[Segment]:
    """Three sides; the first y is the wall's, where it stands."""
    return [(x0, y0, x0, y1), (x0, y1, x1, y1), (x1, y1, x1, y0)]


def drive(corridor: Corridor, rng: np.random.Generator) -> np.ndarray:
    """(poses, 3): x, y, heading every STEP_M along the corridor, swaying a little, then into the room."""
    amplitude_m, wave_m = float(rng.uniform(0.03, 0.12)), float(rng.uniform(5.0, 9.0))
    phase, middle_m = float(rng.uniform(0.0, 2 * math.pi)), corridor.width_m / 2
    turn_x = corridor.target.door_x_m - TURN_RADIUS_M
    x = np.arange(START_M, turn_x, STEP_M)
    fade = np.clip((turn_x - x) / 1.5, 0.0, 1.0)  # straight again before the turn
    y = middle_m + amplitude_m * fade * np.sin(2 * math.pi * x / wave_m + phase)
    along = np.column_stack([x, y, np.arctan2(np.gradient(y), np.gradient(x))])
    angle = np.arange(0.0, math.pi / 2, STEP_M / TURN_RADIUS_M)
    turn = np.column_stack(
        [
            turn_x + TURN_RADIUS_M * np.sin(angle),
            middle_m - TURN_RADIUS_M * (1.0 - np.cos(angle)),
            -angle,
        ]
    )
    down = np.arange(middle_m - TURN_RADIUS_M, -WALL_M - INTO_ROOM_M, -STEP_M)
    into = np.column_stack(
        [np.full(len(down), corridor.target.door_x_m), down, np.full(len(down), -math.pi / 2)]
    )
    return np.concatenate([along, turn, into])
