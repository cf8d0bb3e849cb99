"""``verify-design kernel``: each printed digit is a digit of the exact number."""

import csv
import io
import re
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import mpmath
import pytest
from mpmath import mp

Verify = Callable[..., CompletedProcess[str]]
PAPER = "examples/paper.toml"
HEADER = ["j", "f", "c", "partial_sum", "r"]


def truncated(cell: str, true: Any, digits: int) -> bool:
    """Whether the cell holds the first ``digits`` digits of a number computed far finer."""
    shown = Decimal(cell.replace("...", ""))
    p, q = mpmath.libmp.to_rational(abs(true)._mpf_)
    size, unit = Fraction(int(p), int(q)), Fraction(10) ** shown.as_tuple().exponent
    right = Fraction(shown.copy_abs()) <= size < Fraction(shown.copy_abs()) + unit
    return right and (shown < 0) == (true < 0) and len(shown.as_tuple().digits) == digits


def table(run: CompletedProcess[str]) -> list[list[str]]:
    assert (run.returncode, run.stderr) == (0, "")
    lines = [line.split() for line in run.stdout.splitlines()]
    assert lines[0] == HEADER
    return lines[1:]


@pytest.mark.parametrize("digits", [20, 50, 300])
def test_every_printed_digit_is_right(verify: Verify, digits: int) -> None:
    rows = table(verify("kernel", PAPER, "--terms", 30, "--digits", digits))
    assert [int(row[0]) for row in rows] == list(range(1, 31))
    with mp.workdps(digits + 80):
        a = mp.mpf(9) / 10
        f = [mp.mpf(0)] + [mp.mpf(j + 1) ** a - 2 * mp.mpf(j) ** a + mp.mpf(j - 1) ** a for j in range(1, 31)]
        r = [mp.mpf(1)]
        for n in range(1, 31):
            r.append(-sum(f[i] * r[n - i] for i in range(1, n + 1)))
        for j, row in enumerate(rows, 1):
            c = mp.mpf(j + 1) ** a - mp.mpf(j) ** a
            for cell, true in zip(row[1:], (f[j], c, 1 - c, r[j]), strict=True):
                assert cell.count("...") == 1
                assert truncated(cell, true, digits)


@pytest.mark.parametrize("exponent", [12, 30])
def test_far_out_the_last_digit_is_right(verify: Verify, exponent: int) -> None:
    """f(10^12) at 50 digits against ``2 sum_i binomial(alpha, 2i) j^(alpha - 2i)``, which cancels nothing."""
    (row,) = table(verify("kernel", PAPER, "--at", 10**exponent, "--digits", 50))
    with mp.workdps(100):
        a, j = mp.mpf(9) / 10, mp.mpf(10) ** exponent
        f = 2 * sum(mp.binomial(a, 2 * i) * j ** (a - 2 * i) for i in range(1, 12))
        c = sum(mp.binomial(a, i) * j ** (a - i) for i in range(1, 22))
        for cell, true in zip(row[1:4], (f, c, 1 - c), strict=True):
            assert truncated(cell, true, 50)
    assert len(row) == 4


def test_the_csv_file(verify: Verify, tmp_path: Path) -> None:
    path = tmp_path / "kernel.csv"
    run = verify("kernel", PAPER, "--terms", 4, "--at", "7,1000000", "--csv", path)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    assert path.read_bytes().splitlines()[0] == b"j,f,c,partial_sum,r"
    rows = list(csv.reader(io.StringIO(path.read_text())))
    assert rows[0] == HEADER
    assert [row[0] for row in rows[1:]] == ["1", "2", "3", "4", "7", "1000000"]
    assert all(re.fullmatch(r"-?\d+\.\d+(e-\d+)?", cell) for row in rows[1:] for cell in row[1:4])
    assert rows[-1][4] == ""
    printed = table(verify("kernel", PAPER, "--terms", 4, "--at", "7,1000000"))
    assert [[x.replace("...", "") for x in row] for row in printed] == [[x for x in row if x] for row in rows[1:]]


def test_indices_are_sorted_and_taken_once(verify: Verify) -> None:
    rows = table(verify("kernel", PAPER, "--at", "9, 3,9,1", "--terms", 1))
    assert [int(row[0]) for row in rows] == [1, 3, 9]
    assert [int(row[0]) for row in table(verify("kernel", PAPER, "--at", "9"))] == [9]
    assert len(table(verify("kernel", PAPER))) == 10


@pytest.mark.parametrize("alpha", ["1e-9", "1e-15", "0.999999999999", "1/3"])
def test_orders_near_the_ends(verify: Verify, tmp_path: Path, alpha: str) -> None:
    path = tmp_path / "design.toml"
    path.write_text(f'name = "k"\nalpha = "{alpha}"\nmu = 1\n[graph]\nfamily = "path"\nagents = 2\n')
    rows = table(verify("kernel", path, "--terms", 3, "--at", 10**9))
    with mp.workdps(140):
        a = mp.mpf(Fraction(alpha).numerator) / Fraction(alpha).denominator
        for row in rows:
            j = mp.mpf(int(row[0]))
            c = (j + 1) ** a - j**a
            for cell, true in zip(row[1:4], ((j + 1) ** a - 2 * j**a + (j - 1) ** a, c, 1 - c), strict=True):
                assert truncated(cell, true, 50)
