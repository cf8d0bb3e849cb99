"""The first terms of the resolvent, 1/F = sum r_n z^n with F = (1 - z) C (theory, section 2)."""

from sympy import expand, series, simplify, symbols

z = symbols("z")
TERMS = 5


def main() -> None:
    c = [1, *symbols(f"c1:{TERMS}")]
    C = sum(c[n] * z**n for n in range(TERMS))
    F = expand((1 - z) * C)
    expansion = series(1 / F, z, 0, TERMS).removeO()
    # the recursion r_n = - sum f(l) r_{n-l}, f(l) = c_l - c_{l-1}
    r = [1]
    for n in range(1, TERMS):
        r.append(-sum((c[k] - c[k - 1]) * r[n - k] for k in range(1, n + 1)))
    assert [simplify(expansion.coeff(z, n) - r[n]) for n in range(TERMS)] == [0] * TERMS
    assert simplify(r[1] - (1 - c[1])) == 0
    # 1/C = 1 - sum b_n z^n with r_n = 1 - (b_1 + ... + b_n), and sum_j c_{n-j} r_j = 1
    inverse = series(1 / C, z, 0, TERMS).removeO()
    for n in range(1, TERMS):
        b = [-inverse.coeff(z, k) for k in range(1, n + 1)]
        assert simplify(r[n] - (1 - sum(b))) == 0
        assert simplify(sum(c[n - k] * r[k] for k in range(n + 1)) - 1) == 0
    print("r_1 =", r[1], " r_2 =", expand(r[2]))


if __name__ == "__main__":
    main()
