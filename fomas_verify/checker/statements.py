"""The claims a certificate can make, and what each says, to the letter.

Source: docs/certificate-format.md, sections 4 and 8 to 10.
"""

STATEMENTS: dict[str, str] = {
    "graph-assumption": "the digraph is strongly connected and balanced (Assumption 1)",
    "gain-bound": "0 < mu < 1/Delta_max (gain bound (15) [eqh])",
    "memory-inequality": "beta^(k+1) + sum_{l=1}^{k+1} abs f(l) <= 1 for every k >= 0 (inequality (14) [eqT2])",
    "perron-eigenvalues": "1 is a simple eigenvalue of P and every other eigenvalue of P lies in the open unit disc",
    "beta-contraction": "norm of P e <= beta norm of e for every e that sums to 0 (step of the proof of Theorem 1)",
    "repaired-condition": ("norm of P e <= (2^alpha - 1) norm of e for every e that sums to 0 (sigma <= 2^alpha - 1)"),
    "control-norm-bound": "norm u_k <= norm u_0 for every k >= 0 and every x_0 (relation eqL3)",
    "trajectory-norm-bound": "norm u_k <= norm u_0 for every k >= 0, for the x_0 of the design",
    "control-bounded": "for every x_0, norm u_k is bounded over k and u_k tends to 0",
    "average-consensus": "for every x_0 and every i, x_i(t) tends to the mean of x_0 as t tends to infinity",
}

ANY_GRAPH = frozenset({"graph-assumption", "gain-bound", "perron-eigenvalues"})
"""The claims that are statements about every graph; the others presuppose Assumption 1."""

VERDICTS = ("proved", "refuted", "undecided", "inapplicable")
VALUES = (
    "mu",
    "threshold",
    "degree_max",
    "lambda2",
    "beta",
    "sigma",
    "peak_control",
    "settling_samples",
    "settling_time",
    "rate",
    "actuator_reach",
    "limit",
    "margins",
)
CONDITIONS: dict[str, str] = {
    "as-stated": (
        "some mu > 0 satisfies mu < 1/Delta_max and -sqrt(3^alpha - 2^alpha) <= beta <= 2^alpha - 1, "
        "under Assumption 1 ((15) and (14))"
    ),
    "repaired-closed-form": (
        "some mu > 0 satisfies mu < 1/Delta_max and 1 - 2 mu lambda2 (1 - mu Delta_max) <= (2^alpha - 1)^2, "
        "under Assumption 1"
    ),
    "repaired": "some mu > 0 satisfies mu < 1/Delta_max and sigma <= 2^alpha - 1, under Assumption 1",
    "gain-bound": "some mu > 0 satisfies mu < 1/Delta_max",
    "consensus": "for some mu > 0 every x_i(t) tends to the mean of x_0, for every x_0, under Assumption 1",
}
"""What the certificate of a region can say: each that a condition on mu can be met."""

SWITCHED_STATEMENTS: dict[str, str] = {
    "graph-assumption": "every digraph of the set is strongly connected and balanced (Assumption 1)",
    "gain-bound": "0 < mu < 1/Delta_max for every digraph of the set (gain bound (15) [eqh])",
    "control-bounded": (
        "for every x_0 and every switching among the digraphs of the set and their convex combinations, "
        "norm u_k is bounded over k and u_k tends to 0"
    ),
    "average-consensus": (
        "for every x_0, every i and every switching among the digraphs of the set and their convex combinations, "
        "x_i(t) tends to the mean of x_0 as t tends to infinity"
    ),
}
"""The claims about a set of digraphs; the last two presuppose Assumption 1."""

SWITCHED_CONDITIONS: dict[str, str] = {
    "gain-bound": "some mu > 0 satisfies mu < 1/Delta_max for every digraph of the set",
    "common-form": (
        "for some mu > 0 one quadratic form decreases under every digraph of the set, "
        "so that the agents agree on the mean of x_0 under every switching, under Assumption 1"
    ),
}

MARGINS = ("gain-bound", "memory-inequality", "perron-eigenvalues", "repaired-condition", "control-norm-bound")

OBJECTIVES = ("fastest", "gentlest", "slowest-sampling", "most-robust")
TASK_CLAIMS: dict[str, str] = {
    "feasible": "some gamma > 0 and h > 0 satisfy the condition and the limits",
    "best": "no gamma > 0 and h > 0 that satisfy the condition and the limits are as good as the bound",
}
"""What the certificate of a synthesis can say beside the claims about the design that was found."""
