"""Certificates shared by the attack's tests."""

from __future__ import annotations

import pytest

from .designs import NAMED
from .handmade import certificate


@pytest.fixture(scope="session")
def handmade() -> dict[str, bytes]:
    """A certificate of every named design, made without the prover."""
    return {name: certificate(design) for name, design in NAMED.items()}
