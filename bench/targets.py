"""What landfall must reach, beside what was measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

Numbers = Mapping  # of one building or drive, nested: what buildings.py and drives.py measure
Limits = Mapping[str, float] | float  # one for all, or by name


@dataclass(frozen=True)
class Target:
    """A number, and what it must reach."""

    what: str
    unit: str
    path: tuple[str, ...]
    digits: int = 2
    at_least: Limits | None = None
    at_most: Limits | None = None

    def value(self, numbers: Numbers) -> float | None:
        for key in self.path:
            numbers = numbers[key]
        return None if numbers is None else UNITS[self.unit] * numbers  # type: ignore[operator]

    def limit(self, name: str) -> float | None:
        limits = self.at_most if self.at_least is None else self.at_least
        return limits.get(name) if isinstance(limits, Mapping) else limits

    def missed(self, name: str, numbers: Numbers) -> bool:
        value, limit = self.value(numbers), self.limit(name)
        if value is None or limit is None:
            return False
        return value > limit if self.at_least is None else value < limit

    def cell(self, name: str, numbers: Numbers) -> str:
        """The value; where it is missed, marked, with what was asked for."""
        value = self.value(numbers)
        if value is None:
            return "-"
        text = f"{value:.{self.digits}f}"
        return f"**{text}** (missed {self.limit(name):g})" if self.missed(name, numbers) else text

    def wanted(self, names: list[str]) -> str:
        limits = ["-" if self.limit(name) is None else f"{self.limit(name):g}" for name in names]
        if set(limits) == {"-"}:
            return ""
        sign = "<=" if self.at_least is None else ">="
        return f"{sign} {limits[0] if len(set(limits)) == 1 else ' / '.join(limits)}"


UNITS = {"": 1.0, "%": 100.0, "cm": 100.0, "deg": 1.0, "ms": 1.0, "s": 1.0, "MB": 1e-6, "scans/s": 1.0}

ONE_SCAN = {"intel": 99.0, "csail": 98.5, "aces": 99.5, "acapulco": 99.5, "infinite_corridor": 94.0}
MEDIAN_CM = {"intel": 3.0, "csail": 3.0, "aces": 3.0, "acapulco": 4.0, "infinite_corridor": 4.0}
MEDIAN_MS = {"intel": 1.2, "csail": 3.0, "aces": 3.5, "acapulco": 12.0, "infinite_corridor": 40.0}
P95_MS = {"intel": 5.0, "infinite_corridor": 150.0}
MAX_MS = {"intel": 40.0}
BATCH = {"intel": 700.0}
TRACKING_MS = {"intel": 0.1}
PREPARED_S = {"intel": 0.06, "infinite_corridor": 2.0}
PREPARED_MB = {"infinite_corridor": 237.0}  # 12 bytes a cell

BUILDINGS = (
    Target("queries asked", "", ("single", "queries"), 0),
    Target("one scan: right", "%", ("single", "success_rate"), at_least=ONE_SCAN),
    Target("median error of the right", "cm", ("single", "translation_m", "median"), 1, at_most=MEDIAN_CM),
    Target("of the found, right", "%", ("single", "verdicts", "found_that_are_right"), at_least=99.0),
    Target("of the right, found", "%", ("single", "verdicts", "right_that_are_found"), 1, at_least=80.0),
    Target("on other buildings' maps: found", "%", ("foreign", "share"), at_most=1.0),
    Target("windows of five: right", "%", ("windows", "success_rate"), at_least=99.5),
    Target("of these found, right", "%", ("windows", "verdicts", "found_that_are_right")),
    Target("align: steps within 10 cm, 1.5 deg", "%", ("align", "share"), at_least=95.0),
    Target("align: steps as --consistent's", "%", ("align", "as_consistent")),
    Target("truth: steps as --consistent's", "%", ("align", "truth_as_consistent")),
    Target("--consistent: right", "%", ("consistent", "success_rate"), at_least=99.5),
    Target("equal to exhaustive search", "%", ("exhaustive", "share"), 0, at_least=100.0),
    Target("search_ms: median", "ms", ("latency", "median_ms"), 1, at_most=MEDIAN_MS),
    Target("search_ms: 95th percentile", "ms", ("latency", "p95_ms"), 1, at_most=P95_MS),
    Target("search_ms: largest", "ms", ("latency", "max_ms"), 1, at_most=MAX_MS),
    Target("window of 1 m, 30 deg: median", "ms", ("tracking", "median_ms"), at_most=TRACKING_MS),
    Target("batch", "scans/s", ("single", "scans_per_s"), 1, at_least=BATCH),
    Target("map prepared in", "s", ("prepare", "seconds"), at_most=PREPARED_S),
    Target("prepared map holds", "MB", ("prepare", "bytes"), 0, at_most=PREPARED_MB),
)
WEAN_HALL = (
    Target("windows of 5 s with motion", "", ("windows",), 0),
    Target("alone: explained >= 0.7", "%", ("alone", "explained"), 1),
    Target("alone: neighbours agree within 0.5 m", "%", ("alone", "neighbours_agree"), 1),
    Target("--consistent: explained >= 0.7", "%", ("tied", "explained"), 1, at_least=90.0),
    Target(
        "--consistent: neighbours agree within 0.5 m", "%", ("tied", "neighbours_agree"), 1, at_least=90.0
    ),
    Target("--consistent: both", "%", ("tied", "right"), 1, at_least=90.0),
    Target("--consistent: steps off odometry", "", ("tied", "jumps"), 0, at_most=0.0),
)
WILLOW_GARAGE = (
    Target("poses asked", "", ("asked",), 0),
    Target("right", "%", ("success_rate",), 1, at_least=99.0),
    Target("of the right, found", "%", ("right_that_are_found",), 1),
    Target("search_ms: median", "ms", ("median_ms",), 1, at_most=15.0),
    Target("search_ms: 95th percentile", "ms", ("p95_ms",), 1),
)
TRACE1 = (
    Target("scans of the second half asked", "", ("asked",), 0),
    Target("where the halves overlap", "", ("overlapping",), 0),
    Target("within 0.5 m, 10 deg of the localizer", "%", ("success_rate",), 1),
    Target("of the found, right", "%", ("found_that_are_right",), 1),
)


def target_table(targets: tuple[Target, ...], measured: Mapping[str, Numbers]) -> list[list[str]]:
    """Header and rows: a column per building or drive."""
    names = list(measured)
    rows = [["", "unit", "target", *names]]
    for target in targets:
        cells = [target.cell(name, measured[name]) for name in names]
        rows.append([target.what, target.unit, target.wanted(names), *cells])
    return rows


def probability_table(measured: Mapping[str, Numbers]) -> list[list[str]]:
    """Right of asked by the probability that was claimed, one scan and no prior."""
    names = list(measured)
    rows = [["probability", *names, "all"]]
    bins = [measured[name]["single"]["probability"] for name in names]
    for of_bin in zip(*bins, strict=True):
        right, asked = sum(b["right"] for b in of_bin), sum(b["queries"] for b in of_bin)
        if asked == 0:
            continue
        cells = [f"{b['right']} / {b['queries']}" for b in of_bin]
        label = f"{of_bin[0]['from']:g} to {of_bin[0]['to']:g}"
        rows.append([label, *cells, f"{right} / {asked} = {100.0 * right / asked:.1f} %"])
    return rows


def verdict_table(measured: Mapping[str, Numbers]) -> list[list[str]]:
    names = list(measured)
    rows = [["verdict: right / asked", *names]]
    for verdict in ("found", "ambiguous", "lost"):
        of = [measured[name]["single"]["verdicts"][verdict] for name in names]
        rows.append([verdict, *(f"{v['right']} / {v['queries']}" for v in of)])
    return rows
