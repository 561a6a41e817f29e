"""People who wander about a room: two legs each, as a scanner at knee height sees them."""

from __future__ import annotations

import math

import numpy as np

from landfall.pictures import in_map
from landfall.reproduce._wheelchair_room import MIDDLE_M, Room, distance_to_path

PEOPLE = 3
SPEED_M_S = 0.8
MOST_STANDING = 20  # scans in one place
LEG_RADIUS_M, HALF_STANCE_M, STRIDE_M = 0.06, 0.12, 0.25
# The part of the room where they walk, before it is mirrored: x0, x1, y0, y1.
FLOOR_M = (2.7, 6.3, 0.4, 3.9)
CLEARANCE_M = 0.35  # to furniture
FROM_ROBOT_M = 0.7

Disc = tuple[float, float, float]


def wandering_people(room: Room, rng: np.random.Generator, period_s: float, scans: int) -> list[list[Disc]]:
    """Their legs at every scan: (x, y, radius), in the frame of the robot's first pose."""
    mirrored = room.T_room_start.y_m < 0.0
    legs: list[list[Disc]] = [[] for _ in range(scans)]
    for _ in range(PEOPLE):
        for i, (point, heading) in enumerate(_walk(room, rng, mirrored, period_s, scans)):
            across = HALF_STANCE_M * np.array([-math.sin(heading), math.cos(heading)])
            swing = STRIDE_M * math.sin(2.0 * math.pi * SPEED_M_S * i * period_s / 1.4)
            along = swing * np.array([math.cos(heading), math.sin(heading)])
            feet = in_map(
                room.T_room_start.inverse(), np.array([point + across + along, point - across - along])
            )
            legs[i] += [(float(x), float(y), LEG_RADIUS_M) for x, y in feet]
    return legs


def _walk(
    room: Room, rng: np.random.Generator, mirrored: bool, period_s: float, scans: int
) -> list[tuple[np.ndarray, float]]:
    """Straight from place to place, standing still for a moment now and then."""
    here = _place(room, rng, mirrored, None)
    steps: list[tuple[np.ndarray, float]] = []
    while len(steps) < scans:
        there = _place(room, rng, mirrored, here)
        heading = math.atan2(there[1] - here[1], there[0] - here[0])
        count = max(1, round(float(np.hypot(*(there - here))) / (SPEED_M_S * period_s)))
        steps += [(here + (there - here) * k / count, heading) for k in range(count)]
        steps += [(there, heading)] * int(rng.integers(0, MOST_STANDING))
        here = there
    return steps[:scans]


def _place(room: Room, rng: np.random.Generator, mirrored: bool, start: np.ndarray | None) -> np.ndarray:
    """Where the way from the start leads past furniture and the robot; anywhere after many tries."""
    sign = np.array([1.0, -1.0 if mirrored else 1.0])
    place = np.array([FLOOR_M[1], FLOOR_M[2]]) * sign
    for _ in range(200):
        place = rng.uniform((FLOOR_M[0], FLOOR_M[2]), (FLOOR_M[1], FLOOR_M[3])) * sign
        way = np.array([place if start is None else start, place + 1e-6])
        past_boxes = all(distance_to_path(box.mean(axis=0), way) > CLEARANCE_M + 0.2 for box in room.boxes)
        if past_boxes and distance_to_path(np.array(MIDDLE_M) * sign, way) > FROM_ROBOT_M:
            return place
    return place
