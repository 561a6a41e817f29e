"""search(): the one entry, with maps, priors and scans given one or many."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING, TypeAlias, overload

import numpy as np

from landfall._landfall import (
    Anywhere,
    Beacons,
    CandidatePoses,
    Gaussian,
    GridMap,
    Log,
    Mixture,
    PosePrior,
    PreparedMap,
    Region,
    Scan,
    SearchOptions,
    SearchResult,
    WallMap,
    Window,
    search_batch,
)
from landfall.errors import InvalidArgument, UnknownOption, WrongType

if TYPE_CHECKING:
    from typing_extensions import TypedDict, Unpack

    class SearchKeywords(TypedDict, total=False):
        """The fields of SearchOptions."""

        method: str
        translation_step_m: float
        rotation_step_rad: float
        max_hypotheses: int
        time_budget_s: float
        threads: int
        seed: int
        robot_radius_m: float
        distinct_translation_m: float
        distinct_rotation_rad: float


Prior: TypeAlias = (
    PosePrior | Anywhere | Window | Gaussian | Region | Beacons | CandidatePoses | Mixture | None
)
Map: TypeAlias = PreparedMap | GridMap | WallMap

PRIOR_KINDS = (PosePrior, Anywhere, Window, Gaussian, Region, Beacons, CandidatePoses, Mixture)
OPTION_NAMES = tuple(name for name in dir(SearchOptions) if not name.startswith("_"))


@overload
def search(
    map: Map | Sequence[Map], prior: Prior | Sequence[Prior], scans: Scan, **options: Unpack[SearchKeywords]
) -> SearchResult: ...
@overload
def search(  # type: ignore[overload-cannot-match]
    map: Map | Sequence[Map],
    prior: Prior | Sequence[Prior],
    scans: Sequence[Scan],
    **options: Unpack[SearchKeywords],
) -> list[SearchResult]: ...
def search(map, prior, scans, **options):  # type: ignore[no-untyped-def]
    """Where was the robot? results[i] answers scans[i]; a single Scan gives a single result.

    Many scans are answered side by side; a log's, in their order and with odometry, fastest: each then begins
    where the one before leads. Answers are those of each scan alone.

    map: a PreparedMap (or a GridMap or WallMap, prepared here each time), or a list of them: hypotheses
        are then ranked across the maps, Hypothesis.map_index says which.
    prior: where to look; None is anywhere in the free space; a list holds one prior per scan.
    options, with their defaults: method ("auto"), translation_step_m (0: the map's resolution),
        rotation_step_rad (0.5 degrees), max_hypotheses (5), time_budget_s (0: none; per scan), threads
        (0: all), seed (0), robot_radius_m (0), distinct_translation_m (0.5), distinct_rotation_rad
        (10 degrees).

    The GIL is released meanwhile, and Ctrl-C ends a batch. A scan with no valid beam is an answer (lost), not
    an error. Raises InvalidArgument (an option, prior or scan that does not validate; a prior entirely off
    the map), WrongType, UnknownName (a method), UnknownOption.
    """
    one = isinstance(scans, Scan)
    results = search_batch(_maps(map), _priors(prior), _scans(scans), search_options(**options))
    return results[0] if one else results


def search_options(**keywords: object) -> SearchOptions:
    """SearchOptions from keywords. Raises UnknownOption, InvalidArgument that name the keyword."""
    options = SearchOptions()
    for name, value in keywords.items():
        if name not in OPTION_NAMES:
            raise UnknownOption(f"search: unknown option '{name}'; known: {', '.join(OPTION_NAMES)}")
        try:
            setattr(options, name, value)
        except TypeError:
            expected = "a whole number from 0" if name == "seed" else type(getattr(options, name)).__name__
            raise InvalidArgument(f"search: option {name} is {value!r}, expected {expected}") from None
    return options


def _maps(given: Map | Sequence[Map]) -> list[PreparedMap]:
    maps = _listed(given)
    for map in maps:
        if isinstance(map, str | PathLike):
            raise WrongType(f"search: map is {map!r}: give load_map({map!r})")
        if not isinstance(map, PreparedMap | GridMap | WallMap):
            raise WrongType(f"search: map is a {_kind(map)}, expected PreparedMap, GridMap or WallMap")
    return [map if isinstance(map, PreparedMap) else PreparedMap(map) for map in maps]


def _priors(given: Prior | Sequence[Prior]) -> list[PosePrior | Anywhere]:
    priors = [Anywhere() if prior is None else prior for prior in _listed(given)]
    for prior in priors:
        if not isinstance(prior, PRIOR_KINDS):
            names = ", ".join(kind.__name__ for kind in PRIOR_KINDS)
            raise WrongType(f"search: prior is a {_kind(prior)}, expected None or one of {names}")
    return priors


def _scans(given: Scan | Sequence[Scan]) -> list[Scan]:
    if isinstance(given, np.ndarray):
        raise WrongType(
            f"search: scans is an array of shape {given.shape}: give make_scans(sensor, ranges_m)"
        )
    if isinstance(given, Log):
        raise WrongType("search: scans is a Log: give log.scans")
    scans = [given] if isinstance(given, Scan) else list(given)
    for i, scan in enumerate(scans):
        if not isinstance(scan, Scan):
            raise WrongType(f"search: scan {i} is a {_kind(scan)}, expected Scan")
    return scans


def _listed(given: object) -> list:
    return list(given) if isinstance(given, Sequence) and not isinstance(given, str) else [given]


def _kind(value: object) -> str:
    return type(value).__name__
