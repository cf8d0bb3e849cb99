"""f(j) = c_j - c_{j-1}, and the sum of |f(l)| over l <= n is 1 - c_n (theory, section 2)."""

from sympy import Integer, simplify, symbols

alpha = symbols("alpha", positive=True)
j = symbols("j", integer=True, positive=True)


def c(n):
    """Step response of the memory; 0^alpha is 0."""
    return (n + 1) ** alpha - n**alpha


def f(n):
    """The paper's f (eqL2_1)."""
    return (n + 1) ** alpha - 2 * n**alpha + (n - 1) ** alpha


def main() -> None:
    assert c(Integer(0)) == 1
    assert simplify(f(j) - (c(j) - c(j - 1))) == 0
    # f is negative, so |f| = -f; the base n = 0 holds, and the step from n to n + 1 adds |f(n + 1)|
    assert simplify((1 - c(j)) - (1 - c(j - 1)) - (-f(j))) == 0
    print("f(j) = c_j - c_(j-1);  sum_(l<=n) |f(l)| = 1 - c_n")


if __name__ == "__main__":
    main()
