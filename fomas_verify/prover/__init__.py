"""Runs the claims on a design and collects what was found."""

from fomas_verify.prover.large import LargeProof, prove_large
from fomas_verify.prover.prove import Proof, prove
from fomas_verify.prover.uncertain import UncertainProof, prove_uncertain

__all__ = ["LargeProof", "Proof", "UncertainProof", "prove", "prove_large", "prove_uncertain"]
