"""What bad input gets: exit code 2 and one line that names file, line, field and value."""

from __future__ import annotations

import gzip
import json
import math

import landfall
import pytest

FLASER = "FLASER 3 1.0 2.0 3.0 0 0 0 0 0 0 1.0 host 1.0\n"


def convert(landfall_command, log):
    return landfall_command("convert", "--log", log, "--out", log.with_suffix(".out"))


def test_truncated_gzip(tmp_path, landfall_command):
    log = tmp_path / "cut.log.gz"
    content = gzip.compress("".join(FLASER.replace("2.0", f"{1 + k / 7:.3f}") for k in range(500)).encode())
    log.write_bytes(content[: len(content) // 2])
    convert(landfall_command, log).fails_with("cut.log.gz")


def test_flaser_with_too_few_ranges(tmp_path, landfall_command):
    log = tmp_path / "few.log"
    log.write_text(FLASER + "FLASER 180 1.0 2.0 0 0 0 0 0 0 1.0 host 1.0\n")
    convert(landfall_command, log).fails_with("few.log", "2", "180")


@pytest.mark.parametrize("value", ["nan", "-1.0", "rubbish"])
def test_ranges_that_are_no_ranges(tmp_path, landfall_command, value):
    log = tmp_path / "odd.log"
    log.write_text(FLASER + FLASER.replace("2.0", value))
    convert(landfall_command, log).fails_with("odd.log:2", value)


def test_yaml_without_resolution(files, landfall_command):
    text = files.map.read_text()
    files.map.write_text("\n".join(line for line in text.splitlines() if "resolution" not in line))
    landfall_command("relocalize", "--map", files.map, "--log", files.log).fails_with(
        "floor.yaml", "resolution"
    )


def test_yaml_that_points_to_no_image(files, landfall_command):
    (image,) = files.folder.glob("floor.p?m")
    image.unlink()
    landfall_command("relocalize", "--map", files.map, "--log", files.log).fails_with(image.name)


def test_header_that_promises_too_much(files, landfall_command):
    (image,) = files.folder.glob("floor.p?m")
    image.write_bytes(b"P5\n100000 100000\n255\n" + bytes(1000))
    landfall_command("relocalize", "--map", files.map, "--log", files.log).fails_with(image.name, "100000")


def test_prior_off_the_map(files, landfall_command):
    prior = files.folder / "prior.json"
    prior.write_text(json.dumps({"window": {"T_map_robot": [900, 900, 0], "half_x_m": 1, "half_y_m": 1}}))
    landfall_command("relocalize", "--map", files.map, "--log", files.log, "--prior", prior).fails_with(
        str(prior), "off the map", "(900, 900) m", "x -0.5 to 8.55 m, y -0.5 to 5.55 m"
    )


def test_unknown_place(files, landfall_command):
    landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--prior", "place:dock"
    ).fails_with("places.yaml")
    (files.folder / "floor.places.yaml").write_text("kitchen: {T_map_robot: [1, 2, 0]}\n")
    landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--prior", "place:dock"
    ).fails_with("dock", "floor.places.yaml", "'kitchen'")
    landfall_command(
        "relocalize", "--map", files.map, "--map", files.map, "--log", files.log, "--prior", "place:kitchen"
    ).fails_with("one map", "2")


def test_scan_without_valid_beam_is_lost_and_the_rest_answered(files, scans, landfall_command):
    scans[5].ranges_m[:] = math.nan
    landfall.save_log(scans, files.log)
    out, results = files.folder / "p.tum", files.folder / "r.jsonl"
    done = landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--results", results, "--out", out
    )
    assert done.code == 0, done.err
    lines = [json.loads(line) for line in results.read_text().splitlines()]
    assert [line["verdict"] for line in lines].count("lost") == 1
    assert lines[5]["verdict"] == "lost" and lines[5]["hypotheses"] == [] and "beam" in lines[5]["reason"]
    assert len(landfall.load_trajectory(out)) == 11
    (why,) = [line for line in done.out.splitlines() if lines[5]["reason"] in line]
    assert why.split()[-2] == "1"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["relocalize", "--method", "magic"], ["magic"]),
        (["relocalize", "--colour", "red"], ["--colour"]),
        (["relocalize", "--threads", "many"], ["--threads"]),
        (["relocalize", "--max-hypotheses", "0"], ["max_hypotheses", "0"]),
        (["relocalize", "--rotation-step-deg", "-1"], ["--rotation-step-deg -1", "0.01 to 360"]),
        (["relocalize", "--robot-radius-m", "-0.25"], ["robot_radius_m is -0.25,"]),
        (["relocalize", "--every", "0"], ["--every 0"]),
        (["relocalize", "--every=0"], ["--every 0"]),
        (["relocalize", "--threads", "-1"], ["--threads -1"]),
        (["relocalize", "--seed", "-1"], ["--seed -1", "from 0"]),
        (["relocalize", "--seed", str(2**64)], ["--seed 18446744073709551616", "2^64 - 1"]),
        (["relocalize", "--limit", "few"], ["--limit few", "whole number"]),
        (["relocalize", "--pictures", "-1"], ["--pictures -1"]),
        (["relocalize", "--disjoint"], ["--disjoint", "--window-scans"]),
        (["relocalize", "--no-align"], ["--no-align", "--window-scans"]),
        (["relocalize", "--prior", "everywhere"], ["everywhere", "anywhere", "place:NAME"]),
        (["relocalize", "--window-s", "-1"], ["--window-s"]),
        (["relocalize", "--window-s", "2", "--window-scans", "2"], ["--window-s", "--window-scans"]),
        (["relocalize", "--window-scans", "500"], ["12 scans"]),
        (["relocalize", "--out", "no/such/folder/p.tum"], ["no/such/folder"]),
        (["relocalize", "--picture", "p.xyz"], ["p.xyz", ".png"]),
        (["relocalize", "--results", "."], ["."]),
        (["relocalize", "--sensor", "none.yaml"], ["none.yaml"]),
        (["search", "--index", "99"], ["99", "12 scans"]),
    ],
)
def test_bad_arguments(files, landfall_command, arguments, words):
    command, *options = arguments
    log = ["--scan" if command == "search" else "--log", files.log]
    landfall_command(command, "--map", files.map, *log, *options).fails_with(*words)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["teleport"], ["teleport"]),
        (["relocalize"], ["--map"]),
        (["relocalize", "--map", "none.yaml", "--log", "none.log"], ["none.yaml"]),
        (["convert", "--log", "none.log", "--out", "x.jsonl"], ["none.log"]),
        (["map", "--log", "none.log", "--method", "magic", "--out", "x.yaml"], ["magic", "known-poses"]),
    ],
)
def test_bad_commands(landfall_command, arguments, words):
    landfall_command(*arguments).fails_with(*words)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--bounding-box"], ["--bounding-box", "tbf", "known-poses"]),
        (["--matcher", "branch_and_bound"], ["--matcher", "slam"]),
        (["--method", "tbf", "--animation", "a.gif"], ["--animation", "slam", "tbf"]),
        (["--method", "slam", "--animation", "a.mp4"], ["a.mp4", ".gif"]),
        (["--method", "slam", "--odometry"], ["--odometry", "slam"]),
        (["--out", "m.png"], ["m.png", ".yaml"]),
        (["--from-index", "12"], ["--from-index 12", "12"]),
        (["--from-index", "3", "--to-index", "3"], ["--to-index 3", "12"]),
    ],
)
def test_options_that_map_refuses(files, landfall_command, options, words):
    out = [] if "--out" in options else ["--out", files.folder / "m.yaml"]
    landfall_command("map", "--log", files.log, *out, *options).fails_with(*words)


def test_lines_of_the_truth_that_are_not_there(files, landfall_command):
    landfall_command(
        "evaluate", "--estimate", files.truth, "--truth", files.truth, "--exclude-index", "3,12"
    ).fails_with("12", "12 lines")


def test_map_needs_poses(files, landfall_command):
    landfall_command("map", "--log", files.log, "--out", files.folder / "m.yaml").fails_with("--poses")


def test_consistent_needs_odometry(files, scans, landfall_command):
    for scan in scans:
        scan.T_odom_robot = None
    landfall.save_log(scans, files.log)
    landfall_command("relocalize", "--map", files.map, "--log", files.log, "--consistent").fails_with(
        "odometry"
    )


def test_sensor_of_another_name(files, landfall_command):
    landfall.save_sensor(landfall.make_fan(10, 0.0, 0.1, name="sonar"), files.sensor)
    landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--sensor", files.sensor
    ).fails_with("'sonar'", "'laser'")
