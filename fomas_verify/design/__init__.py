"""The design a user writes: parsing, validation, exact values."""

from fomas_verify.design.claim_ids import CLAIM_IDS, DEFAULT_REQUIRE
from fomas_verify.design.errors import DesignError
from fomas_verify.design.limits import Limits
from fomas_verify.design.model import Design, UncertainDesign
from fomas_verify.design.reading import design_from_mapping, parse_design, read_any, read_design

__all__ = [
    "CLAIM_IDS",
    "DEFAULT_REQUIRE",
    "Design",
    "DesignError",
    "Limits",
    "UncertainDesign",
    "design_from_mapping",
    "parse_design",
    "read_any",
    "read_design",
]
