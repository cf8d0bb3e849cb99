"""lambda2 = 1 and beta on the paper's graph, exactly; sigma exceeds |beta| for every mu > 0 (theory, section 3)."""

from sympy import Matrix, Rational, eye, factor, gamma, ones, simplify, symbols, zeros

EDGES = [(1, 4), (1, 5), (2, 1), (2, 3), (3, 1), (3, 2), (4, 2), (4, 3), (5, 4)]
mu = symbols("mu", positive=True)


def main() -> None:
    A = zeros(5, 5)
    for i, j in EDGES:
        A[i - 1, j - 1] = 1
    assert A * ones(5, 1) == A.T * ones(5, 1)
    L = Matrix.diag(*(A * ones(5, 1))) - A
    assert max(A * ones(5, 1)) == 2
    symmetric = (L + L.T) / 2
    assert sorted(symmetric.eigenvals(multiple=True)) == [0, 1, Rational(5, 2), Rational(5, 2), 3]
    # the Fiedler vector is no eigenvector of L, so |P v| > |beta| |v| for every mu > 0
    v = L * Matrix([0, -1, -1, -1, 1])
    assert symmetric * v == v
    assert L * v != v
    P = eye(5) - mu * L
    excess = factor((v.T * P.T * P * v)[0] - (1 - mu) ** 2 * (v.T * v)[0])
    assert simplify(excess - 8 * mu**2) == 0
    m = Rational("0.15") * Rational("0.85") ** Rational("0.9") / gamma(Rational("1.9"))
    assert str(m.evalf(20)).startswith("0.13474074618394382")
    print("lambda2 = 1, beta = 1 - mu =", (1 - m).evalf(15), " |P v|^2 - beta^2 |v|^2 =", excess)


if __name__ == "__main__":
    main()
