"""A pytest plugin that plants one change in the checker's source before the tests run: `-p tests.mutation.planted`.

PLANTED holds three lines: the module, the text in it, and what stands in its place.
"""

from __future__ import annotations

import os

from .transplant import CHECKER, transplant


def planted_source(module: str, before: str, after: str) -> str:
    """The module's source with the one place changed.

    Raises
    ------
    ValueError
        If the text does not stand there exactly once.
    """
    source = (CHECKER / f"{module}.py").read_text("utf-8")
    if source.count(before) != 1:
        raise ValueError(f"{module}.py: expected once, found {source.count(before)} times: {before}")
    return source.replace(before, after)


def pytest_collection_finish() -> None:
    if "PLANTED" in os.environ:
        module, before, after = os.environ["PLANTED"].split("\n")
        transplant(module, planted_source(module, before, after))
