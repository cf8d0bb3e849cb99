"""Exact arithmetic: rational numbers, vectors, matrices, polynomials and number fields."""
