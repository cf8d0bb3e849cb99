"""Runs the claims on a design and collects what was found."""

from fomas_verify.prover.prove import Proof, prove
from fomas_verify.prover.uncertain import UncertainProof, prove_uncertain

__all__ = ["Proof", "UncertainProof", "prove", "prove_uncertain"]
