"""Success, quantiles and honesty on tables small enough to check by hand."""

from __future__ import annotations

import json
import math

import landfall
import pytest
from landfall.evaluation import Estimate, judge, report

TRUTH = [(float(i), landfall.Pose2(float(i), 0.0, 0.0)) for i in range(5)]


def answer(stamp_s, x_m, theta_rad=0.0, probability=0.99, verdict="found"):
    return Estimate(stamp_s, landfall.Pose2(x_m, 0.0, theta_rad), probability, verdict)


def test_success_counts_every_query():
    estimates = [answer(0, 0.1), answer(1, 1.3), answer(2, 2.0, math.radians(4)), answer(4, 4.2)]
    numbers = report(judge(TRUTH, estimates, estimates_are_queries=False), 0.25, math.radians(3.0))
    assert numbers["queries"] == 5 and numbers["answered"] == 4 and numbers["right"] == 2
    assert numbers["success_rate"] == 0.4 and numbers["wrong_indices"] == [1, 2, 3]
    assert numbers["translation_m"]["median"] == pytest.approx(0.15)


def test_result_lines_are_the_queries():
    numbers = report(judge(TRUTH, [answer(4, 4.0)], estimates_are_queries=True), 0.25, 0.05)
    assert numbers["queries"] == 1 and numbers["success_rate"] == 1.0


def test_lines_can_be_set_aside():
    judged = judge(TRUTH, [answer(0, 0.0)], estimates_are_queries=False, skip_first=1, exclude=[3])
    assert [query.index for query in judged] == [1, 2, 4]


def test_equal_stamps_match_in_order():
    truth = [(1.0, landfall.Pose2(0, 0, 0)), (1.0, landfall.Pose2(5, 0, 0))]
    judged = judge(truth, [answer(1.0, 0.0), answer(1.0, 5.0)], estimates_are_queries=False)
    assert [query.translation_m for query in judged] == [0.0, 0.0]


def test_the_same_place_a_floor_higher_is_wrong():
    estimates = [answer(0, 0.0), Estimate(1.0, landfall.Pose2(1, 0, 0), 0.9, "found", map_index=1)]
    for truth_map, right in ((None, [0, 1]), (0, [0]), (1, [1])):
        judged = judge(TRUTH, estimates, estimates_are_queries=True, truth_map=truth_map)
        assert [query.index for query in judged if query.right(0.25, 0.05)] == right
        assert report(judged, 0.25, 0.05)["answered"] == 2


def test_answers_on_several_maps_are_pointed_out(tmp_path, landfall_command):
    hypothesis = {"x_m": 1.0, "y_m": 0.0, "theta_rad": 0.0, "probability": 0.9}
    lines = [
        {"stamp_s": float(i), "verdict": "found", "hypotheses": [{**hypothesis, "map_index": i}]}
        for i in (0, 1)
    ]
    (tmp_path / "r.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
    landfall.save_trajectory([(float(i), (1.0, 0.0, 0.0)) for i in (0, 1)], tmp_path / "t.tum")
    command = ("evaluate", "--estimate", tmp_path / "r.jsonl", "--truth", tmp_path / "t.tum", "--json")
    unsaid = landfall_command(*command)
    assert json.loads(unsaid.out)["right"] == 2 and "maps 0, 1; --truth-map" in unsaid.err
    said = landfall_command(*command, "--truth-map", 1)
    assert json.loads(said.out)["right"] == 1 and said.err == ""


def test_stamps_match_within_a_millisecond():
    judged = judge(TRUTH, [answer(1.0009, 1.0), answer(2.0011, 2.0)], estimates_are_queries=False)
    assert [math.isfinite(query.translation_m) for query in judged] == [False, True, False, False, False]


def test_verdicts_and_probabilities():
    estimates = [
        answer(0, 0.0, probability=1.0),
        answer(1, 1.0, probability=0.97),
        answer(2, 9.0, probability=0.96),
        answer(3, 3.0, probability=0.6, verdict="ambiguous"),
        Estimate(4.0, None, None, "lost"),
    ]
    numbers = report(judge(TRUTH, estimates, estimates_are_queries=True), 0.25, 0.05)
    assert numbers["verdicts"]["found"] == {"queries": 3, "right": 2}
    assert numbers["verdicts"]["found_that_are_right"] == pytest.approx(2 / 3)
    assert numbers["verdicts"]["right_that_are_found"] == pytest.approx(2 / 3)
    rows = {row["from"]: row for row in numbers["probability"]}
    assert (rows[0.95]["queries"], rows[0.95]["precision"]) == (2, 0.5)
    assert (rows[0.5]["queries"], rows[0.5]["right"]) == (1, 1)
    assert rows[0.999]["right"] == 1 and rows[0.9]["precision"] is None


def test_command_prints_one_object(files, landfall_command):
    done = landfall_command("evaluate", "--estimate", files.truth, "--truth", files.truth, "--json")
    assert done.code == 0 and json.loads(done.out)["success_rate"] == 1.0


def test_command_names_what_is_wrong(files, tmp_path, landfall_command):
    (tmp_path / "bad.jsonl").write_text('{"stamp_s": 1}\n')
    landfall_command("evaluate", "--estimate", tmp_path / "bad.jsonl", "--truth", files.truth).fails_with(
        "bad.jsonl:1", "hypotheses"
    )
    landfall_command("evaluate", "--estimate", tmp_path / "none.jsonl", "--truth", files.truth).fails_with(
        "none.jsonl"
    )
    (tmp_path / "later.tum").write_text("5000 0 0 0 0 0 0 1\n")
    landfall_command(
        "evaluate", "--estimate", files.truth, "--truth", tmp_path / "later.tum", "--skip-first", 1
    ).fails_with("no query")
    landfall_command(
        "evaluate", "--estimate", files.truth, "--truth", files.truth, "--exclude-index", "a"
    ).fails_with("--exclude-index")
