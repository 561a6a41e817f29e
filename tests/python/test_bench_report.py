"""The benchmark report's tables on numbers small enough to check by hand."""

from __future__ import annotations

import importlib
import json
import math
from pathlib import Path
from types import SimpleNamespace

import landfall
import pytest

BENCH = Path(__file__).resolve().parents[2] / "bench"


@pytest.fixture
def module(monkeypatch):
    """A module of bench/ by name."""
    monkeypatch.syspath_prepend(BENCH)
    return importlib.import_module


def test_only_measured_parts_are_rewritten(module, tmp_path):
    page = tmp_path / "RESULTS.md"
    page.write_text("by hand\n<!-- measured: a -->\nold\n<!-- end of a -->\nkept\n")
    module("results_page").rewrite_measured(page, {"a": "new"})
    assert page.read_text() == "by hand\n<!-- measured: a -->\nnew\n<!-- end of a -->\nkept\n"
    assert list(tmp_path.iterdir()) == [page]


def test_a_part_without_place_is_an_error(module, tmp_path):
    page = tmp_path / "RESULTS.md"
    page.write_text("<!-- measured: a -->\n")
    with pytest.raises(ValueError, match=r"RESULTS\.md: no part .* a "):
        module("results_page").rewrite_measured(page, {"a": "new"})


def test_the_page_has_a_place_for_every_part(module):
    parts = (
        "run",
        "buildings",
        "verdicts",
        "wean_hall",
        "willow_garage",
        "trace1",
        "kernels",
        "raycast",
        "search",
        "peers",
    )
    parts += ("isa", "executor", "growth")
    module("results_page").replace_measured((BENCH / "RESULTS.md").read_text(), dict.fromkeys(parts, ""))


def test_misses_are_marked_with_what_was_asked_for(module):
    targets = module("targets")
    rate = targets.Target("right", "%", ("one", "rate"), at_least={"a": 99.0, "b": 94.0})
    time = targets.Target("time", "ms", ("ms",), 1, at_most=10.0)
    measured = {
        "a": {"one": {"rate": 0.9899}, "ms": 10.0},
        "b": {"one": {"rate": 0.94}, "ms": 10.1},
        "c": {"one": {"rate": None}, "ms": 1.0},
    }
    assert targets.target_table((rate, time), measured) == [
        ["", "unit", "target", "a", "b", "c"],
        ["right", "%", ">= 99 / 94 / -", "**98.99** (missed 99)", "94.00", "-"],
        ["time", "ms", "<= 10", "10.0", "**10.1** (missed 10)", "1.0"],
    ]


def test_precision_by_probability_sums_over_buildings(module):
    def building(right, asked):
        empty = {"from": 0.0, "to": 0.5, "queries": 0, "right": 0}
        return {
            "single": {"probability": [empty, {"from": 0.5, "to": 1.0, "queries": asked, "right": right}]}
        }

    rows = module("targets").probability_table({"a": building(3, 4), "b": building(5, 6)})
    assert rows == [["probability", "a", "b", "all"], ["0.5 to 1", "3 / 4", "5 / 6", "8 / 10 = 80.0 %"]]


def test_kernels_in_the_order_of_their_registration(module, tmp_path):
    def median(name, family, rate, **limits):
        entry = {
            "name": name,
            "run_name": name,
            "aggregate_name": "median",
            "cpu_time": 1.0,
            "time_unit": "us",
        }
        return {**entry, "family_index": family, "bytes/s": rate, **limits}

    limits = {"load_bytes/s": 400e6, "split_load_bytes/s": 320e6}
    entries = [median("tile/SCALAR", 1, 2e6), median("tile/AVX2", 0, 240e6, **limits)]
    file = tmp_path / "bench_kernels.json"
    file.write_text(json.dumps({"context": {"date": "2026-11-22T10:00"}, "benchmarks": entries}))
    sections = module("suite_tables").suite_sections(tmp_path)
    assert sections == {
        "kernels": (
            "2026-11-22T10:00",
            [["kernel", "unit", "AVX2", "SCALAR"], ["tile", "M bytes/s", "240 (60, 75 %)", "2.0"]],
        )
    }


def test_the_chosen_way_is_bold_and_says_what_it_misses(module, tmp_path):
    def median(name, family, rate, **counters):
        entry = {
            "name": name,
            "run_name": name,
            "aggregate_name": "median",
            "cpu_time": 1.0,
            "time_unit": "us",
        }
        return {**entry, "family_index": family, "rays/s": rate, **counters}

    entries = [
        median("hall/fan/embree", 0, 5e6),
        median("hall/fan/walk", 1, 20e6, chosen=1.0),
        median("hall/single/embree", 2, 4e6),
        median("hall/single/walk", 3, 3e6, chosen=1.0),
        median("plan/fan/embree", 4, 30e6, chosen=1.0),
    ]
    file = tmp_path / "bench_raycast.json"
    file.write_text(json.dumps({"context": {"date": "2026-11-22T10:00"}, "benchmarks": entries}))
    assert module("suite_tables").suite_sections(tmp_path)["raycast"][1] == [
        ["M rays/s", "way", "hall", "plan"],
        ["fan", "embree", "5.0", "30.0"],
        ["fan", "walk", "**20.0**", "-"],
        ["single", "embree", "4.0", "-"],
        ["single", "walk", "**3.0** (75 % of the fastest)", "-"],
    ]


def test_peers_beside_landfall(module, tmp_path):
    def median(name, family, **counters):
        entry = {"run_name": name, "aggregate_name": "median", "cpu_time": 1.0, "time_unit": "us"}
        return {**entry, "name": f"{name}_median", "family_index": family, **counters}

    entries = [
        median("a/search/textbook", 0, median_ms=60.0),
        median("a/search/landfall", 1, median_ms=4.0),
        median("a/scan/mrpt", 2, **{"rays/s": 5e6}),
        median("a/scan/other", 3, **{"rays/s": 20e6}),
        median("a/scan/landfall", 4, **{"rays/s": 10e6}),
        median("a/field/landfall", 5, **{"poses/s": 1e6}),
    ]
    file = tmp_path / "bench_peers.json"
    file.write_text(json.dumps({"context": {"date": "2026-11-22T10:00"}, "benchmarks": entries}))
    _, rows = module("suite_tables").suite_sections(tmp_path)["peers"]
    assert rows == [
        ["what", "who", "unit", "peer", "landfall", "ratio"],
        ["a/search", "textbook", "ms", "60.0", "4.0", "15.0 x"],
        ["a/scan", "mrpt", "M rays/s", "5", "10", "2.0 x"],
        ["a/scan", "other", "M rays/s", "20", "10", "0.5 x"],
    ]


def median_of(module, **counters):
    return module("google_benchmark").Median(1.0, counters)


def growth_of(module, exponent):
    """Maps whose time grows with that power of the poses, one building, and beams that cost as many ms."""
    medians = {
        f"cut/cells:{side}x{side}/real_time": median_of(
            module, poses=720.0 * side**2, beams=180.0, median_ms=1e-3 * (720.0 * side**2) ** exponent
        )
        for side in (61, 601, 6001)
    }
    medians["building/intel/real_time"] = median_of(module, poses=2e8, beams=180.0, median_ms=4.0)
    for beams in (45.0, 90.0, 180.0):
        medians[f"beams/{beams:.0f}/real_time"] = median_of(module, poses=2e8, beams=beams, median_ms=beams)
    return module("growth").series(medians)


def test_growth_has_the_exponents_it_was_made_with(module):
    found = growth_of(module, 0.5)
    found["cut"].append(module("growth").Point("cells:1x1", 1e4, 180.0, 0.1))  # counts only among all
    assert module("growth").exponent_table(found) == [
        ["exponent of", "all", "1e+08 poses and more"],
        ["poses: cuts of infinite_corridor", "0.50", "0.50"],
        ["beams", "1.00", ""],
    ]
    found["cut"][-1] = module("growth").Point("cells:1x1", 1e4, 180.0, 1e-9)
    assert module("growth").exponent_table(found)[1][1] != "0.50"
    assert module("growth").exponent_table(found)[1][2] == "0.50"


def test_growth_of_one_size_has_no_exponent(module):
    assert math.isnan(module("growth").exponent([5.0, 5.0], [1.0, 2.0]))


def test_growth_table_names_map_poses_and_beams(module):
    rows = module("growth").growth_table(growth_of(module, 0.5))
    assert rows[0] == ["map", "poses", "beams", "median ms"]
    assert rows[1] == ["cut 61x61", "2.7e+06", "180", "1.64"]
    assert rows[4] == ["intel", "2e+08", "180", "4"]
    assert rows[-1] == ["beams 180", "2e+08", "180", "180"]


def test_growth_is_drawn(module, tmp_path):
    module("growth").draw_growth(growth_of(module, 0.5), tmp_path / "growth.png")
    assert (tmp_path / "growth.png").read_bytes().startswith(b"\x89PNG")
    assert list(tmp_path.iterdir()) == [tmp_path / "growth.png"]


@pytest.fixture
def report(module, monkeypatch, tmp_path):
    """bench/report.py over one suite, bench_growth, and pages of its own."""
    report = module("report")
    entries = [
        {"name": f"floor/cells:{side}x{side}", "cpu_time": 1.0, "time_unit": "ms"}
        | {"poses": 720.0 * side**2, "beams": 180.0, "median_ms": float(side)}
        for side in (100, 1000)
    ]
    (tmp_path / "bench_growth.json").write_text(
        json.dumps({"context": {"date": "2026-11-22T10:00"}, "benchmarks": entries})
    )
    (tmp_path / "RESULTS.md").write_text("<!-- measured: growth -->\n<!-- end of growth -->\n")
    (tmp_path / "other.md").write_text("<!-- measured: growth -->\n<!-- end of growth -->\n")
    monkeypatch.setenv("LANDFALL_DATA", str(tmp_path / "none"))
    monkeypatch.setattr(report, "OUT", tmp_path)
    monkeypatch.setattr(report, "GROWTH", tmp_path / "bench_growth.json")
    monkeypatch.setattr(report, "RESULTS", tmp_path / "RESULTS.md")
    monkeypatch.setattr(report, "GROWTH_PICTURE", tmp_path / "growth.png")
    return report


@pytest.mark.parametrize(("page", "drawn"), [("RESULTS.md", True), ("other.md", False)])
def test_the_growth_picture_belongs_to_the_results_page(report, tmp_path, page, drawn):
    assert report.main(["--papers", "", "--results", str(tmp_path / page)]) == 0
    assert "| floor 100x100 | 7.2e+06 | 180 | 100 |" in (tmp_path / page).read_text()
    assert (tmp_path / "growth.png").exists() == drawn


def test_a_paper_has_its_part_of_the_page(report, tmp_path, monkeypatch):
    asked = []

    def run(**arguments):
        asked.append(arguments)
        return {"share": 0.5}

    paper = SimpleNamespace(run=run, table=lambda result: [["", "share"], ["ours", str(result["share"])]])
    monkeypatch.setattr(report, "experiment", lambda name: paper)
    page = tmp_path / "page.md"
    page.write_text(
        "<!-- measured: growth -->\n<!-- end of growth -->\n"
        "<!-- measured: reproduce_grid -->\n<!-- end of reproduce_grid -->\n"
    )
    assert report.main(["--papers", "grid", "--quick", "--results", str(page)]) == 0
    assert "| ours | 0.5 |" in page.read_text()
    assert asked == [{"seed": 1, "seeds": 2, "out": tmp_path / "reproduce" / "grid"}]
    with pytest.raises(SystemExit):
        report.main(["--papers", "nobody-1900"])


def test_a_benchmark_that_failed_is_an_error(module, tmp_path):
    entry = {"name": "floor/1", "error_occurred": True, "error_message": "not proven"}
    file = tmp_path / "bench_growth.json"
    file.write_text(json.dumps({"context": {"date": "2026-11-22T10:00"}, "benchmarks": [entry]}))
    with pytest.raises(ValueError, match=r"bench_growth\.json: floor/1: not proven"):
        module("google_benchmark").load_suite(file)


def test_a_run_names_instruction_set_and_executor(report):
    machine = report.circumstances([])["machine"]
    assert machine.endswith(f", {landfall.active_isa()}, {landfall.active_executor()}")


def test_searches_by_instruction_set(module):
    medians = {
        "intel/branch_and_bound/threads:1/real_time": median_of(module, median_ms=5.0),
        "intel/branch_and_bound/isa:AVX2/real_time": median_of(module, median_ms=5.0),
        "intel/branch_and_bound/isa:SCALAR/real_time": median_of(module, median_ms=200.0),
    }
    assert module("suite_tables").isa_table(medians) == [
        ["instruction set", "place", "median ms", "of the best"],
        ["AVX2", "intel", "5.0", "1.00"],
        ["SCALAR", "intel", "200.0", "40.00"],
    ]


def test_executors_side_by_side(module):
    medians = {}
    for executor, ms in (("tbb", 3.0), ("openmp", 4.5)):
        suffix = f"threads:2/executor:{executor}/real_time"
        medians[f"intel/branch_and_bound/{suffix}"] = median_of(module, median_ms=ms, p95_ms=2 * ms)
        medians[f"intel/batch/{suffix}"] = median_of(module, **{"scans/s": 900.0 / ms})
    medians["intel/batch/threads:2/real_time"] = median_of(module, **{"scans/s": 1.0})
    assert module("suite_tables").executor_table(medians) == [
        ["executor", "place", "median ms", "p95 ms", "batch: scans/s"],
        ["tbb", "intel", "3.0", "6.0", "300.0"],
        ["openmp", "intel", "4.5", "9.0", "200.0"],
    ]


def test_the_report_asks_as_the_command_does(module, prepared, scans):
    """Every query is answered, and every result kept."""
    buildings = module("buildings")
    question = buildings.Question([prepared], landfall.Anywhere(), landfall.SearchOptions())
    queries = buildings.single_queries(len(scans), 1)
    answers, tally = buildings.relocalize_all(scans, queries, question)
    assert len(tally.verdicts) == len(answers.kept) == len(scans)
    assert [best.stamp_s for best in buildings.first_hypotheses(answers)] == [s.stamp_s for s in scans]
