"""Certificates shared by the attack's tests."""

from __future__ import annotations

import pytest

from . import handmade_family
from .designs import FAMILIES, NAMED
from .handmade import certificate
from .handmade_margins import margins

WITH_MARGINS = ("paper", "paper-as-mu", "k2-swap", "c4-third", "p4-root-tie", "unbalanced", "weighted-cycles", "star6")


@pytest.fixture(scope="session")
def handmade() -> dict[str, bytes]:
    """A certificate of every named design, made without the prover."""
    return {name: certificate(design) for name, design in NAMED.items()}


@pytest.fixture(scope="session")
def with_margins() -> dict[str, bytes]:
    """The same with margins, of a few designs."""
    return {f"{name}, margins": certificate(NAMED[name], margins(NAMED[name])) for name in WITH_MARGINS}


@pytest.fixture(scope="session")
def of_families() -> dict[str, bytes]:
    """A certificate of every named uncertain design, made without the prover."""
    return {name: handmade_family.certificate(family) for name, family in FAMILIES.items()}
