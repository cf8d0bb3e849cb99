"""Text to LaTeX: what a user wrote is printed as it was written, never executed.

The result is plain ASCII, so that it means the same to every LaTeX. Characters that have no LaTeX here are printed by
their number, as ``[U+4E2D]``.
"""

from __future__ import annotations

import re
import unicodedata


class Tex(str):
    """LaTeX source: the only strings that a template prints as they are."""

    __slots__ = ()


_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "#": r"\#",
    "%": r"\%",
    "_": r"\_",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"\textquotedbl{}",
    "'": "'{}",
    "`": r"\textasciigrave{}",
}
_LETTERS = {
    "ß": r"\ss{}",
    "æ": r"\ae{}",
    "Æ": r"\AE{}",
    "œ": r"\oe{}",
    "Œ": r"\OE{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
    "ı": r"\i{}",
    "–": r"\textendash{}",
    "—": r"\textemdash{}",
    "’": "'{}",
    "‘": "`{}",
    "“": r"\textquotedblleft{}",
    "”": r"\textquotedblright{}",
    "…": r"\textellipsis{}",
    "×": r"\ensuremath{\times}",
    "±": r"\ensuremath{\pm}",
    "≤": r"\ensuremath{\le}",
    "≥": r"\ensuremath{\ge}",
    "→": r"\ensuremath{\to}",
    "∞": r"\ensuremath{\infty}",
    "°": r"\textdegree{}",
}
# fmt: off
_GREEK = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "varepsilon", "ζ": "zeta", "η": "eta",
    "θ": "theta", "ι": "iota", "κ": "kappa", "λ": "lambda", "μ": "mu", "ν": "nu", "ξ": "xi", "π": "pi",
    "ρ": "rho", "σ": "sigma", "τ": "tau", "υ": "upsilon", "φ": "varphi", "χ": "chi", "ψ": "psi",
    "ω": "omega", "Γ": "Gamma", "Δ": "Delta", "Θ": "Theta", "Λ": "Lambda", "Ξ": "Xi", "Π": "Pi",
    "Σ": "Sigma", "Φ": "Phi", "Ψ": "Psi", "Ω": "Omega",
}
# fmt: on
_ACCENTS = {
    "\u0300": "`",
    "\u0301": "'",
    "\u0302": "^",
    "\u0303": "~",
    "\u0304": "=",
    "\u0306": "u",
    "\u0307": ".",
    "\u0308": '"',
    "\u030a": "r",
    "\u030b": "H",
    "\u030c": "v",
    "\u0327": "c",
    "\u0328": "k",
}
_PIECE = 8
_LIGATURE = re.compile(r"-(?=-)|,(?=,)")


def escape(text: str) -> Tex:
    """The text as LaTeX prints it, safe anywhere in a paragraph; very long words may break."""
    normal = unicodedata.normalize("NFC", " ".join(text.split()))
    return Tex(" ".join(_word(word) for word in normal.split(" ")))


def escape_code(text: str) -> Tex:
    """The text as LaTeX prints it in a typewriter font: paths and digests may break between their parts."""
    pieces = re.findall(r"[^/_.\s]{1,32}[/_.\s]?|[/_.\s]", text)
    return Tex(r"\allowbreak{}".join(_characters(piece) for piece in pieces).replace("'{}", r"\textquotesingle{}"))


def _word(word: str) -> str:
    if len(word) <= 3 * _PIECE:
        return _characters(word)
    return r"\allowbreak{}".join(_characters(word[i : i + _PIECE]) for i in range(0, len(word), _PIECE))


def _characters(text: str) -> str:
    return _LIGATURE.sub(r"\g<0>{}", "".join(_character(c) for c in text))


def _character(c: str) -> str:
    if c in _SPECIAL:
        return _SPECIAL[c]
    if c.isascii() and c.isprintable():
        return c
    if c in _LETTERS:
        return _LETTERS[c]
    if c in _GREEK:
        return rf"\ensuremath{{\{_GREEK[c]}}}"
    base, *marks = list(unicodedata.normalize("NFD", c))
    if len(marks) == 1 and marks[0] in _ACCENTS and base.isascii() and base.isalpha():
        return rf"\{_ACCENTS[marks[0]]}{{{base}}}"
    return f"[U+{ord(c):04X}]"
