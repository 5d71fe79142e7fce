"""How Sphinx makes the site of docs/: docs/site/build.py calls it, with the program in CAROM_PROGRAM.

Every page is the Markdown file that is also read on its own. What only the site has is added here while it is read: the contents of the
side bar, links to files outside of docs/, players in the gallery, and the references that are generated (generated.py).
"""

import os
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
DOCS = HERE.parent
ROOT = DOCS.parent
sys.path.insert(0, str(HERE))

import generated  # noqa: E402  (it is beside this file)

project = "Carom"
author = "the authors of Carom"
version = release = re.search(r"project\(carom VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "breathe"]
source_suffix = {".md": "markdown"}
root_doc = "index"
default_role = "code"
smartquotes = False  # two hyphens begin an option
nitpicky = False

myst_heading_anchors = 5
myst_enable_extensions = ["deflist"]
# A page may leave a level of headings out; each header of the library opens its namespace anew.
suppress_warnings = ["myst.header", "duplicate_declaration.cpp"]

napoleon_use_ivar = True  # what a class says of an attribute stands once
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_class_signature = "mixed"
breathe_projects = {"carom": os.environ.get("CAROM_DOXYGEN", "")}
breathe_default_project = "carom"
breathe_order_parameters_first = False

html_theme = "furo"
html_title = f"Carom {version}"
html_static_path = ["static"]
html_favicon = "static/icon.svg"
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_last_updated_fmt = None
html_show_search_summary = False  # summaries are fetched, which a browser does not allow for pages on a disk
html_theme_options = {"top_of_page_buttons": []}
highlight_language = "text"  # commands are not Python
pygments_style = "friendly"
pygments_dark_style = "monokai"

#: The side bar: captions and pages, in the order in which people come to want them.
CONTENTS = {
    "Start": ["tour", "install", "gallery"],
    "Tutorials": ["tutorials/first-gas", "tutorials/from-numpy", "tutorials/phase-diagram", "tutorials/granular-gas",
                  "tutorials/teaching", "tutorials/embedding"],
    "How-to guides": ["how-to", "sweeps", "long-runs", "playground", "player", "report", "movies", "python-files"],
    "Reference": ["scene-format", "reference/scene-keys", "reference/scenes", "effects/README", "observables", "output",
                  "reference/command-line", "python", "reference/python", "library", "reference/cpp", "notation", "glossary"],
    "Explanation": ["model", "algorithm", "numerics", "accuracy", "results", "validation", "hard-cases", "reliability", "performance", "parallel"],
    "Classroom": ["teach/README"],
    "Development": ["site/contributing", "architecture", "adding-an-effect", "adding-an-observable", "claims", "site/changes"],
    "Appendix": ["appendix/what-made-it-faster", "appendix/tried-without-gain", "appendix/event-graph"],
}
#: Pages whose side bar has the other pages of their folder below them.
FOLDERS = ["effects/README", "teach/README"]

#: A page that has no place yet comes last.
_placed = {page for pages in CONTENTS.values() for page in pages} | {root_doc}
_unplaced = [page for page in sorted(str(file.relative_to(DOCS).with_suffix("")) for file in DOCS.rglob("*.md"))
             if page not in _placed and f"{os.path.dirname(page)}/README" not in FOLDERS]
if _unplaced:
    CONTENTS["More"] = _unplaced

#: Pages that stand outside of docs/, or take the place of a folder.
ELSEWHERE = {
    ROOT / "README.md": "index",
    ROOT / "CONTRIBUTING.md": "site/contributing",
    ROOT / "CHANGELOG.md": "site/changes",
    DOCS / "scenes": "reference/scenes",
    DOCS / "examples": "library",
    DOCS / "effects": "effects/README",
    DOCS / "tutorials": "tutorials/first-gas",
    DOCS / "teach": "teach/README",
    ROOT / "tests/hard_cases": "hard-cases",
}
#: The text of these pages is that of a file outside of docs/.
COPIED = {"site/contributing": ROOT / "CONTRIBUTING.md", "site/changes": ROOT / "CHANGELOG.md"}


#: What build.py has made for the site to show.
PLAYERS = [name for name in os.environ.get("CAROM_PLAYERS", "").split(",") if name]
PLAYGROUND = os.environ.get("CAROM_PLAYGROUND", "")


def toctree(pages, caption=""):
    return "\n\n```{toctree}\n:hidden:\n" + (f":caption: {caption}\n" if caption else "") + "\n" + "\n".join(pages) + "\n```\n"


def rewrite_links(text, docname, stands_in):
    """Returns a page with its links to folders, and to pages outside of docs/, turned into those of the site."""
    def target(match):
        path, anchor = match.group(1), match.group(2) or ""
        file = (stands_in / path).resolve()
        page = ELSEWHERE.get(file)
        if page is None and docname in COPIED and DOCS in file.parents:
            page = str(file.relative_to(DOCS)).removesuffix(".md") if file.suffix == ".md" else None
            if page is None:
                return f"]({os.path.relpath(file, (DOCS / docname).parent)}{anchor})"
        if page is None:
            return match.group(0)
        return f"]({os.path.relpath(page, os.path.dirname(docname) or '.')}.md{anchor})"

    return re.sub(r"\]\((?!https?:|#|mailto:)([^()\s#]+)(#[^()\s]*)?\)", target, text)


def with_players(text):
    """Returns the gallery with its pictures as buttons: a press puts the player of that run in the picture's place."""
    def button(match):
        if match.group(2) not in PLAYERS:
            return match.group(0)
        return f'<a class="press-to-play" href="players/{match.group(2)}.html" title="Play it">\n\n{match.group(0)}\n\n</a>'

    return re.sub(r"^!\[([^\]]*)\]\(images/gallery/(\w+)\.png\)$", button, text, flags=re.M)


def with_dark_pictures(text):
    """Returns a page where each picture that has a dark version is followed by it: the theme shows the one that suits the screen."""
    def both(match):
        words, light, kind = match.groups()
        dark = f"{light}_dark.{kind}"
        if not (DOCS / dark).exists():
            return match.group(0)
        return "\n\n".join(f"```{{image}} {file}\n:alt: {words}\n:class: {screen}\n```"
                           for file, screen in ((f"{light}.{kind}", "only-light"), (dark, "only-dark")))

    return re.sub(r"^!\[([^\]]*)\]\((images/(?:gallery/)?\w+)\.(\w+)\)$", both, text, flags=re.M)


def live(docname):
    """What the start page and that of the playground show where there are live pages."""
    up = os.path.relpath(".", os.path.dirname(docname) or ".")
    buttons = []
    if PLAYGROUND:
        buttons.append(f'<a class="button" href="{up}/{PLAYGROUND}">Open the playground</a>')
    if "side_by_side" in PLAYERS:
        buttons.append(f'<a class="button" href="{up}/players/side_by_side.html#play">Play the film yourself</a>')
    return '<p class="buttons">' + " ".join(buttons) + "</p>" if buttons else ""


def with_playground(text, docname):
    """Returns a page with the addresses of the playground in it as links to the one of the site."""
    def link(match):
        address = match.group(2).replace("&", "&amp;")
        return f'<a href="{os.path.relpath(PLAYGROUND, os.path.dirname(docname) or ".")}{address}"><code>{match.group(1)}{address}</code></a>'

    return re.sub(r"`((?:playground\.html)?)(\?[\w=&.]+)`", link, text)


def on_source_read(app, docname, content):
    stands_in = COPIED[docname].parent if docname in COPIED else (DOCS / docname).parent
    text = COPIED[docname].read_text() if docname in COPIED else content[0]
    text = rewrite_links(text, docname, stands_in)
    if docname == "gallery":
        text = with_players(text)
    text = with_dark_pictures(text)
    if PLAYGROUND:
        text = with_playground(text, docname)
    text = text.replace("<!-- live pages -->", live(docname))
    if docname in generated.BELOW:
        text += generated.BELOW[docname]()
    if docname == root_doc:
        text += "".join(toctree(pages, caption) for caption, pages in CONTENTS.items())
    if docname in FOLDERS:
        folder = DOCS / os.path.dirname(docname)
        text += toctree(sorted(file.stem for file in folder.glob("*.md") if file.stem != "README"))
    content[0] = text


def setup(app):
    app.connect("source-read", on_source_read)
