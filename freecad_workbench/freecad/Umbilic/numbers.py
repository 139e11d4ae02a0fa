# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers for people."""

_SUPERSCRIPTS = str.maketrans("-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079")


def readable(value: float, unit: str = "", digits: int = 3) -> str:
    """A number with its significant digits, powers of ten as such, a true minus sign and its unit."""
    text = f"{value:.{digits}g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        text = f"{mantissa}\u00b710{str(int(exponent)).translate(_SUPERSCRIPTS)}"
    text = text.replace("-", "\u2212")
    return f"{text} {unit}" if unit else text
