"""The paper's proof step ``norm(P e) <= beta norm(e)`` for every e that sums to 0 (first line of eq1u0, "gamma beta").

beta is a lower bound of the contraction factor sigma, so the step is false unless sigma = beta. It is decided by
comparing the two, and where they may be equal by exact algebra in Q(lambda2). Source: theory, section 3.
"""

from __future__ import annotations

from fomas_verify.claims.remedy import lower_mu
from fomas_verify.claims.verdict import Decision, Verdict, undecided
from fomas_verify.enclosure.digits import decimal
from fomas_verify.enclosure.interval import short_dyadic
from fomas_verify.spectrum.contraction import (
    beta_contraction_witness,
    beta_contracts_at,
    direction_above,
    field_is_small,
    is_normal_on_fiedler_space,
    lambda2_root,
)
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.precision import PRECISIONS

ID = "beta-contraction"
STATEMENT = "norm of P e <= beta norm of e for every e that sums to 0 (step of the proof of Theorem 1)"
SOURCE = "equ1u0"
COQ = "sigma_ge_beta"
MEANING = (
    "The paper's proof of Theorem 1 uses this step, so it does not cover this design; "
    "consensus and bounded control do not depend on it and are decided by their own claims."
)


def decide(loop: Loop) -> Decision:
    """Compare sigma with beta, as to the truth."""
    for bits in PRECISIONS:
        beta, sigma = loop.beta(bits), loop.sigma(bits)
        if sigma.lower > beta.upper:
            e = direction_above(loop, beta, bits)
            if e is not None:
                reason = f"sigma = {decimal(sigma, 18)} > beta = {decimal(beta, 18)}"
                return Decision(Verdict.REFUTED, {"e": e}, reason, MEANING, remedy(loop, bits))
        elif (witness := beta_contraction_witness(loop, bits)) is not None:
            return Decision(Verdict.PROVED, witness, f"sigma = beta = {decimal(beta, 18)}")
    return undecided(bits, f"sigma = {decimal(sigma, 18)} and beta = {decimal(beta, 18)}")


def remedy(loop: Loop, bits: int) -> str:
    """What would make the step true, where anything does."""
    if loop.laplacian == loop.laplacian.transpose():
        return lower_mu(loop, 2 / (loop.lambda2(bits) + loop.lambda_max(bits)).upper)
    root = lambda2_root(loop, bits)
    if root is None or not field_is_small(loop, root):
        return "repaired-condition has sigma in place of beta"
    if not is_normal_on_fiedler_space(loop, root):
        return "none: on this graph the step is false for every mu; repaired-condition has sigma in place of beta"
    mu = short_dyadic(loop.mu(bits).lower / 2, loop.mu(bits).lower)
    halves = (mu / 2**j for j in range(64))
    return next((lower_mu(loop, t) for t in halves if beta_contracts_at(loop, root, t)), "a much smaller gain")
