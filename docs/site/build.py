#!/usr/bin/env python3
"""Makes the site of docs/ in a directory: what ./bootstrap site calls.

    docs/site/build.py --carom build/release/carom --python build/release/python --output build/site [--playground FILE] [--players NAME,...]

The players of the gallery are made by `carom run` and `carom play` and kept in OUTPUT-work for the next time. A warning of Sphinx is an
error, and so is a link inside the site that leads nowhere.
"""
import argparse
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
DOCS = HERE.parent
ROOT = DOCS.parent

# In comments <x> is a mean, and no tag.
DOXYFILE = f"""
PROJECT_NAME = Carom
INPUT = {ROOT}/include/carom
RECURSIVE = YES
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
EXCLUDE_SYMBOLS = carom::detail*
JAVADOC_AUTOBRIEF = YES
MACRO_EXPANSION = YES
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
INPUT_FILTER = "sed -E ':a;s,(///.*)<([a-z]+)>,\\1\\&lt;\\2\\&gt;,;ta'"
"""


def say(text):
    print(f"site: {text}", file=sys.stderr, flush=True)


def run(*words, **more):
    subprocess.run([str(word) for word in words], check=True, **more)


def gallery_runs():
    """Returns the command that runs each scene of the gallery, by the name of its picture."""
    lines = re.findall(r"^(carom run docs/scenes/.*?) && carom movie (\w+) -o (\w+)\.png", (DOCS / "gallery.md").read_text(), re.M)
    return {name: (command, directory) for command, directory, name in lines}


def make_players(carom, work, output, wanted):
    """A page for each picture of the gallery, and one of exact events beside fixed steps; or those that are wanted alone."""
    players, version = output / "players", subprocess.run([carom, "--version"], capture_output=True, check=True).stdout
    players.mkdir(parents=True, exist_ok=True)
    kept = work / "players"
    kept.mkdir(parents=True, exist_ok=True)
    runs = gallery_runs()
    commands = {name: f"{command} && carom play {directory} -o {name}.html" for name, (command, directory) in runs.items()}
    beside = "carom compare docs/images/accuracy_moderate.toml --dt 0.02 --time 3 --longest 0.02 --no-costs --play guarded:0.02 --out beside -q"
    commands["side_by_side"] = f"{beside} && mv beside/side_by_side.html side_by_side.html"
    commands = {name: command for name, command in commands.items() if wanted is None or name in wanted}
    for name, command in commands.items():
        scene = (ROOT / re.search(r"docs/\S+\.toml", command).group(0)).read_bytes()
        key = hashlib.sha256(version + command.encode() + scene).hexdigest()[:16]
        page = kept / f"{name}-{key}.html"
        if not page.exists():
            place = work / "runs" / name
            shutil.rmtree(place, ignore_errors=True)
            place.mkdir(parents=True)
            (place / "docs").symlink_to(DOCS)
            (place / "carom").symlink_to(carom)
            run("sh", "-c", command, cwd=place, env={**os.environ, "PATH": f"{place}:{os.environ['PATH']}"}, stdout=subprocess.DEVNULL)
            shutil.move(place / f"{name}.html", page)
            shutil.rmtree(place)
        shutil.copy(page, players / f"{name}.html")
    return sorted(commands)


def check_links(output):
    """Returns a line for each link between pages, and to files of the site, that leads nowhere."""
    pages = {page: page.read_text(errors="replace") for page in output.rglob("*.html") if "players" not in page.parts and "play" not in page.parts}
    anchors = {page: set(re.findall(r'\b(?:id|name)="([^"]+)"', text)) for page, text in pages.items()}
    faults = []
    for page, text in pages.items():
        for link in set(re.findall(r'\b(?:href|src|srcset)="([^"]+)"', text)):
            if re.match(r"(https?:|mailto:|data:|javascript:)", link):
                continue
            path, _, anchor = link.partition("#")
            path = path.partition("?")[0].replace("%20", " ").replace("&amp;", "&")
            target = (page.parent / path).resolve() if path else page
            if not target.is_file():
                faults.append(f"{page.relative_to(output)}: {link} leads nowhere")
            elif anchor and target in anchors and anchor not in anchors[target] and anchor != "top":
                faults.append(f"{page.relative_to(output)}: {link}: there is no such place on that page")
    return sorted(faults)


def network_links(output):
    """Returns a line for each script, style, font or picture that a page would load from the network."""
    faults = []
    for page in output.rglob("*.html"):
        for tag in re.findall(r'<(?:script|link|img|iframe|source)\b[^>]*?\b(?:src|href|srcset)="https?:[^"]*"[^>]*>', page.read_text(errors="replace")):
            if 'rel="canonical"' not in tag:
                faults.append(f"{page.relative_to(output)}: {tag}")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--carom", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--python", type=pathlib.Path, required=True, help="the directory that holds the Python package carom")
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--playground", type=pathlib.Path, help="playground.html, to be put into the site")
    parser.add_argument("--players", help="make the players of these pictures of the gallery alone: dilute_gas,galperin")
    options = parser.parse_args()
    output, carom = options.output.resolve(), options.carom.resolve()
    work = output.with_name(output.name + "-work")
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir(parents=True)
    work.mkdir(exist_ok=True)

    environment = {**os.environ, "CAROM_PROGRAM": str(carom), "PYTHONPATH": str(options.python.resolve()), "PYTHONDONTWRITEBYTECODE": "1",
                   "CAROM_DOXYGEN": str(work / "doxygen/xml")}
    say("making the players of the gallery")
    environment["CAROM_PLAYERS"] = ",".join(make_players(carom, work, output, options.players.split(",") if options.players else None))
    if options.playground:
        (output / "play").mkdir()
        shutil.copy(options.playground, output / "play/playground.html")
        environment["CAROM_PLAYGROUND"] = "play/playground.html"
    say("reading the headers of the library")
    (work / "doxygen").mkdir(exist_ok=True)
    run("doxygen", "-", input=(DOXYFILE + f"OUTPUT_DIRECTORY = {work}/doxygen\n").encode(), stdout=subprocess.DEVNULL)
    say("making the pages")
    run(sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-E", "-b", "html", "-d", work / "doctrees", "-c", HERE, DOCS, output, env=environment)
    (output / ".nojekyll").touch()  # hosts that leave out directories which begin with an underscore then keep them
    (output / ".buildinfo").unlink(missing_ok=True)
    faults = check_links(output) + network_links(output)
    if faults:
        sys.exit("\n".join(faults))
    size = sum(file.stat().st_size for file in output.rglob("*") if file.is_file())
    say(f"{output}/index.html is ready: {len(list(output.rglob('*.html')))} pages, {size / 1e6:.1f} MB; no network is needed")


if __name__ == "__main__":
    main()
