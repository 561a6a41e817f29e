"""Every subcommand on the small building: the files it leaves, and what it says."""

from __future__ import annotations

import json
import math

import landfall
import pytest
from conftest import POSES


def lines_of(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def is_picture(path):
    return path.read_bytes().startswith(b"\x89PNG") and path.stat().st_size > 10_000


def test_relocalize_and_evaluate(files, landfall_command):
    out, results = files.folder / "poses.tum", files.folder / "results.jsonl"
    done = landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--out", out, "--results", results
    )
    assert done.code == 0 and "12 (100.0 %)" in done.out and done.err == ""
    assert [line["index"] for line in lines_of(results)] == list(range(12))
    assert [stamp_s for stamp_s, _ in landfall.load_trajectory(out)] == [100.0 + i for i in range(12)]
    assert sorted(p.name for p in files.folder.glob("*.part")) == []
    for estimate in (out, results):
        evaluated = landfall_command("evaluate", "--estimate", estimate, "--truth", files.truth, "--json")
        assert json.loads(evaluated.out)["success_rate"] == 1.0


def test_relocalize_windows(files, landfall_command):
    results = files.folder / "results.jsonl"
    done = landfall_command(
        "relocalize",
        "--map",
        files.map,
        "--log",
        files.log,
        "--results",
        results,
        "--window-scans",
        5,
        "--consistent",
    )
    assert done.code == 0, done.err
    lines = lines_of(results)
    assert [line["index"] for line in lines] == list(range(4, 12))
    assert [line["stamp_s"] for line in lines] == [104.0 + i for i in range(8)]
    assert all(line["chosen"] == 0 and line["beams"] == 5 * 181 for line in lines)
    evaluated = landfall_command("evaluate", "--estimate", results, "--truth", files.truth, "--json")
    assert json.loads(evaluated.out)["success_rate"] == 1.0


def test_relocalize_subset_one_at_a_time_with_pictures(files, landfall_command):
    done = landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--every", 3, "--limit", 3, "--one-at-a-time",
        "--results", files.folder / "r.jsonl", "--picture", files.folder / "all.png", "--pictures", 2,
        "--pictures-dir", files.folder / "pictures",
    )  # fmt: skip
    assert done.code == 0, done.err
    assert [line["index"] for line in lines_of(files.folder / "r.jsonl")] == [0, 3, 6]
    assert is_picture(files.folder / "all.png")
    pictures = sorted((files.folder / "pictures").iterdir())
    assert [p.name for p in pictures] == ["query_00000.png", "query_00006.png"] and all(
        map(is_picture, pictures)
    )


def test_search_prints_one_object(files, landfall_command):
    picture = files.folder / "answer.png"
    done = landfall_command(
        "search",
        "--map",
        files.map,
        "--scan",
        files.log,
        "--index",
        4,
        "--max-hypotheses",
        1,
        "--picture",
        picture,
    )
    result = json.loads(done.out)
    assert result["index"] == 4 and len(result["hypotheses"]) == 1
    assert result["hypotheses"][0]["x_m"] == pytest.approx(POSES[4].x_m, abs=0.05)
    assert is_picture(picture)


def test_search_with_a_prior_file(files, landfall_command):
    prior = files.folder / "prior.json"
    prior.write_text(
        json.dumps(
            {
                "window": {
                    "T_map_robot": list(POSES[4]),
                    "half_x_m": 0.4,
                    "half_y_m": 0.4,
                    "half_theta_rad": 0.2,
                }
            }
        )
    )
    done = landfall_command("search", "--map", files.map, "--scan", files.log, "--index", 4, "--prior", prior)
    assert json.loads(done.out)["hypotheses"][0]["x_m"] == pytest.approx(POSES[4].x_m, abs=0.05)


def test_simulate_then_map_then_relocalize(files, landfall_command):
    """A map made from simulated scans serves the drive that made it."""
    log, made = files.folder / "simulated.jsonl", files.folder / "made.yaml"
    simulated = landfall_command(
        "simulate",
        "--map",
        files.map,
        "--sensor",
        files.sensor,
        "--poses",
        files.truth,
        "--out",
        log,
        "--seed",
        5,
    )
    assert simulated.code == 0 and [s.stamp_s for s in landfall.load_log(log).scans][:2] == [100.0, 101.0]
    mapped = landfall_command("map", "--log", log, "--poses", files.truth, "--out", made, "--to-index", 10)
    assert mapped.code == 0 and "10 of 10 scans" in mapped.out
    results = files.folder / "again.jsonl"
    landfall_command("relocalize", "--map", made, "--log", log, "--results", results)
    evaluated = landfall_command("evaluate", "--estimate", results, "--truth", files.truth, "--json")
    assert json.loads(evaluated.out)["success_rate"] >= 0.9


def test_simulation_repeats_with_its_seed(files, landfall_command):
    texts = []
    for k, seed in enumerate((5, 5, 6)):
        out = files.folder / f"s{k}.jsonl"
        landfall_command(
            "simulate", "--map", files.map, "--sensor", files.sensor, "--poses", files.truth, "--out", out,
            "--seed", seed,
        )  # fmt: skip
        texts.append(out.read_text())
    assert texts[0] == texts[1] != texts[2]


def test_convert_keeps_the_scans(files, landfall_command):
    out = files.folder / "again.jsonl"
    assert landfall_command("convert", "--log", files.log, "--out", out).code == 0
    assert out.read_text() == files.log.read_text()


def test_convert_takes_a_part_and_its_poses(tmp_path, scans, landfall_command):
    landfall.save_log(scans, tmp_path / "whole.jsonl")
    landfall_command(
        "convert", "--log", tmp_path / "whole.jsonl", "--out", tmp_path / "part.jsonl",
        "--poses", tmp_path / "part.tum", "--from-index", 4, "--to-index", 7,
    )  # fmt: skip
    assert [scan.stamp_s for scan in landfall.load_log(tmp_path / "part.jsonl").scans] == [
        104.0,
        105.0,
        106.0,
    ]
    assert list(landfall.load_trajectory(tmp_path / "part.tum")[0][1]) == pytest.approx(
        list(POSES[4]), abs=1e-5
    )


def test_methods_and_version(landfall_command):
    done = landfall_command("methods")
    assert "branch_and_bound" in done.out and landfall.active_isa() in done.out
    assert f"threads: {landfall.active_executor()}" in done.out
    listed = json.loads(landfall_command("methods", "--json").out)
    assert [row["name"] for row in listed["methods"]] == [name for name, _, _ in landfall.methods()]
    assert landfall_command("--version").out.startswith("landfall ")


def test_demo(tmp_path, landfall_command):
    done = landfall_command("demo", "--out", tmp_path / "demo")
    assert done.code == 0, done.err
    assert "success rate" in done.out
    names = {p.name for p in (tmp_path / "demo").iterdir()}
    assert {
        "map.yaml",
        "map.pgm",
        "drive.jsonl",
        "truth.tum",
        "poses.tum",
        "results.jsonl",
        "poses.png",
    } <= names
    evaluated = landfall_command(
        "evaluate",
        "--estimate",
        tmp_path / "demo/results.jsonl",
        "--truth",
        tmp_path / "demo/truth.tum",
        "--json",
    )
    assert json.loads(evaluated.out)["success_rate"] >= 0.9


@pytest.mark.parametrize("method", ["branch_and_bound", "grid"])
def test_search_at_a_named_place(files, landfall_command, method):
    truth = POSES[5]
    (files.folder / "floor.places.yaml").write_text(
        f"by the door: {{T_map_robot: [{truth.x_m + 0.3}, {truth.y_m - 0.2}, {truth.theta_rad}],"
        " half_x_m: 0.6, half_y_m: 0.6, half_theta_rad: 0.5}\n"
    )
    done = landfall_command(
        "search", "--map", files.map, "--scan", files.log, "--index", 5,
        "--prior", "place:by the door", "--method", method, "--rotation-step-deg", 2,
    )  # fmt: skip
    assert done.code == 0, done.err
    best = json.loads(done.out)["hypotheses"][0]
    assert math.hypot(best["x_m"] - truth.x_m, best["y_m"] - truth.y_m) < 0.1
