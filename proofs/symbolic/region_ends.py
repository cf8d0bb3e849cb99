"""The ends of the closed-form regions of mu, and the alpha from which they are nonempty (theory, section 5)."""

from sympy import Rational, S, log, simplify, solve, solveset, sqrt, symbols

mu, lambda2, D, c1, c2 = symbols("mu lambda2 D c1 c2", positive=True)
alpha = symbols("alpha", positive=True)


def main() -> None:
    beta = 1 - mu * lambda2
    # (14) is -sqrt(c2) <= beta <= c1, with c1 = 2^alpha - 1
    low = solve(beta - c1, mu)[0].subs(c1, 2**alpha - 1)
    assert simplify(low - (2 - 2**alpha) / lambda2) == 0
    assert simplify(solve(beta + sqrt(c2), mu)[0] - (1 + sqrt(c2)) / lambda2) == 0
    # nonempty with mu < 1/D: lambda2 > D (2 - 2^alpha), that is alpha > log2(2 - lambda2/D)
    opens = log(2 - lambda2 / D) / log(2)
    assert simplify((lambda2 - D * (2 - 2**alpha)).subs(alpha, opens)) == 0
    # repaired closed form: betahat^2 <= c1^2
    betahat2 = 1 - 2 * mu * lambda2 * (1 - mu * D)
    quadratic = 2 * D * lambda2 * mu**2 - 2 * lambda2 * mu + 1 - c1**2
    assert simplify(betahat2 - c1**2 - quadratic) == 0
    ends = solve(quadratic, mu)
    discriminant = lambda2 * (lambda2 - 2 * D * (1 - c1**2))
    expected = [(lambda2 + sign * sqrt(discriminant)) / (2 * D * lambda2) for sign in (1, -1)]
    assert all(any(simplify(end - other) == 0 for other in expected) for end in ends)
    # the ends are real iff lambda2 >= 2 D (1 - c1^2); on the paper's graph iff alpha >= log2(1 + sqrt(3)/2)
    real = solveset(1 - 4 * (1 - c1**2), c1, S.Reals)
    assert sqrt(3) / 2 in real
    threshold = log(1 + sqrt(3) / 2) / log(2)
    assert abs(threshold.evalf(12) - Rational("0.89996863")) < Rational(1, 10**8)
    print("as stated: mu >=", low, " repaired closed form opens on the paper's graph at alpha =", threshold.evalf(10))


if __name__ == "__main__":
    main()
