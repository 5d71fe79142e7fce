#!/usr/bin/env python3
"""Draws the pictures of docs/gallery.md with the commands that stand there.

    docs/images/gallery.py path/to/carom [--dark] [NAME...]

Needs python3-pil. Every command of the page that ends in `-o NAME.png ...` is run as it is, `carom` being the program named, and its
film command once more with `--dark`. The pictures, of all names or of those given, go to docs/images/gallery as NAME.png, with a palette
of 256 colours, and as NAME_dark.png, with one of 64; with `--dark` the dark ones alone.
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
is_dark_alone = "--dark" in sys.argv
wanted = [word for word in sys.argv[2:] if word != "--dark"]
pictures = docs / "images" / "gallery"
pictures.mkdir(exist_ok=True)


def keep(file, name, colours):
    with Image.open(file) as picture:
        few = picture.convert("RGB").quantize(colours, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
        few.save(pictures / f"{name}.png", optimize=True)


lines = {re.search(r" -o (\w+)\.png", line).group(1): line
         for line in (docs / "gallery.md").read_text().splitlines() if line.startswith("carom run ") and ".png" in line}
with tempfile.TemporaryDirectory() as place:
    os.symlink(carom, pathlib.Path(place) / "carom")
    os.symlink(docs, pathlib.Path(place) / "docs")
    environment = dict(os.environ, PATH=f"{place}:{os.environ['PATH']}")
    for name, line in lines.items():
        if wanted and name not in wanted:
            continue
        run, film = line.split(" && ")
        for command in [run] + ([] if is_dark_alone else [film]) + [f"{film.replace(f' {name}.png', f' {name}_dark.png')} --dark"]:
            subprocess.run(command, shell=True, check=True, cwd=place, env=environment)
        if not is_dark_alone:
            keep(pathlib.Path(place) / f"{name}.png", name, 256)
        keep(pathlib.Path(place) / f"{name}_dark.png", f"{name}_dark", 64)
print(f"{sum(file.stat().st_size for file in pictures.glob('*.png')) / 1e6:.2f} MB in {pictures}")
