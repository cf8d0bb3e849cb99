"""Inequality (14) sample by sample as one would write it down: f(l) by its definition at mp.dps = 50.

Usage: python -m benchmarks.baseline_mpmath K
"""

import sys

from mpmath import mp, mpf


def main(last: int) -> None:
    """Print the smallest relative slack of (14) over k = 0..last for the paper's design."""
    mp.dps = 50
    alpha, h, gain = mpf(9) / 10, mpf(85) / 100, mpf(15) / 100
    beta = 1 - gain * h**alpha / mp.gamma(alpha + 1)
    total, power, smallest = mpf(0), mpf(1), mpf("inf")
    for k in range(last + 1):
        j = k + 1
        total += abs(mpf(j + 1) ** alpha - 2 * mpf(j) ** alpha + mpf(j - 1) ** alpha)
        power *= beta
        if power + total > 1:
            raise SystemExit(f"fails at k = {k}")
        smallest = min(smallest, 1 - power / (1 - total))
    print(mp.nstr(smallest, 12))


if __name__ == "__main__":
    main(int(sys.argv[1]))
