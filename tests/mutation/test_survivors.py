"""Every entry of the file of survivors names source text that is there, changes it, and says why."""

from __future__ import annotations

from dataclasses import replace

import pytest

from .survivors import FILE, Survivor, stands, survivors

ALL = survivors(FILE.read_text("utf-8"))


@pytest.mark.parametrize("survivor", ALL, ids=lambda entry: f"{entry.module}.{entry.function}: {entry.line[:40]}")
def test_it_names_source_text_and_says_why(survivor: Survivor) -> None:
    assert stands(survivor)
    assert survivor.mutants
    assert survivor.line not in survivor.mutants
    assert len(set(survivor.mutants)) == len(survivor.mutants)
    assert len(survivor.why.split()) >= 3


def test_no_line_stands_there_twice() -> None:
    named = [(entry.module, entry.function, entry.line) for entry in ALL]
    assert len(set(named)) == len(named)


def test_a_line_or_a_function_that_is_gone_is_seen() -> None:
    assert not stands(replace(ALL[0], line="no such text"))
    assert not stands(replace(ALL[0], function="no_such_function"))
