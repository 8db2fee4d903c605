#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws what happened around an exchange of code, from the trace of a run (deployer --trace FILE), as SVG on stdout.

usage: swap_timeline.py TRACE COMPONENT > timeline.svg
"""
import sys

WINDOW = 0.45  # [s] before and after the exchange
WIDTH, ROW, LEFT, TOP = 900, 34, 215, 58
COLOURS = {True: "#1f6fb4", False: "#c8501e"}


def read(path):
    """Returns the events of a trace as (time [s], words)."""
    with open(path, encoding="utf-8") as file:
        return [(float(words[0]), words[1:]) for words in (line.split() for line in file) if len(words) > 2]


def rows_of(events, component):
    """Returns what the component received, and what others received from it, by a text for people."""
    rows = {}
    for time, words in events:
        if words[0] != "deliver":
            continue
        _, receiver, port, _, kind, _, sender = words[:7]
        if receiver == component:
            rows.setdefault(f"{component}.{port} gets {kind}", []).append(time)
        elif sender == component:
            rows.setdefault(f"{receiver}.{port} gets {kind}", []).append(time)
    return rows


def draw(rows, exchange, component):
    """Returns the picture."""
    at, (_, _, was, now, pause) = exchange
    height = TOP + ROW * len(rows) + 44

    def x_of(time):
        return LEFT + (time - at + WINDOW) / (2 * WINDOW) * (WIDTH - LEFT - 20)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" '
           f'font-size="12"><rect width="{WIDTH}" height="{height}" fill="white"/>']
    out.append(f'<text x="{LEFT}" y="20" font-size="14">{component}: {was} gives way to {now}; '
               f'neither could work for {1e6 * float(pause):.0f} \u00b5s</text>')
    out.append(f'<text x="{x_of(at - WINDOW / 2)}" y="44" text-anchor="middle" fill="{COLOURS[True]}">{was}</text>')
    out.append(f'<text x="{x_of(at + WINDOW / 2)}" y="44" text-anchor="middle" fill="{COLOURS[False]}">{now}</text>')
    for number, (text, times) in enumerate(rows.items()):
        y = TOP + ROW * number
        out.append(f'<text x="{LEFT - 10}" y="{y + 16}" text-anchor="end">{text.replace(" gets ", ": ")}</text>')
        out.append(f'<line x1="{LEFT}" x2="{WIDTH - 20}" y1="{y + 12}" y2="{y + 12}" stroke="#ddd"/>')
        for time in times:
            if abs(time - at) <= WINDOW:
                out.append(f'<rect x="{x_of(time) - 1.5:.1f}" y="{y + 3}" width="3" height="18" '
                           f'fill="{COLOURS[time < at - float(pause)]}"/>')
    bottom = TOP + ROW * len(rows)
    out.append(f'<line x1="{x_of(at):.1f}" x2="{x_of(at):.1f}" y1="50" y2="{bottom}" stroke="black" stroke-dasharray="4 3"/>')
    for step in range(-4, 5):
        out.append(f'<text x="{x_of(at + step / 10):.1f}" y="{bottom + 20}" text-anchor="middle">{100 * step:+d}</text>')
    out.append(f'<text x="{WIDTH - 20}" y="{bottom + 38}" text-anchor="end">ms from the exchange</text></svg>')
    return "\n".join(out) + "\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    path, component = sys.argv[1:]
    events = read(path)
    exchanges = [event for event in events if event[1][0] == "exchange" and event[1][1] == component]
    if not exchanges:
        sys.exit(f"{path} has no exchange of {component}; run deployer --trace {path}, and orcactl swap {component} ...")
    sys.stdout.write(draw(rows_of(events, component), exchanges[0], component))


if __name__ == "__main__":
    main()
