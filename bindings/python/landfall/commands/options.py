"""Options that several subcommands share, and what they load."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import (
    Anywhere,
    Log,
    PosePrior,
    PreparedMap,
    Sensor,
    load_map,
    load_places,
    load_prior,
    load_sensors,
)
from landfall.errors import FileNotFound, InvalidArgument, UnknownName
from landfall.logs import load_log

Maps = Annotated[
    list[Path],
    typer.Option(
        "--map", metavar="<path>", help="ROS map .yaml or wall plan .json; may be given several times."
    ),
]
OneMap = Annotated[Path, typer.Option("--map", help="ROS map .yaml or wall plan .json.")]
LogFile = Annotated[
    Path,
    typer.Option("--log", help="CARMEN text (also gzipped), scan lines .jsonl, ROS 1 or 2 bag, sonar table."),
]
SensorFile = Annotated[
    Path | None, typer.Option("--sensor", help="Sensor .yaml that replaces the log's own, by name.")
]
PriorText = Annotated[str, typer.Option("--prior", help="anywhere, place:NAME, or a prior .json.")]
Method = Annotated[str, typer.Option("--method", help="Search method: see `landfall methods`.")]
Threads = Annotated[int, typer.Option("--threads", min=0, help="0: all cores.")]
MaxHypotheses = Annotated[int, typer.Option("--max-hypotheses", help="Most hypotheses per answer.")]
TimeBudget = Annotated[float, typer.Option("--time-budget-s", help="Per scan; 0: none.")]
TranslationStep = Annotated[float, typer.Option("--translation-step-m", help="0: the map's resolution.")]
RotationStep = Annotated[float, typer.Option("--rotation-step-deg", help="Heading step, degrees.")]
RobotRadius = Annotated[
    float, typer.Option("--robot-radius-m", help="A pose is possible where this disc is free.")
]


def _checked_seed(seed: int) -> int:
    if not 0 <= seed < 2**64:
        raise InvalidArgument(f"--seed {seed}: expected a whole number from 0 to 2^64 - 1")
    return seed


Seed = Annotated[int, typer.Option("--seed", callback=_checked_seed, help="Of everything random.")]


def load_maps(paths: list[Path]) -> list[PreparedMap]:
    return [load_map(path) for path in paths]


def read_prior(text: str, maps: list[Path]) -> PosePrior:
    """A place is looked up beside the map. Raises UnknownName, InvalidArgument, FileNotFound, FileFormat."""
    if text == "anywhere":
        return PosePrior(Anywhere())
    if text.startswith("place:"):
        return _place(text.removeprefix("place:"), maps)
    if not Path(text).suffix and not Path(text).exists():
        raise UnknownName(f"--prior {text}: expected anywhere, place:NAME, or a prior .json")
    return load_prior(Path(text))


@contextmanager
def naming_prior(text: str) -> Iterator[None]:
    """Says which prior a search refuses: one that lies off the map, say."""
    try:
        yield
    except InvalidArgument as error:
        if str(error).startswith("prior "):
            raise InvalidArgument(f"--prior {text}: {error}") from None
        raise


def rotation_step_rad(rotation_step_deg: float) -> float:
    """Radians. Raises InvalidArgument that speaks of degrees, as the option does."""
    if not 0.01 <= rotation_step_deg <= 360.0:
        raise InvalidArgument(f"--rotation-step-deg {rotation_step_deg:g}: expected 0.01 to 360")
    return math.radians(rotation_step_deg)


def require_index_range(from_index: int, to_index: int | None, scans: int, log: Path) -> None:
    """Raises InvalidArgument where --from-index and --to-index leave no scan."""
    if from_index >= min(scans if to_index is None else to_index, scans):
        asked = f"--from-index {from_index}" + ("" if to_index is None else f" --to-index {to_index}")
        raise InvalidArgument(f"{asked}: no scan is left of {log}, which has {scans}, counted from 0")


def _place(name: str, maps: list[Path]) -> PosePrior:
    if len(maps) != 1:
        raise InvalidArgument(f"--prior place:{name}: a place is of one map, and {len(maps)} are given")
    file = maps[0].with_suffix(".places.yaml")
    if not file.exists():
        raise FileNotFound(f"--prior place:{name}: {file}: no such file; places are named in it")
    places = load_places(file)
    if name not in places:
        raise UnknownName(f"--prior place:{name}: {file} has no such place; it has {_quoted(places)}")
    return places[name]


def read_log(path: Path, sensor_file: Path | None = None) -> Log:
    """The log, its sensors replaced by the file's of the same names; none matching raises UnknownName."""
    if sensor_file is None:
        return load_log(path)
    sensors = load_sensors(sensor_file)
    log = load_log(path, sensors)
    used = {scan.sensor.name for scan in log.scans}
    if log.scans and not used & {sensor.name for sensor in sensors.values()}:
        raise UnknownName(
            f"{sensor_file}: sensor {_quoted(sensors)} does not occur in {path}, which has {_quoted(used)}"
        )
    return log


def one_sensor(path: Path, name: str | None) -> Sensor:
    """The file's only sensor, or the one of that name."""
    sensors = load_sensors(path)
    if name is None:
        if len(sensors) != 1:
            raise InvalidArgument(f"{path}: {len(sensors)} sensors ({_quoted(sensors)}): name one")
        return next(iter(sensors.values()))
    if name not in sensors:
        raise UnknownName(f"{path}: no sensor '{name}'; it defines {_quoted(sensors)}")
    return sensors[name]


def _quoted(names: object) -> str:
    return ", ".join(f"'{name}'" for name in sorted(names))  # type: ignore[call-overload]
