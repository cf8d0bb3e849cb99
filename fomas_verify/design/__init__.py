"""The design a user writes: parsing, validation, exact values."""

from fomas_verify.design.claim_ids import CLAIM_IDS, DEFAULT_REQUIRE, SWITCHED_CLAIM_IDS
from fomas_verify.design.errors import DesignError
from fomas_verify.design.limits import Limits
from fomas_verify.design.model import AnyDesign, Design, LargeDesign, SwitchedDesign, UncertainDesign, plain
from fomas_verify.design.reading import (
    design_from_mapping,
    parse_design,
    read_any,
    read_design,
    read_named,
    read_single,
)

__all__ = [
    "CLAIM_IDS",
    "DEFAULT_REQUIRE",
    "SWITCHED_CLAIM_IDS",
    "AnyDesign",
    "Design",
    "DesignError",
    "LargeDesign",
    "Limits",
    "SwitchedDesign",
    "UncertainDesign",
    "design_from_mapping",
    "parse_design",
    "plain",
    "read_any",
    "read_design",
    "read_named",
    "read_single",
]
