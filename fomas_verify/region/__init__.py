"""The certified feasible region of (gamma, h), by a direct search. Source: theory, section 5."""

from fomas_verify.region.entries import certificate, record
from fomas_verify.region.find import find_region
from fomas_verify.region.model import Condition, Region, Strip
from fomas_verify.region.text import region_text

__all__ = ["Condition", "Region", "Strip", "certificate", "find_region", "record", "region_text"]
