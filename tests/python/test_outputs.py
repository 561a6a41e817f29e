"""Where results are written: never over a device, an input or one another; and what a full disk leaves."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys

import landfall
import pytest
from landfall.outputs import ResultsFile


def test_a_pipe_is_not_replaced(files, landfall_command):
    pipe = files.folder / "pipe"
    os.mkfifo(pipe)
    for option in ("--out", "--results"):
        landfall_command("relocalize", "--map", files.map, "--log", files.log, option, pipe).fails_with(
            str(pipe), "pipe"
        )
    with pytest.raises(landfall.FileWrite, match="pipe"):
        landfall.save_trajectory([], pipe)
    assert pipe.is_fifo()


def test_a_link_stays(files, landfall_command):
    for name in ("monday.jsonl", "monday.tum", "monday.png"):
        (files.folder / name).write_text("old")
        (files.folder / name.replace("monday", "latest")).symlink_to(name)
    done = landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--limit", 2,
        "--results", files.folder / "latest.jsonl", "--out", files.folder / "latest.tum",
        "--picture", files.folder / "latest.png",
    )  # fmt: skip
    assert done.code == 0, done.err
    assert all((files.folder / f"latest.{ending}").is_symlink() for ending in ("jsonl", "tum", "png"))
    assert len((files.folder / "monday.jsonl").read_text().splitlines()) == 2
    assert len(landfall.load_trajectory(files.folder / "monday.tum")) == 2


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (["relocalize", "--map", "floor.yaml", "--log", "drive.jsonl", "--out", "drive.jsonl"], ["an input"]),
        (["relocalize", "--map", "floor.yaml", "--log", "drive.jsonl", "--out", "x", "--results", "./x"],
         ["--results", "--out"]),
        (["convert", "--log", "drive.jsonl", "--out", "drive.jsonl"], ["an input"]),
        (["simulate", "--map", "floor.yaml", "--sensor", "laser.yaml", "--poses", "truth.tum",
          "--out", "truth.tum"], ["an input"]),
        (["map", "--log", "drive.jsonl", "--method", "slam", "--out", "m.yaml", "--trajectory", "m.yaml"],
         ["--trajectory", "--out"]),
    ],
)  # fmt: skip
def test_inputs_are_not_overwritten(files, landfall_command, monkeypatch, command, words):
    monkeypatch.chdir(files.folder)
    before = {path.name: path.read_bytes() for path in files.folder.iterdir()}
    landfall_command(*command).fails_with("overwrite", *words)
    assert {path.name: path.read_bytes() for path in files.folder.iterdir()} == before


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write everywhere")
def test_a_folder_without_permission_is_said_before_the_work(files, landfall_command):
    locked = files.folder / "locked"
    locked.mkdir(mode=0o500)
    landfall_command(
        "relocalize", "--map", files.map, "--log", files.log, "--results", locked / "r.jsonl"
    ).fails_with("r.jsonl", "ermission")


def test_a_full_disk_keeps_whole_lines(files, scans):
    """A limit on the size of files stands for the disk."""
    landfall.save_log(scans * 4, files.log)
    results, out = files.folder / "r.jsonl", files.folder / "p.tum"
    limit = 8192
    done = subprocess.run(
        [sys.executable, "-m", "landfall", "relocalize", "--map", files.map, "--log", files.log,
         "--results", results, "--out", out],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )  # fmt: skip
    assert done.returncode == 2 and f"{results}: cannot be written" in done.stderr, done.stderr
    lines = [json.loads(line) for line in results.read_text().splitlines()]
    assert 0 < len(lines) < 48 and results.stat().st_size <= limit
    assert len(landfall.load_trajectory(out)) >= len(lines)
    assert not results.with_name("r.jsonl.part").exists()


def test_lines_come_whole_after_an_error(tmp_path):
    with pytest.raises(RuntimeError), ResultsFile(tmp_path / "r.jsonl") as results:
        results.write("one")
        raise RuntimeError
    assert (tmp_path / "r.jsonl").read_text() == "one\n"
