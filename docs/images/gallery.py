#!/usr/bin/env python3
"""Draws the pictures of docs/gallery.md with the commands that stand there.

    docs/images/gallery.py path/to/carom [NAME...]

Needs python3-pil. Every command of the page that ends in `-o NAME.png ...` is run as it is, `carom` being the program named; the pictures,
of all names or of those given, go to docs/images/gallery, with a palette of 256 colours.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from PIL import Image

docs = pathlib.Path(__file__).resolve().parents[1]
carom = pathlib.Path(sys.argv[1]).resolve()
wanted = sys.argv[2:]
pictures = docs / "images" / "gallery"
pictures.mkdir(exist_ok=True)

lines = {re.search(r" -o (\w+)\.png", line).group(1): line
         for line in (docs / "gallery.md").read_text().splitlines() if line.startswith("carom run ") and ".png" in line}
with tempfile.TemporaryDirectory() as place:
    os.symlink(carom, pathlib.Path(place) / "carom")
    os.symlink(docs, pathlib.Path(place) / "docs")
    environment = dict(os.environ, PATH=f"{place}:{os.environ['PATH']}")
    for name, line in lines.items():
        if wanted and name not in wanted:
            continue
        subprocess.run(line, shell=True, check=True, cwd=place, env=environment)
        with Image.open(pathlib.Path(place) / f"{name}.png") as picture:
            picture.convert("RGB").quantize(256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(pictures / f"{name}.png", optimize=True)
print(f"{sum(file.stat().st_size for file in pictures.glob('*.png')) / 1e6:.2f} MB in {pictures}")
