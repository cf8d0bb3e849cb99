"""Whether the witness of `control-norm-bound` or `trajectory-norm-bound` shows its claim.

Each condition of section 4 of docs/certificate-format.md is tested as it stands there, at 60 digits and more.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial

from mpmath import mp

from . import oracle, ties
from .bounds import is_symmetric, memory_at_0
from .form_witness import Claim
from .gain import Truth, both, mu_at_least, mu_at_most
from .model import Design
from .response import Response, all_true, along, error_columns, on_1perp, trajectory
from .spectral_witness import leaves


def _exceeds(controls: Response, k: int) -> Truth:
    """norm(Phi_k e) > norm(e)."""
    truth = controls.control_at_most(k, mp.mpf(1))
    return None if truth is None else not truth


def _covered(design: Design, controls: Response | None, samples: int, powers: int) -> Truth:
    """The hypotheses of the peak lemma with M = 1, K = samples, m = powers; no controls where e = 0."""
    own = on_1perp(design)
    c, last = own.kernel.c, samples + powers
    if last + 1 > own.limit:
        return None
    with mp.workdps(own.dps + 10):
        tail: list[Callable[[], Truth]] = [lambda: own.power_at_most(powers, c(last + 1) / c(samples + 1))]
        if controls is None:
            return all_true(tail)
        first = [partial(controls.control_at_most, k, mp.mpf(1)) for k in range(1, samples + 1)]
        then = [partial(controls.power_at_most, n, c(n)) for n in range(samples + 1, last + 1)]
        return all_true([*first, *then, *tail])


def _closed_form(design: Design, t: Fraction, r: Fraction) -> Truth:
    """A symmetric graph with t >= mu, no eigenvalue above r, t r <= 2, and beta <= 2^alpha - 1."""
    if not is_symmetric(design) or t * r > 2 or not ties.eigenvalues_at_most(design, r):
        return False
    return both(mu_at_most(design, t), memory_at_0(design).truth)


def control_shown(design: Design, claim: Claim) -> Truth:
    """The witnesses of `control-norm-bound`."""
    witness = claim.witness
    if not witness:
        return oracle.decide(design, "repaired-condition").truth
    if "power" in witness:
        start = both(witness["mu"] > 0, mu_at_least(design, witness["mu"]))
        return start and both(start, leaves(design, witness["mu"], witness))
    if claim.verdict == "refuted":
        start = (tuple(witness["x0"]),)
        return any(error_columns(design, start)[0]) and _exceeds(along(design, start), witness["k"])
    if "samples" in witness:
        return _covered(design, on_1perp(design), witness["samples"], witness["powers"])
    return _closed_form(design, witness["mu"], witness["lambda_max_upper"])


def trajectory_shown(design: Design, claim: Claim) -> Truth:
    """The witnesses of `trajectory-norm-bound`."""
    controls, witness = trajectory(design), claim.witness
    if claim.verdict == "refuted":
        return controls is not None and _exceeds(controls, witness["k"])
    if "samples" in witness:
        return _covered(design, controls, witness["samples"], witness["powers"])
    if witness:
        return _closed_form(design, witness["mu"], witness["lambda_max_upper"])
    return controls is None or oracle.decide(design, "repaired-condition").truth
