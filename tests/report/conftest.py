"""The paper's design, proved once."""

from pathlib import Path

import pytest

from fomas_verify.design import read_design
from fomas_verify.prover import Proof, prove


@pytest.fixture(scope="session")
def paper(checkout: Path) -> Proof:
    """The paper's design, proved."""
    return prove(read_design(checkout / "examples" / "paper.toml"))
