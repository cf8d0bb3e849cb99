"""betahat^2 = 1 - 2 mu lambda2 (1 - mu D) from the quadratic form (theory, section 3)."""

from sympy import Matrix, Rational, expand, eye, simplify, symbols

mu, lambda2, D, q, e2, l2 = symbols("mu lambda2 D q e2 l2", nonnegative=True)


def balanced_example() -> tuple[Matrix, Matrix]:
    """A balanced digraph with free weights: a directed 3-cycle of weight a and an exchange of weight b."""
    a, b = symbols("a b", nonnegative=True)
    return Matrix([[0, b, a], [a + b, 0, 0], [0, a, 0]]), Matrix(symbols("x:3"))


def main() -> None:
    A, x = balanced_example()
    L = Matrix.diag(*[sum(A.row(i)) for i in range(3)]) - A
    assert [simplify(sum(L.col(j))) for j in range(3)] == [0, 0, 0]
    # x^T L_s x = (1/2) sum a_ij (x_i - x_j)^2
    form = (x.T * (L + L.T) / 2 * x)[0]
    squares = sum(A[i, j] * (x[i] - x[j]) ** 2 for i in range(3) for j in range(3)) / 2
    assert expand(form - squares) == 0
    # |P x|^2 = |x|^2 - 2 mu x^T L x + mu^2 |L x|^2
    P = eye(3) - mu * L
    assert expand(((P * x).T * (P * x))[0] - ((x.T * x)[0] - 2 * mu * form + mu**2 * ((L * x).T * (L * x))[0])) == 0
    # with |L x|^2 <= 2 D q and q >= lambda2 |x|^2 (q the form): the excess of the bound is a sum of nonnegative terms
    bound = (1 - 2 * mu * lambda2 * (1 - mu * D)) * e2
    exact = e2 - 2 * mu * q + mu**2 * l2
    slack_norm, slack_form = 2 * D * q - l2, q - lambda2 * e2
    assert expand(bound - exact - (mu**2 * slack_norm + 2 * mu * (1 - mu * D) * slack_form)) == 0
    best = Rational(1, 2) / D
    assert simplify((1 - 2 * mu * lambda2 * (1 - mu * D)).diff(mu).subs(mu, best)) == 0
    print("betahat^2 = 1 - 2 mu lambda2 (1 - mu D), least at mu = 1/(2 D)")


if __name__ == "__main__":
    main()
