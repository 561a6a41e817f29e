"""tools/compare_bench on files whose medians are known."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

TOOL = Path(__file__).resolve().parents[2] / "tools" / "compare_bench"


def repetitions(name, times_ns):
    return [
        {
            "name": name,
            "run_name": name,
            "run_type": "iteration",
            "cpu_time": t,
            "real_time": 9.0,
            "time_unit": "ns",
        }
        for t in times_ns
    ]


def aggregate(run_name, kind, time_us):
    return {
        "name": f"{run_name}_{kind}",
        "run_name": run_name,
        "run_type": "aggregate",
        "aggregate_name": kind,
        "cpu_time": 1.0,
        "real_time": time_us,
        "time_unit": "us",
    }


@pytest.fixture
def compare(tmp_path):
    def run(old, new):
        paths = []
        for name, entries in (("old", old), ("new", new)):
            paths.append(tmp_path / f"{name}.json")
            paths[-1].write_text(json.dumps({"context": {"date": "today"}, "benchmarks": entries}))
        return subprocess.run([TOOL, *paths], capture_output=True, text=True)

    return run


def test_medians_of_repetitions(compare):
    done = compare(repetitions("a", [100, 300, 110]), repetitions("a", [121, 120, 1]))
    assert "110.000 ns   120.000 ns   1.091\n" in done.stdout
    assert done.returncode == 0


def test_slower_beyond_a_tenth_is_marked(compare):
    old = [*repetitions("a", [100]), *repetitions("b", [100]), *repetitions("c", [100])]
    new = [*repetitions("a", [111]), *repetitions("b", [109]), *repetitions("c", [50])]
    done = compare(old, new)
    marks = [line.split()[-1] for line in done.stdout.splitlines()]
    assert marks[:3] == ["slower", "1.090", "faster"]
    assert done.stdout.splitlines()[-1] == "1 of 3 slower by more than 10 %"
    assert done.returncode == 1


def test_stated_medians_and_wall_time(compare):
    name = "search/real_time"
    old = [aggregate(name, "mean", 7.0), aggregate(name, "median", 2000.0)]
    new = [aggregate(name, "mean", 900.0), aggregate(name, "median", 1000.0)]
    assert "2.000 ms     1.000 ms   0.500  faster" in compare(old, new).stdout


def test_benchmarks_of_one_file_are_named(compare):
    done = compare(repetitions("gone", [1]), repetitions("fresh", [1]))
    assert "gone   only in the old file" in done.stdout and "fresh  only in the new file" in done.stdout


@pytest.mark.parametrize("text", ["", "[]", '{"benchmarks": 3, "context": {}}'])
def test_another_file_is_refused(tmp_path, text):
    other = tmp_path / "other.json"
    other.write_text(text)
    done = subprocess.run([TOOL, other, other], capture_output=True, text=True)
    assert done.returncode == 2 and done.stderr.startswith(f"compare_bench: {other}: ")
    assert len(done.stderr.splitlines()) == 1
