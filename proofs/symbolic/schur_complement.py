"""sigma(mu) <= rho iff [[rho G, M^T], [M, rho G]] >= 0 with M = G - mu G Lr (theory, section 5)."""

from sympy import Matrix, expand, eye, ones, simplify, symbols, zeros

mu, rho = symbols("mu rho", positive=True)


def reduced(L: Matrix) -> tuple[Matrix, Matrix, Matrix]:
    """Basis V of 1perp, its Gram matrix G, and Lr with L V = V Lr."""
    n = L.rows - 1
    V = Matrix.vstack(eye(n), -ones(1, n))
    Lr = (L * V)[:n, :]
    assert V * Lr == L * V
    return V, V.T * V, Lr


def main() -> None:
    a, b = symbols("a b", positive=True)
    A = Matrix([[0, b, a], [a + b, 0, 0], [0, a, 0]])
    L = Matrix.diag(*[sum(A.row(i)) for i in range(3)]) - A
    V, G, Lr = reduced(L)
    assert eye(2) + ones(2, 2) == G
    M = G - mu * G * Lr
    block = Matrix(4, 4, lambda i, j: 0)
    block[:2, :2], block[:2, 2:], block[2:, :2], block[2:, 2:] = rho * G, M.T, M, rho * G
    # congruence by [[I, -M^T G^-1 / rho], [0, I]] splits off rho G
    shear = Matrix(eye(4))
    shear[:2, 2:] = -M.T * G.inv() / rho
    split = (shear * block * shear.T).applyfunc(simplify)
    assert split[:2, 2:] == zeros(2, 2)
    assert split[2:, 2:] == rho * G
    # what remains is (rho^2 G - P^T P on 1perp) / rho
    P = eye(3) - mu * L
    rest = (rho**2 * G - V.T * P.T * P * V) / rho
    assert (split[:2, :2] - rest).applyfunc(lambda t: simplify(expand(t))) == zeros(2, 2)
    print("Schur complement of the LMI: (rho^2 G - V^T P^T P V) / rho")


if __name__ == "__main__":
    main()
