# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours as people see them: contrast, difference, and what eyes see whose cones for green or red are missing.

A colour is (red, green, blue), each 0 to 255, in sRGB.
"""
import math

# Machado, Oliveira, Fernandes: A Physiologically-based Model for Simulation of Color Vision Deficiency, IEEE TVCG 15(6), 2009,
# severity 1.0; for linear RGB.
VISIONS = {
    "all cones": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "protanopia": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
    "deuteranopia": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
}
# sRGB to XYZ, D65 (IEC 61966-2-1).
TO_XYZ = ((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505))
WHITE = (0.9505, 1.0, 1.089)


def read_colour(text):
    """Reads #rrggbb or rgba(r, g, b, a), whose a is left out."""
    text = text.strip()
    if text.startswith("#"):
        return tuple(int(text[i:i + 2], 16) for i in (1, 3, 5))
    return tuple(float(word) for word in text[text.index("(") + 1:-1].split(",")[:3])


def times(matrix, vector):
    return tuple(sum(a * b for a, b in zip(row, vector)) for row in matrix)


def linear(colour):
    shares = (each / 255 for each in colour)
    return tuple(each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4 for each in shares)


def contrast(one, other):
    """Returns the contrast ratio of WCAG 2.2, from 1 to 21."""
    dark, light = sorted(times(TO_XYZ, linear(colour))[1] for colour in (one, other))
    return (light + 0.05) / (dark + 0.05)


def lab(rgb):
    """Returns CIELAB of a linear colour."""
    def bend(share):
        return share ** (1 / 3) if share > 216 / 24389 else (24389 / 27 * share + 16) / 116
    x, y, z = (bend(max(0.0, each) / white) for each, white in zip(times(TO_XYZ, rgb), WHITE))
    return (116 * y - 16, 500 * (x - y), 200 * (y - z))


def difference(one, other, vision):
    """Returns how far apart two colours are for eyes of VISIONS, as a distance in CIELAB (CIE 1976)."""
    return math.dist(*(lab(tuple(min(1.0, max(0.0, each)) for each in times(VISIONS[vision], linear(colour)))) for colour in (one, other)))
