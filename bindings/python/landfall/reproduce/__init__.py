"""Experiments of published papers, one module each.

A module has run(seed, seeds, out), which returns what `landfall reproduce PAPER --json` prints and draws
pictures in the folder `out`, and table(result), the rows that a person reads; some have more_tables(result),
by name, for the page of results. Modules that only help others begin with an underscore.
"""

from __future__ import annotations

import importlib
import pkgutil
from types import ModuleType

from landfall.errors import UnknownName


def experiments() -> list[str]:
    """Names of the papers' methods, sorted."""
    names = (info.name for info in pkgutil.iter_modules(__path__))
    return sorted(name for name in names if not name.startswith("_"))


def experiment(paper: str) -> ModuleType:
    """The module of one of `experiments()`. Raises UnknownName."""
    if paper not in experiments():
        raise UnknownName(f"reproduce: unknown paper '{paper}'; known: {', '.join(experiments())}")
    return importlib.import_module(f"landfall.reproduce.{paper}")
