"""landfall: given a map and what a robot's range sensors saw, where was the robot?

    >>> import landfall
    >>> map = landfall.load_map("floor.yaml")
    >>> log = landfall.load_log("drive.log.gz")
    >>> results = landfall.search(map, None, log.scans)
    >>> results[0].verdict, results[0].hypotheses[0].T_map_robot

Frames as in REP-103: metres, radians, x forward, y left, counter-clockwise positive; T_a_b takes points
of frame b into frame a. Errors are landfall.Error and also the built-in exception one would expect.
"""

from importlib.metadata import PackageNotFoundError, version

from landfall._landfall import (
    Anywhere,
    Beacons,
    Beam,
    CandidatePoses,
    Gaussian,
    GridMap,
    Hypothesis,
    Log,
    Mixture,
    OdometryNoise,
    Pose2,
    PosePrior,
    PreparedMap,
    Region,
    Scan,
    SearchCounts,
    SearchOptions,
    SearchResult,
    Sensor,
    StageTimes,
    WallMap,
    Window,
    active_isa,
    align,
    angle_distance,
    consistent,
    follow,
    load_grid_map,
    load_map,
    load_prior,
    load_sensors,
    load_trajectory,
    load_wall_map,
    make_fan,
    map_from_known_poses,
    merge,
    methods,
    save_grid_map,
    save_log,
    save_sensor,
    save_trajectory,
    save_wall_map,
    simulate,
    simulate_ranges,
    translation_distance,
    wrap_angle,
)
from landfall.errors import (
    Error,
    FileFormat,
    FileNotFound,
    FileWrite,
    InvalidArgument,
    TooLarge,
    UnknownName,
    UnknownOption,
)
from landfall.logs import load_log, make_scans
from landfall.searching import search

try:
    __version__ = version("landfall")
except PackageNotFoundError:  # used from a build folder
    __version__ = "0"

__all__ = [
    "Anywhere",
    "Beacons",
    "Beam",
    "CandidatePoses",
    "Error",
    "FileFormat",
    "FileNotFound",
    "FileWrite",
    "Gaussian",
    "GridMap",
    "Hypothesis",
    "InvalidArgument",
    "Log",
    "Mixture",
    "OdometryNoise",
    "Pose2",
    "PosePrior",
    "PreparedMap",
    "Region",
    "Scan",
    "SearchCounts",
    "SearchOptions",
    "SearchResult",
    "Sensor",
    "StageTimes",
    "TooLarge",
    "UnknownName",
    "UnknownOption",
    "WallMap",
    "Window",
    "active_isa",
    "align",
    "angle_distance",
    "consistent",
    "follow",
    "load_grid_map",
    "load_log",
    "load_map",
    "load_prior",
    "load_sensors",
    "load_trajectory",
    "load_wall_map",
    "make_fan",
    "make_scans",
    "map_from_known_poses",
    "merge",
    "methods",
    "save_grid_map",
    "save_log",
    "save_sensor",
    "save_trajectory",
    "save_wall_map",
    "search",
    "simulate",
    "simulate_ranges",
    "translation_distance",
    "wrap_angle",
]
