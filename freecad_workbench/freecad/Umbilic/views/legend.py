# SPDX-License-Identifier: LGPL-2.1-or-later
"""Legends, painted."""

from typing import Sequence, Tuple

from ..compat import QtCore, QtGui
from ..numbers import readable
from .colors import deviation_colors
from .image_node import painted
from .marks import paint_mark

_PAPER = QtGui.QColor(255, 255, 255, 225)
_INK = QtGui.QColor(30, 32, 36)
_FRAME = QtGui.QColor(170, 174, 180)
_MARGIN = 10


def _font(bold: bool = False) -> QtGui.QFont:
    font = QtGui.QFont("Sans")
    font.setPixelSize(12)
    font.setBold(bold)
    return font


def _width(texts: Sequence[str]) -> int:
    metrics = QtGui.QFontMetrics(_font(bold=True))
    return max(metrics.boundingRect(text).width() for text in texts) + 6


def _panel(painter: QtGui.QPainter, x: int, width: int, height: int, title: str) -> None:
    painter.setPen(_FRAME)
    painter.setBrush(_PAPER)
    painter.drawRoundedRect(QtCore.QRectF(x + 0.5, 0.5, width - 1, height - 1), 4, 4)
    painter.setPen(_INK)
    painter.setFont(_font(bold=True))
    painter.drawText(x + _MARGIN, _MARGIN + 11, title)
    painter.setFont(_font())




def deviation_legend(end: float, largest: float, tolerance: float, signed: bool) -> QtGui.QImage:
    """Colour bar with its unit, ticks and the tolerance's mark."""
    bar_width, bar_height, line = 18, 180, 18
    title = "Signed distance, mm" if signed else "Distance, mm"
    low = -end if signed else 0.0
    ticks = [low + (end - low) * i / 4 for i in range(5)]
    words = [readable(tick) for tick in ticks]
    if largest > end:
        words[-1] = f"\u2265 {words[-1]}"
        if signed:
            words[0] = f"\u2264 {words[0]}"
    marks = [value for value in ((-tolerance, tolerance) if signed else (tolerance,)) if 0 < tolerance <= end]
    off_scale = "" if tolerance <= end else " (off scale)"
    notes = [f"tolerance {readable(tolerance)}{off_scale}", f"largest {readable(largest)}"]
    width = 2 * _MARGIN + max(_width([title] + notes), bar_width + 14 + _width(words))
    top = 2 * _MARGIN + line
    height = top + bar_height + _MARGIN + len(notes) * line + 4

    def paint(painter: QtGui.QPainter) -> None:
        _panel(painter, 0, width, height, title)
        values = [end + (low - end) * i / (bar_height - 1) for i in range(bar_height)]
        for i, (red, green, blue) in enumerate(deviation_colors(values, end, signed)):
            color = QtGui.QColor.fromRgbF(float(red), float(green), float(blue))
            painter.fillRect(_MARGIN, top + i, bar_width, 1, color)

        def height_of(value: float) -> int:
            return top + round((end - value) / (end - low) * (bar_height - 1))

        painter.setPen(_INK)
        for tick, word in zip(ticks, words):
            y = height_of(tick)
            painter.drawLine(_MARGIN + bar_width, y, _MARGIN + bar_width + 4, y)
            painter.drawText(_MARGIN + bar_width + 10, y + 4, word)
        for value in marks:
            y = height_of(value)
            painter.setPen(QtGui.QPen(QtGui.QColor("white"), 4))
            painter.drawLine(_MARGIN, y, _MARGIN + bar_width, y)
            painter.setPen(QtGui.QPen(QtGui.QColor("#c00000"), 2))
            painter.drawLine(_MARGIN - 4, y, _MARGIN + bar_width + 4, y)
        for i, note in enumerate(notes):
            painter.setPen(QtGui.QColor("#c00000") if i == 0 else _INK)
            painter.drawText(_MARGIN, top + bar_height + _MARGIN + line * (i + 1) - 6, note)

    return painted(width, height, paint)


def text_legend(lines: Sequence[str]) -> QtGui.QImage:
    """A few lines of text, the first one bold."""
    width, height = 2 * _MARGIN + _width(lines), 2 * _MARGIN + 18 * len(lines)

    def paint(painter: QtGui.QPainter) -> None:
        _panel(painter, 0, width, height, lines[0])
        for i, text in enumerate(lines[1:], start=1):
            painter.drawText(_MARGIN, _MARGIN + 11 + 18 * i, text)

    return painted(width, height, paint)


def umbilics_legend(title: str, counts: Sequence[Tuple[str, int]], filled: bool, place: int) -> QtGui.QImage:
    """Marks by type with their numbers. `place` counts the legends to the left of this one."""
    line, size = 20, 17
    width = 2 * _MARGIN + max(_width([title]), 30 + _width([f"{kind}: {count}" for kind, count in counts]), 150)
    left = place * (width + 6)
    height = 2 * _MARGIN + line * (1 + len(counts))

    def paint(painter: QtGui.QPainter) -> None:
        _panel(painter, left, width, height, title)
        for i, (kind, count) in enumerate(counts, start=1):
            y = _MARGIN + line * i
            paint_mark(painter, kind, filled, left + _MARGIN + size / 2, y + line / 2, size)
            painter.setPen(_INK)
            painter.setFont(_font())
            painter.drawText(left + _MARGIN + 28, y + 15, f"{kind}: {count}")

    return painted(left + width, height, paint)
