"""The player and the report: made from memory and from files, shown in a frame, and played by a browser."""

from __future__ import annotations

import base64
import html as markup
import json
import os
import pickle
import re
import shutil
import signal
import subprocess
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.player import player_of, report_of

WITH_EVENTS = {"output.events": True}


def described(page: carom.Player) -> dict[str, Any]:
    """What the page says of its run."""
    found = re.search(r'<script type="application/json" id="description">(.*?)</script>', page.html, re.DOTALL)
    assert found
    return json.loads(found[1])


def column(page: carom.Player, name: str) -> np.ndarray[Any, Any]:
    """A column of numbers in the page."""
    found = re.search(r'<script type="text/plain" id="columns">(.*?)</script>', page.html, re.DOTALL)
    assert found
    entry = next(entry for entry in described(page)["columns"] if entry["name"] == name)
    dtype = np.dtype(entry["type"].removesuffix("Array").lower())
    return np.frombuffer(base64.b64decode(found[1]), dtype, entry["length"], entry["offset"])


def test_a_run_from_memory_and_from_files_is_the_same_page_but_for_its_facts(gas: carom.Scene, tmp_path: Path) -> None:
    scene = gas.set(WITH_EVENTS)
    carom.run(scene, out=tmp_path / "run")
    from_files, from_memory = player_of(tmp_path / "run"), carom.Simulation(scene).play(10.0)
    assert from_files.exact and from_memory.exact
    for name in ("start", "time", "disk", "partner", "velocity", "radius", "mass", "species"):
        assert column(from_memory, name).tobytes() == column(from_files, name).tobytes(), name
    one, other = described(from_memory), described(from_files)
    for key in ("facts", "Z", "distance"):  # of the whole run in its summary; of other samples
        del one[key], other[key]
    assert one == other


def test_playing_moves_the_simulation_as_run_until_does(gas: carom.Scene) -> None:
    played, twin = carom.Simulation(gas), carom.Simulation(gas)
    assert played.play(7.5).exact
    twin.run_until(7.5)
    assert (played.time, played.collisions, played.state_hash) == (7.5, twin.collisions, twin.state_hash)
    played.run_until(9.0)
    twin.run_until(9.0)
    assert played.state_hash == twin.state_hash


def test_changes_made_while_it_is_played_last() -> None:
    scene = carom.Scene.preset("box").set({"changes": [{"time": 0.5, "set": ["gravity.acceleration=[0, -0.7]"]}]})
    played, twin = carom.Simulation(scene), carom.Simulation(scene)
    played.play(1.0)
    twin.run_until(1.0)
    assert played.scene == twin.scene
    for simulation in (played, twin):
        simulation.set("tumbling", None)
        simulation.run_until(2.0)
    assert played.state_hash == twin.state_hash


def test_it_plays_what_the_simulation_records(gas: carom.Scene) -> None:
    events = carom.Simulation(gas).record(10.0)
    page = carom.Simulation(gas).play(10.0)
    assert np.array_equal(column(page, "time"), events["time"])
    assert np.array_equal(column(page, "disk"), events["disk"])


def test_it_begins_where_the_simulation_stands(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    sim.run_until(4.0)
    begin = sim.positions
    page = sim.play(6.0)
    assert page.exact
    assert described(page)["duration"] == 2.0
    assert np.array_equal(column(page, "start").reshape(-1, 2, 2)[:, 0], begin)


def test_an_earlier_time_shows_the_disks_where_they_are(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    sim.run_until(4.0)
    page = sim.play(1.0)
    assert (sim.time, described(page)["duration"], len(column(page, "time"))) == (4.0, 0.0, 0)


@pytest.mark.parametrize(
    "changes, options, reason",
    [
        ({"thermostat": {"temperature": 1.0, "rate": 0.5}}, {}, "thermostat"),
        ({"growth": {"rate": 0.01}}, {"begin": 1.0}, "the collisions in its log do not lead to its samples"),
        ({}, {"method": "guarded", "dt": 0.01}, "a fixed-step method has no collisions between two steps"),
    ],
)
def test_what_collisions_do_not_determine_is_drawn_between_samples(gas: carom.Scene, changes, options, reason) -> None:
    begin = options.pop("begin", 0.0)
    sim = carom.Simulation(gas.set(changes), **options)
    sim.run_until(begin)
    page = sim.play(begin + 5.0)
    assert not page.exact
    assert reason in page.why_not
    assert described(page)["whyNot"] == page.why_not
    times = column(page, "sampleTime")
    assert (times[0], times[-1]) == (0.0, 5.0)
    assert len(times) >= 1000


def test_growing_disks_are_exact_from_the_start(gas: carom.Scene) -> None:
    assert carom.Simulation(gas.set({"growth": {"rate": 0.01}})).play(5.0).exact


def test_more_collisions_than_a_page_holds_are_left_out(gas: carom.Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    from carom import _files

    monkeypatch.setattr(_files, "most_events_of_a_player", 10)
    sim, twin = carom.Simulation(gas), carom.Simulation(gas)
    page = sim.play(10.0)
    twin.run_until(10.0)
    assert page.why_not == "it has more than the 10 events that a page can hold"
    assert sim.state_hash == twin.state_hash


def test_ctrl_c_leaves_the_simulation_whole(gas: carom.Scene) -> None:
    sim = carom.Simulation(gas)
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim.play(1e7)
    stood = sim.time
    assert 0.0 < stood < 1e7
    twin = carom.Simulation(gas)
    twin.run_until(stood + 1.0)
    sim.run_until(stood + 1.0)
    assert sim.state_hash == twin.state_hash


def test_the_frame_of_a_notebook_holds_the_whole_page(gas: carom.Scene) -> None:
    page = carom.Simulation(gas).play(1.0)
    frame = page._repr_html_()
    found = re.fullmatch(r'<iframe srcdoc="([^"]*)" sandbox="allow-scripts allow-downloads" width="100%" height="760"[^>]*></iframe>', frame)
    assert found
    assert markup.unescape(found[1]) == page.html


def test_pages_are_saved_and_pickled(gas: carom.Scene, tmp_path: Path) -> None:
    page = carom.Simulation(gas.set({"title": "π < 4"})).play(1.0)
    page.save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == page.html
    again = pickle.loads(pickle.dumps(page))
    assert (again.html, again.exact) == (page.html, True)
    with pytest.raises(OSError):
        page.save(tmp_path / "nowhere" / "page.html")


def test_open_shows_a_file_with_the_page(gas: carom.Scene, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    import tempfile
    import webbrowser

    shown: list[str] = []
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(webbrowser, "open", lambda address: shown.append(address) or True)
    page = carom.Simulation(gas).play(1.0)
    page.open()
    assert Path(shown[0].removeprefix("file://")).read_text(encoding="utf-8") == page.html
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    with pytest.raises(RuntimeError, match="no web browser was found here; the page is .*html"):
        page.open()


def test_a_report_is_that_of_the_program(gas: carom.Scene, tmp_path: Path, program: Any) -> None:
    carom.run(gas.set(WITH_EVENTS), out=tmp_path / "run")
    assert program("report", tmp_path / "run").returncode == 0
    assert report_of(tmp_path / "run").html == (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert program("play", tmp_path / "run").returncode == 0
    assert player_of(tmp_path / "run").html == (tmp_path / "run" / "player.html").read_text(encoding="utf-8")


def test_a_directory_without_a_run_is_refused_in_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(carom.OutputError, match=str(tmp_path)):
        player_of(tmp_path)


#: Behind the scripts of the page: it tells the page around the frame what it is, lets it play, and tells it again.
_WATCH = """<script>
const tell = (what) => parent.postMessage(JSON.stringify({ what, time: carom.moment.time, errors: document.documentElement.dataset.errors,
                                                           exact: carom.description.exact, text: document.body.innerText }), "*");
tell("begin");
document.dispatchEvent(new KeyboardEvent("keydown", { key: " ", code: "Space", bubbles: true }));
setTimeout(() => tell("later"), 2000);
</script>
"""
_LISTEN = """<!doctype html><meta charset="utf-8"><body><pre id="heard"></pre><script>
addEventListener("message", (event) => {{ document.getElementById("heard").textContent += event.data + "\\n"; }});
</script>{frame}"""


@pytest.mark.skipif(shutil.which("chromium") is None, reason="chromium is not installed")
def test_the_frame_plays_in_a_browser(gas: carom.Scene, tmp_path: Path) -> None:
    page = carom.Simulation(gas).play(10.0)
    page.html = page.html.replace("</body>", _WATCH + "</body>")
    (tmp_path / "notebook.html").write_text(_LISTEN.format(frame=page._repr_html_()), encoding="utf-8")
    browser = ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
               "--disable-features=IsolateSandboxedIframes",  # else the frame has no part in the virtual time
               "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={tmp_path / 'profile'}", "--window-size=1000,900",
               "--virtual-time-budget=6000", "--dump-dom", (tmp_path / "notebook.html").as_uri()]  # fmt: skip
    dom = subprocess.run(browser, capture_output=True, text=True, timeout=120, env={**os.environ, "HOME": str(tmp_path)}).stdout
    heard = re.search(r'<pre id="heard">(.*?)</pre>', dom, re.DOTALL)
    assert heard
    begin, later = [json.loads(markup.unescape(line)) for line in heard[1].strip().split("\n")]
    assert begin["errors"] == later["errors"] == ""
    assert begin["exact"] and begin["text"].startswith("exact\n")  # the badge is the first that the page says
    assert begin["time"] == 0.0 < later["time"]
