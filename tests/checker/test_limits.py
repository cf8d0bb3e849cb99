"""The limits of form and of work are those that the format page names."""

import re
from pathlib import Path

import pytest

from fomas_verify.checker import (
    contraction,
    definite,
    facts,
    graph,
    regions,
    report,
    resolvent,
    samples,
    stability,
    text,
)

PAGE = " ".join((Path(__file__).resolve().parents[2] / "docs" / "certificate-format.md").read_text().split())


def named(pattern: str) -> int:
    """The number that stands on the page where the pattern has a group."""
    (found,) = set(re.findall(pattern, PAGE))
    base, _, exponent = found.replace(" ", "").partition("^")
    return int(base) ** int(exponent or 1)


@pytest.mark.parametrize(
    ("limit", "pattern"),
    [
        (text.MAX_BYTES // 2**20, r"the file at most (\d+) MiB"),
        (text.MAX_DEPTH, r"nesting is at most (\d+) deep"),
        (text.MAX_DIGITS, r"at most (\d+ \d+) digits in all"),
        (text.MAX_COUNT_DIGITS, r"JSON integers of at most (\d+) digits"),
        (report.MAX_AGENTS, r"(\d+) agents;"),
        (graph.MAX_DENOMINATOR_BITS, r"(2\^\d+) bits in the common denominator"),
        (definite.MAX_EXACT_WORK, r"exact elimination N\^4 bits <= (2\^\d+)"),
        (definite.MAX_WIDE_WORK, r"and N\^5 bits\^2 <= (2\^\d+)"),
        (regions.MAX_PAIRS_WORK, r"bits of the weights \+ 64\) <= (2\^\d+)"),
        (facts.MAX_FIELD_WORK, r"degree\^2 N\^3 <= (2\^\d+)"),
        (contraction.MAX_POLYNOMIAL_WORK, r"length\^3 bits <= (2\^\d+)"),
        (definite.MAX_QUICK_WORK, r"fixed point N\^3 bits\^2 <= (2\^\d+)"),
        (facts.MAX_SCALE, r"(2\^\d+) bits between the lengths of numerator and denominator"),
        (resolvent.MAX_SAMPLES, r"samples (\d+ \d+),"),
        (samples.MAX_SAMPLE_BITS // 5, r"bits times samples <= 5 (2\^\d+)"),
        (stability.MAX_PRODUCT_WORK, r"Pc` N\^3 bits\^2 <= (2\^\d+)"),
        (stability.MAX_POWER_WORK, r"N\^3 log2\(n\) bits <= (2\^\d+)"),
        (facts.BITS[0], r"at (\d+) bits and then at twice as many"),
        (facts.BITS[-1], r"twice as many up to (\d+);"),
    ],
)
def test_the_limit_is_the_one_of_the_page(limit: int, pattern: str) -> None:
    assert limit == named(pattern)


def test_the_precision_doubles() -> None:
    assert [2 * bits for bits in facts.BITS[:-1]] == list(facts.BITS[1:])
