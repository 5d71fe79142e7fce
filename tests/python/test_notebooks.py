"""The notebooks of docs/python and of the classroom sheets run from top to bottom, and show what they say."""

import os
import pathlib

import pytest

import carom

nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed")
nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed")
pytest.importorskip("ipykernel", reason="ipykernel is not installed")

DOCS = pathlib.Path(__file__).parents[2] / "docs"
NOTEBOOKS = sorted([*(DOCS / "python").glob("*.ipynb"), *(DOCS / "teach").glob("*.ipynb")])


def outputs(cell, kind):
    return [output["data"][kind] for output in cell.get("outputs", []) if kind in output.get("data", {})]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(pathlib.Path(carom.__file__).parents[1]))
    monkeypatch.delenv("MPLBACKEND", raising=False)  # a notebook has a backend of its own, which shows pictures
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    assert all(not cell.get("outputs") for cell in notebook.cells), "notebooks are kept without outputs"
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    players = [html for cell in code for html in outputs(cell, "text/html") if "<iframe" in html]
    pictures = [picture for cell in code for picture in outputs(cell, "image/png")]
    if path.parent.name == "teach":
        assert len(players) >= 1 and len(pictures) >= 1
    else:
        assert len(players) >= 2 and len(pictures) >= 3
    # What a browser shows can be looked at: `jupyter nbconvert --to html` of this file.
    kept = os.environ.get("CAROM_NOTEBOOKS")
    if kept:
        nbformat.write(notebook, pathlib.Path(kept) / path.name)
