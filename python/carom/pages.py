"""Pages to look at, in a notebook or in a browser."""

from __future__ import annotations

import html as markup
from os import PathLike
from pathlib import Path

from carom._arguments import path_text
from carom._errors import OutputError


class Page:
    """A page that holds all it needs: one text of HTML, which asks no network and no server.

    A notebook shows it in a frame of its own, also where it is exported or looked at by nbviewer.

    Attributes:
        html: the text.
        width: of the frame in a notebook, as HTML says it: "100%" or "900px".
        height: of the frame, in pixels.
    """

    def __init__(self, html: str, *, width: str = "100%", height: int = 640) -> None:
        self.html = html
        self.width = width
        self.height = height

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the page to a file, in the place of one that is there. Raises OutputError where it cannot be written."""
        place = path_text(path, "path")
        try:
            Path(place).write_text(self.html, encoding="utf-8")
        except OSError as error:
            raise OutputError(f"{place}: cannot write the page: {error.strerror}") from None

    def open(self) -> None:
        """Shows the page in the web browser, from a temporary file, which stays. Raises RuntimeError where there is no browser."""
        import tempfile
        import webbrowser

        with tempfile.NamedTemporaryFile("w", encoding="utf-8", prefix="carom-", suffix=".html", delete=False) as file:
            file.write(self.html)
        if not webbrowser.open(Path(file.name).as_uri()):
            raise RuntimeError(f"no web browser was found here; the page is {file.name}, which any browser shows")

    def _repr_html_(self) -> str:
        text = markup.escape(self.html)
        return (
            f'<iframe srcdoc="{text}" sandbox="allow-scripts allow-downloads" width="{markup.escape(self.width)}" '
            f'height="{self.height}" style="border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<carom.{type(self).__name__}, {len(self.html) / 1000:.0f} kB: save(path) writes it, open() shows it in a browser>"


class Player(Page):
    """A page that plays a run.

    An exact one computes every instant from the collisions. Another one draws straight lines between samples, says so at its top, and
    `why_not` is the reason. Both show the same disks as the simulation had.

    Attributes:
        exact: whether every instant is exact.
        why_not: the reason where it is not, half a sentence; else empty.
    """

    def __init__(self, html: str, exact: bool, why_not: str) -> None:
        super().__init__(html, height=760)
        self.exact = exact
        self.why_not = why_not

    def __repr__(self) -> str:
        how = "exact" if self.exact else f"interpolated between samples: {self.why_not}"
        return f"{super().__repr__()[:-1]}; {how}>"
