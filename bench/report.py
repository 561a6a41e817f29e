"""Measures landfall on the real maps and logs and writes bench/RESULTS.md beside the Google Benchmark suites.
docs/growth.png is drawn from the suite bench_growth, beside bench/RESULTS.md alone.

    .venv/bin/python bench/report.py [--quick] [--buildings intel,csail] [--papers grid,fft] [--json N.json]

Buildings and drives are asked without prior. Real data are looked for in LANDFALL_DATA (default:
../shared/data beside the checkout); without them only the tables of suites and papers are rewritten.
`--buildings ""` and `--papers ""` leave those out.
"""

from __future__ import annotations

import argparse
import datetime
import itertools
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import landfall
from buildings import NAMES, Building, measure
from drives import trace1, wean_hall
from growth import draw_growth, exponent_table, growth_table, load_growth
from landfall.commands.tables import print_table
from landfall.reproduce import experiment, experiments
from results_page import rewrite_measured, table
from suite_tables import suite_sections
from targets import (
    BUILDINGS,
    TRACE1,
    WEAN_HALL,
    WILLOW_GARAGE,
    probability_table,
    target_table,
    verdict_table,
)
from willow_garage import willow_garage

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "build" / "bench" / "results"
GROWTH = OUT / "bench_growth.json"
RESULTS = ROOT / "bench" / "RESULTS.md"
GROWTH_PICTURE = ROOT / "docs" / "growth.png"  # that RESULTS shows
QUICK_EVERY = 10
SEED, SEEDS, QUICK_SEEDS = 1, 20, 2
DRIVES = {"wean_hall": WEAN_HALL, "willow_garage": WILLOW_GARAGE, "trace1": TRACE1}


def parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--buildings", default=",".join(NAMES), help="some of: " + ", ".join(NAMES))
    parser.add_argument("--quick", action="store_true", help=f"every {QUICK_EVERY}th query")
    parser.add_argument(
        "--no-drives", action="store_true", help="leave out Wean Hall, Willow Garage and the bag"
    )
    parser.add_argument("--papers", default=",".join(experiments()), help="experiments of published papers")
    parser.add_argument("--json", type=Path, default=OUT / "report.json", help="all numbers, as they come")
    parser.add_argument("--results", type=Path, default=RESULTS, help="what to rewrite")
    options = parser.parse_args(arguments)
    options.buildings = known_names(parser, "--buildings", options.buildings, NAMES)
    options.papers = known_names(parser, "--papers", options.papers, experiments())
    return options


def known_names(parser: argparse.ArgumentParser, option: str, text: str, known: Sequence[str]) -> list[str]:
    """Of a list with commas. Ends the program where one is not known."""
    names = text.split(",") if text else []
    unknown = sorted(set(names) - set(known))
    if unknown:
        parser.error(f"{option}: unknown: {', '.join(unknown)}; known: {', '.join(known)}")
    return names


def data_folder() -> Path:
    return Path(os.environ.get("LANDFALL_DATA") or ROOT.parent / "shared" / "data")


def measure_all(data: Path, options: argparse.Namespace, measured: dict) -> Iterator[None]:
    """Fills `measured`; yields after each building and drive. What the data folder lacks is left out."""
    every = QUICK_EVERY if options.quick else 1
    present = {name: Building(name, data / name) for name in NAMES if (data / name).is_dir()}
    for name in options.buildings:
        if name not in present:
            say(f"{data / name}: no such data")
            continue
        others = [building for building in present.values() if building.name != name]
        measured["buildings"][name] = measure(
            present[name], others, every, lambda what, name=name: say(f"{name}: {what}")
        )
        yield
    wean, bag = data / "wean_hall", data / "rosbag" / "trace1.bag"
    for drive in ("robotdata1", "robotdata5") if wean.is_dir() and not options.no_drives else ():
        say(f"Wean Hall: {drive}")
        measured["wean_hall"][drive] = wean_hall(wean, drive, OUT / f"wean_hall_{drive}.png")
        yield
    if (data / "maps").is_dir() and not options.no_drives:
        say("Willow Garage")
        measured["willow_garage"]["willow_garage"] = willow_garage(data / "maps", every)
        yield
    if bag.is_file() and not options.no_drives:
        say("bag: trace1")
        measured["trace1"]["trace1"] = trace1(bag, every)
        yield


def reproduce_all(options: argparse.Namespace, measured: dict) -> Iterator[None]:
    """Fills `measured`; yields after each experiment."""
    for name in options.papers:
        say(f"reproduce {name}")
        out = OUT / "reproduce" / name
        out.mkdir(parents=True, exist_ok=True)
        seeds = QUICK_SEEDS if options.quick else SEEDS
        measured["papers"][name] = experiment(name).run(seed=SEED, seeds=seeds, out=out)
        yield


def say(what: str) -> None:
    print(f"report: {what}", file=sys.stderr, flush=True)


def circumstances(arguments: list[str]) -> dict[str, str]:
    cpuinfo = Path("/proc/cpuinfo")
    names = re.findall(r"model name\s*:\s*(.+)", cpuinfo.read_text()) if cpuinfo.exists() else []
    kernels = f"{landfall.active_isa()}, {landfall.active_executor()}"
    commit = subprocess.run(
        ["git", "-C", ROOT, "describe", "--always", "--dirty"], capture_output=True, text=True
    ).stdout.strip()
    return {
        "machine": f"{names[0] if names else 'unknown'}, {os.cpu_count()} cores, {kernels}",
        "date": datetime.date.today().isoformat(),
        "commit": commit or "unknown",
        "command": " ".join(["bench/report.py", *arguments]),
    }


def measured_parts(measured: dict, run: dict[str, str]) -> dict[str, str]:
    """Name of a measured part of RESULTS.md -> its text."""
    parts = {}
    if measured["buildings"]:
        parts["run"] = "\n".join(f"- {key}: {value}" for key, value in run.items())
        parts["buildings"] = table(target_table(BUILDINGS, measured["buildings"]))
        parts["verdicts"] = "\n\n".join(
            table(rows)
            for rows in (verdict_table(measured["buildings"]), probability_table(measured["buildings"]))
        )
    for name, targets in DRIVES.items():
        if measured[name]:
            parts[name] = table(target_table(targets, measured[name]))
    for name, result in measured["papers"].items():
        for part, rows in paper_tables(name, result).items():
            parts[part] = f"{run['date']}\n\n{table(rows)}"
    for name, (date, rows) in suite_sections(OUT).items():
        parts[name] = f"{date[:10]}\n\n{table(rows)}"
    if GROWTH.is_file():
        date, found = load_growth(GROWTH)
        parts["growth"] = "\n\n".join((date[:10], table(exponent_table(found)), table(growth_table(found))))
    return parts


def paper_tables(name: str, result: dict) -> dict[str, list[list[str]]]:
    """Name of a measured part -> rows, of one experiment."""
    paper = experiment(name)
    more = paper.more_tables(result) if hasattr(paper, "more_tables") else {}
    parts = {f"reproduce_{name}_{which}": rows for which, rows in more.items()}
    return {f"reproduce_{name}": paper.table(result), **parts}


def print_tables(measured: dict) -> None:
    for title, targets in {"buildings": BUILDINGS, **DRIVES}.items():
        if measured[title]:
            header, *rows = target_table(targets, measured[title])
            print_table(([cell.replace("**", "") for cell in row] for row in rows), header)
    for name, result in measured["papers"].items():
        header, *rows = experiment(name).table(result)
        print_table(rows, header)


def main(arguments: list[str] | None = None) -> int:
    options = parse(arguments)
    run = circumstances(sys.argv[1:] if arguments is None else arguments)
    data = data_folder()
    if not data.is_dir():
        say(f"{data}: no real data: set LANDFALL_DATA")
    OUT.mkdir(parents=True, exist_ok=True)
    measured: dict = {"buildings": {}, **{name: {} for name in DRIVES}, "papers": {}}
    for _ in itertools.chain(measure_all(data, options, measured), reproduce_all(options, measured)):
        options.json.write_text(json.dumps({"run": run, **measured}) + "\n", encoding="utf-8")
    print_tables(measured)
    try:
        rewrite_measured(options.results, measured_parts(measured, run))
        if GROWTH.is_file() and options.results.resolve() == RESULTS:
            draw_growth(load_growth(GROWTH)[1], GROWTH_PICTURE)
    except (OSError, ValueError) as cause:
        say(str(cause))
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
