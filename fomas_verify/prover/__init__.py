"""Runs the claims on a design and collects what was found."""

from fomas_verify.prover.prove import Proof, prove

__all__ = ["Proof", "prove"]
