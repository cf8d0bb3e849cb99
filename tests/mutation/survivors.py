"""The file of survivors: mutants that no test kills, each with the reason why nothing false is accepted for it."""

from __future__ import annotations

import ast
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .mutations import function_at
from .transplant import CHECKER

FILE = Path(__file__).with_name("survivors.toml")


@dataclass(frozen=True)
class Survivor:
    """A line of a function of a module, the wordings of it that survive, and why they may."""

    module: str
    function: str
    line: str
    mutants: tuple[str, ...]
    why: str


def survivors(text: str) -> list[Survivor]:
    """The entries of the file: a table for each module, in it one for each function, in it one for each line."""
    return [
        Survivor(module, function, entry["line"], tuple(entry["mutants"]), entry["why"])
        for module, functions in tomllib.loads(text).items()
        for function, entries in functions.items()
        for entry in entries
    ]


def stands(survivor: Survivor) -> bool:
    """Whether the function still has the line."""
    return survivor.line in _functions(survivor.module).get(survivor.function, "")


@cache
def _functions(module: str) -> dict[str, str]:
    """The text of each function of a module, without indentation and line feeds."""
    source = (CHECKER / f"{module}.py").read_text("utf-8")
    tree = ast.parse(source)
    found: dict[str, list[str]] = {}
    for number, row in enumerate(source.split("\n"), 1):
        found.setdefault(function_at(tree, number), []).append(row.strip())
    return {name: " ".join(rows) for name, rows in found.items()}
