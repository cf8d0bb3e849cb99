"""The paper's design, and its plant."""

import pytest

from fomas_verify.design import Design, design_from_mapping
from fomas_verify.simulate import Plant, plant_of
from tests.simulate.designs import PAPER


@pytest.fixture(scope="session")
def paper() -> Design:
    return design_from_mapping(PAPER)


@pytest.fixture(scope="session")
def plant(paper: Design) -> Plant:
    return plant_of(paper)
