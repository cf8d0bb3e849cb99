"""The extreme eigenvalues of families by their formulas against numpy's, and at sizes that no matrix has."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest

from fomas_verify.network import family, laplacian
from fomas_verify.network.large import large_family
from fomas_verify.spectrum.family_eigenvalues import extreme_eigenvalues

SIZES: list[tuple[str, dict[str, Any]]] = [
    *[(name, {"agents": n}) for name in ("cycle", "path", "star", "complete", "directed-cycle") for n in range(2, 14)],
    *[("hypercube", {"agents": n}) for n in (2, 4, 8, 16, 32)],
    *[("torus", {"shape": shape}) for shape in ((3, 3), (3, 4), (5, 4), (7, 3))],
    *[("grid", {"shape": shape}) for shape in ((1, 2), (2, 1), (1, 5), (6, 1), (2, 2), (4, 3), (3, 6))],
]


@pytest.mark.parametrize(("name", "size"), SIZES, ids=[f"{name} {next(iter(size.values()))}" for name, size in SIZES])
def test_against_numpy(name: str, size: dict[str, Any]) -> None:
    matrix = np.array([[float(x) for x in row] for row in laplacian(family(name, **size))])
    seen = np.linalg.eigvalsh((matrix + matrix.T) / 2)
    low, high = extreme_eigenvalues(large_family(name, **size).family, 128)
    assert [float(low.mid), float(high.mid)] == pytest.approx([seen[1], seen[-1]], abs=1e-12)
    assert max(low.width, high.width) < Fraction(1, 10**30)


@pytest.mark.parametrize("name", ["cycle", "path", "directed-cycle"])
def test_of_a_ring_of_two_to_the_64(name: str) -> None:
    """To full relative precision, though lambda2 is about 1e-37."""
    low, high = extreme_eigenvalues(large_family(name, agents=2**64).family, 128)
    with mpmath.workdps(120):
        turn = mpmath.pi / 2**64 * (1 if name == "path" else 2)
        true = (1 - mpmath.cos(turn)) * (1 if name == "directed-cycle" else 2)
        assert low.lower <= Fraction(*mpmath.libmp.to_rational(true._mpf_)) + Fraction(1, 10**110)
        assert Fraction(*mpmath.libmp.to_rational(true._mpf_)) - Fraction(1, 10**110) <= low.upper
    assert low.width < low.lower / 2**100
    assert high.upper <= (2 if name == "directed-cycle" else 4)


def test_of_a_long_torus() -> None:
    """The longer side alone has the least eigenvalue, both together the largest."""
    low, high = extreme_eigenvalues(large_family("torus", shape=(3, 2**40)).family, 128)
    side = extreme_eigenvalues(large_family("cycle", agents=2**40).family, 128)
    assert low.overlaps(side[0])
    assert high.contains(Fraction(7))
