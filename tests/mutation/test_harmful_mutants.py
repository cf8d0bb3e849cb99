"""The gate goes red: changes that would let the checker accept what is false are each caught by its own tests."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from .planted import planted_source

ROOT = Path(__file__).resolve().parents[2]
# Module, text, what stands in its place, and the tests that must see it.
HARMFUL = [
    (
        "powers",
        "return -(-a // b) if up else a // b",
        "return a // b",
        "test_few_bits.py::test_enclosures_of_short_numbers",
    ),
    (
        "powers",
        "y.upper if x.lower >= 0",
        "y.lower if x.lower >= 0",
        "test_powers.py::test_quotient_encloses_every_quotient",
    ),
    ("ball", "len(columns[0])) + 1", "len(columns[0]))", "test_ball.py::test_rounding_of_every_entry_by_less_than_one"),
    (
        "norms",
        "floor(scaled), ceil",
        "ceil(scaled), ceil",
        "test_ball.py::test_an_irrational_norm_between_two_integers",
    ),
    ("definite", "row[-1] - sign * shift", "row[-1]", "test_few_bits.py::test_quick_signs_of_nearly_singular_matrices"),
    ("ruling", "if sign is None:", "if sign is None and not statement:", "test_ties.py::test_need"),
    ("ruling", "if sign not in allowed:", "if sign not in (*allowed, 0):", "test_ties.py::test_need"),
    ("field", "!= 1:", "== 0:", "test_field.py::test_isolate"),
    ("text", "if key in result:", "if key not in pairs:", "test_form.py::test_bytes"),
    ("contraction", 'need_that(sum(witness.e) == 0, "e sums to 0")', "pass", "test_refused.py"),
    ("contraction", 'need_that(facts.graph.is_symmetric, "the graph is symmetric")', "pass", "test_refused.py"),
    ("stability", 'need(least_sign(matrix), (1,), "Q > 0")', "pass", "test_refused.py"),
    ("claims", 'need_that(t > 0, "0 < witness.mu")', "pass", "test_refused.py"),
    ("decay", "need_that(last >= 1, below)", "pass", "test_ties.py::test_settling_at_the_first_sample"),
    (
        "relation",
        "(1,), _DECAY",
        "(-1, 1), _DECAY",
        "test_ties.py::test_a_trajectory_at_rest_after_one_step_still_needs_the_decay",
    ),
    ("cosines", "Fraction(1, 2): Fraction(1),", "Fraction(1, 2): Fraction(2),", "test_cosines.py"),
    ("cosines", "(square + 1) // 2", "square // 2", "test_cosines.py"),
    ("large_bounds", "gap * (1 - mu.upper", "gap * (1 - mu.lower", "test_large_bounds.py"),
    ("large_bounds", "if any(map(any, columns))", "if all(map(any, columns))", "test_large_bounds.py"),
    ("large", "known.sigma_square(bits).upper < 1:", "known.sigma_square(bits).upper <= 1:", "test_large_bounds.py"),
    ("large", "mu.upper * (low.upper + high.upper)", "mu.upper * (low.lower + high.upper)", "test_large_rows.py"),
    ("large", "(bound**2), known.sigma_square(bits))", "(bound), known.sigma_square(bits))", "test_large_rows.py"),
    ("large", "need_that(sum(vector) == 0,", "need_that(sum(vector) <= 0,", "test_large_reasons.py"),
    ("large_form", "if rows * columns != agents:", "if rows * columns < agents:", "test_large_limits.py"),
    ("network", "return self._degrees[0] == self", "return self._degrees[0] >= self", "test_network.py"),
]


def run(*tests: str, **environment: str) -> int:
    """The exit status of pytest on some of the checker's tests: 0 all passed, 1 some failed."""
    options = ["-x", "-q", "-p", "tests.mutation.planted", "-p", "no:cacheprovider"]
    command = [sys.executable, "-m", "pytest", *options, *(f"tests/checker/{name}" for name in tests)]
    settings = {**os.environ, **environment}
    return subprocess.run(command, cwd=ROOT, env=settings, capture_output=True, check=False).returncode


def test_without_a_change_they_pass() -> None:
    assert run(*sorted({tests for *_, tests in HARMFUL})) == 0


@pytest.mark.slow
@pytest.mark.parametrize(("module", "before", "after", "tests"), HARMFUL, ids=[text[:40] for _, text, *_ in HARMFUL])
def test_harm_is_caught(module: str, before: str, after: str, tests: str) -> None:
    assert planted_source(module, before, after)
    assert run(tests, PLANTED=f"{module}\n{before}\n{after}") == 1


def test_what_is_not_there_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="expected once, found 0 times"):
        planted_source("ruling", "no such text", "")
