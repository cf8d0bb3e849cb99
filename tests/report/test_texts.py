"""What a user or the prover wrote, as LaTeX: nothing is executed, no digit is lost."""

import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.enclosure.interval import Interval
from fomas_verify.report.latex_text import Tex, escape, escape_code
from fomas_verify.report.math_text import digits, math_number, rational, sentence, vector
from fomas_verify.report.rendering import _printed
from fomas_verify.report.spectrum_view import complex_text

COMMANDS = re.compile(
    r"\\(?:text(?:backslash|asciicircum|asciitilde|less|greater|bar|quotedbl|quotedblleft|quotedblright|quotesingle"
    r"|asciigrave|endash|emdash|ellipsis|degree)\{\}"
    r"|ensuremath\{\\[A-Za-z]+\}|allowbreak\{\}|(?:ss|ae|AE|oe|OE|o|O|l|L|i)\{\}|[`'^~=.\"uHvckr]\{[A-Za-z]\}|[{}$&#%_])"
)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (r"\input{/etc/passwd}", r"\textbackslash{}input\{/etc/passwd\}"),
        ("a_b & <script>", r"a\_b \& \textless{}script\textgreater{}"),
        ("$x^2$ #1 50%", r"\$x\textasciicircum{}2\$ \#1 50\%"),
        ("--help", "-{}-help"),
        ("é ő ñ Ł β", r"\'{e} \H{o} \~{n} \L{} \ensuremath{\beta}"),
        ("e\u0301", r"\'{e}"),
        ("中", "[U+4E2D]"),
        ("a\nb\tc", "a b c"),
    ],
)
def test_escape(text: str, expected: str) -> None:
    assert escape(text) == expected


@given(st.text(max_size=60))
def test_escaped_text_is_ascii_and_holds_known_commands_only(text: str) -> None:
    for escaped in (escape(text), escape_code(text)):
        assert escaped.isascii()
        rest = COMMANDS.sub("", escaped).replace("-{}", "-").replace(",{}", ",").replace("'{}", "'").replace("`{}", "`")
        assert not set(rest) & set("\\{}$&#%_^~")


def test_long_words_may_break() -> None:
    assert escape("W" * 90).count(r"\allowbreak{}") == 11
    assert r"\allowbreak" not in escape("W" * 20)


def test_templates_escape_all_but_tex() -> None:
    assert _printed("a_b") == r"a\_b"
    assert _printed(Tex("a_b")) == "a_b"
    assert _printed(7) == "7"
    with pytest.raises(TypeError, match="printed a Fraction"):
        _printed(Fraction(1, 2))
    with pytest.raises(TypeError, match="printed a float"):
        _printed(0.5)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.13474074618394382588...", r"0.13474\,07461\,83943\,82588\ldots"),
        ("0.174539", "0.174539"),
        ("-2/3", "-2/3"),
        ("1.5...e-40", r"1.5\ldots\times 10^{-40}"),
        ("1 +- 2e-38", r"1\pm 2\times 10^{-38}"),
        ("42", "42"),
    ],
)
def test_numbers(text: str, expected: str) -> None:
    assert math_number(text) == expected


@given(st.fractions(), st.integers(1, 60))
def test_no_digit_is_lost_or_rounded(x: Fraction, count: int) -> None:
    shown = digits(x, count).replace(r"\,", "").replace(r"\allowbreak ", "").replace(r"\times 10^{", "e").rstrip("}")
    if r"\ldots" not in shown:
        assert Fraction(shown) == x
    else:
        text = shown.replace(r"\ldots", "")
        unit = Fraction(1, 10 ** len(text.split("e")[0].partition(".")[2])) * Fraction(10) ** int(
            (text + "e0").split("e")[1]
        )
        assert 0 <= abs(x) - abs(Fraction(text)) < unit
        assert (x < 0) == text.startswith("-")


@pytest.mark.parametrize(
    ("x", "expected"),
    [
        (Fraction(9, 10), "0.9"),
        (Fraction(1, 3), "1/3"),
        (Fraction(12345678901, 98765432101), r"0.12499\,99988\,69\ldots"),
        (Fraction(123456789, 7), "123456789/7"),
    ],
)
def test_a_designs_numbers_are_exact_or_say_that_they_are_not(x: Fraction, expected: str) -> None:
    assert rational(x) == expected


def test_vector() -> None:
    assert vector([Fraction(-1), Fraction(1, 2)]) == r"(-1,\allowbreak 0.5)^{\mathsf T}"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("mu = 0.1 < 1/Delta_max = 1/7", r"$\mu = 0.1 < 1/\Delta_{\max} = 1/7$"),
        ("mu < mu* = 0.25: all of P", r"$\mu < \mu^\ast = 0.25$: all of $P$"),
        ("lower mu below 0.5", r"lower $\mu$ below $0.5$"),
        ("beta = 2^alpha - 1 exactly: equality at k = 0", r"$\beta = 2^\alpha-1$ exactly: equality at $k = 0$"),
        ("norm u_1 > norm u_0 (14)", r"$\lVert u_1\rVert > \lVert u_0\rVert$ (14)"),
        ("rely on repaired-condition", r"rely on \claimid{repaired-condition}"),
        ("eqL3 & 100% of \\x", r"\paperlabel{eqL3} \& $100$\% of \textbackslash{}x"),
        ("the graph has phase", "the graph has phase"),
    ],
)
def test_sentences(text: str, expected: str) -> None:
    assert sentence(text) == expected


def test_a_straddled_number_keeps_its_radius() -> None:
    assert r"\pm" in digits(Interval(Fraction(-1, 10**9), Fraction(1, 10**9)), 20)


def test_complex_numbers_cannot_be_misread() -> None:
    near = Interval(Fraction(3, 2) - Fraction(1, 10**40), Fraction(3, 2) + Fraction(1, 10**40))
    one, two = Interval.exactly(1), Interval.exactly(2)
    assert re.fullmatch(
        r"\(1\.5\\pm \d\\times 10\^\{-\d+\}\) \\pm \\mathrm i", complex_text(near, one, pair=True, sign=r"\pm")
    )
    assert complex_text(two, -two, pair=True, sign=r"\mp") == r"2 \mp 2\,\mathrm i"
    assert complex_text(two, -two, pair=False, sign=r"\mp") == r"2 - 2\,\mathrm i"
    assert complex_text(two, two, pair=False, sign=r"\mp") == r"2 + 2\,\mathrm i"
    assert complex_text(two, Interval.exactly(0), pair=False, sign=r"\mp") == "2"
