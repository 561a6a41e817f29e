"""Markdown whose measured parts are rewritten and whose other parts stay as a person wrote them.

A measured part lies between `<!-- measured: NAME -->` and `<!-- end of NAME -->`.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path


def table(rows: list[list[str]]) -> str:
    """The first row is the header; first column left, the others right."""
    header, *body = rows
    lines = [header, ["---", *("---:" for _ in header[1:])], *body]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def replace_measured(text: str, parts: Mapping[str, str]) -> str:
    """Raises ValueError where a part has no place in the text."""
    for name, content in parts.items():
        begin, end = f"<!-- measured: {name} -->\n", f"<!-- end of {name} -->"
        before, found_begin, rest = text.partition(begin)
        _, found_end, after = rest.partition(end)
        if not (found_begin and found_end):
            raise ValueError(f"no part '{begin.strip()}' ... '{end}'")
        text = before + begin + content.rstrip("\n") + "\n" + end + after
    return text


def rewrite_measured(path: Path, parts: Mapping[str, str]) -> None:
    """Raises OSError, ValueError; the file is whole at any time."""
    try:
        text = replace_measured(path.read_text(encoding="utf-8"), parts)
    except ValueError as cause:
        raise ValueError(f"{path}: {cause}") from None
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)
