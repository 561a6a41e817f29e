"""Result files: written under a temporary name, whole after every line, renamed at the end."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from landfall._landfall import Pose2, save_trajectory
from landfall.errors import FileNotFound, FileWrite, InvalidArgument

PICTURE_ENDINGS = (".png", ".pdf", ".svg")


class ResultsFile:
    """results.jsonl: lines go to NAME.part; leaving the `with` block renames it, after an error too."""

    def __init__(self, path: Path | None) -> None:
        if path is not None:
            require_writable(path)
        self.path = path
        self.part = None if path is None else path.with_name(path.name + ".part")
        self._lines = None

    def __enter__(self) -> ResultsFile:
        if self.part is not None:
            self._lines = _guarded(self.part, lambda part: part.open("w", encoding="utf-8"))
        return self

    def write(self, line: str) -> None:
        if self._lines is not None:
            self._lines.write(line + "\n")

    def flush(self) -> None:
        if self._lines is not None:
            self._lines.flush()

    def __exit__(self, *_: object) -> None:
        if self._lines is not None:
            self._lines.close()
            os.replace(self.part, self.path)


def rewrite_chosen(results: Path, lines: Sequence[str], choices: Sequence[int]) -> None:
    """results.jsonl anew, each line with "chosen": the index of the consistent hypothesis, -1: none."""
    part = results.with_name(results.name + ".part")
    with part.open("w", encoding="utf-8") as chosen_lines:
        for line, choice in zip(lines, choices, strict=True):
            chosen_lines.write(f'{line[:-1]}, "chosen": {choice}}}\n')
    os.replace(part, results)


def write_trajectory(poses: Sequence[tuple[float, Pose2]], tum: Path) -> None:
    """A TUM file. Raises FileNotFound, FileWrite."""
    require_writable(tum)
    save_trajectory(list(poses), tum)


def require_writable(path: Path) -> None:
    """Raises where `path` cannot become a file: said before the work, not after."""
    if path.is_dir():
        raise FileWrite(f"{path}: is a folder, expected a file to write")
    if not path.parent.is_dir():
        raise FileNotFound(f"{path}: its folder {path.parent} does not exist")


def require_picture(path: Path) -> None:
    """Raises FileNotFound, or InvalidArgument for an ending that no picture has."""
    require_writable(path)
    if path.suffix.lower() not in PICTURE_ENDINGS:
        known = ", ".join(PICTURE_ENDINGS)
        raise InvalidArgument(f"{path}: a picture ends in one of {known}, not '{path.suffix}'")


def make_folder(folder: Path) -> Path:
    """The folder, made where missing. Raises FileWrite."""
    _guarded(folder, lambda path: path.mkdir(parents=True, exist_ok=True))
    return folder


def _guarded(path: Path, action: Callable):
    try:
        return action(path)
    except OSError as cause:
        raise FileWrite(f"{path}: cannot be written: {cause.strerror or cause}") from cause
