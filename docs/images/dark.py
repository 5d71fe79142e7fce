#!/usr/bin/env python3
"""Writes the dark version of plots. On the site it stands in for the plot on dark pages, elsewhere no style sheet could turn colours.

    docs/images/dark.py NAME.svg...

NAME_dark.svg has the lines and points of NAME.svg in their colours, its black and grey in light grey, and no white ground.
"""
import pathlib
import re
import sys


def turned(match):
    """Returns a grey turned from a white ground to a dark one, #0d1117; a colour is made a little lighter."""
    parts = [int(match[1][k : k + 2], 16) for k in (0, 2, 4)]
    if max(parts) - min(parts) < 8:
        return "#" + "".join(f"{round(end + (230 - end) * (255 - part) / 255):02x}" for part, end in zip(parts, (13, 17, 23)))
    return "#" + "".join(f"{round(part + 0.3 * (255 - part)):02x}" for part in parts)


for name in sys.argv[1:]:
    light = pathlib.Path(name)
    text = re.sub(r"#([0-9a-f]{6})\b", turned, light.read_text())
    text = re.sub(r"<svg ", '<svg fill="#e6e6e6" ', text, count=1)  # letters have no colour of their own
    light.with_name(f"{light.stem}_dark.svg").write_text(text)
