"""What a host of repositories reads: the citation file, the forms for issues, the workflows; and the numbers of things that pages state."""

import re
import subprocess

import pytest
from conftest import PROGRAM, ROOT

yaml = pytest.importorskip("yaml", reason="PyYAML is not installed")


def test_the_citation_names_the_version_of_the_build():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    version = re.search(r"project\(carom VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert version and citation["version"] == version[1]
    assert citation["cff-version"] == "1.2.0" and citation["title"] and citation["authors"] and citation["license"] == "MIT"
    assert f"## [{version[1]}] - {citation['date-released']}\n" in (ROOT / "CHANGELOG.md").read_text()


def test_the_log_of_changes_names_the_format_of_checkpoints():
    format_now = re.search(r"checkpoint_format = (\d+);", (ROOT / "src/io/checkpoint.cpp").read_text())
    stated = re.search(r"Checkpoints of earlier builds are refused: their\s+format is (\d+)", (ROOT / "CHANGELOG.md").read_text())
    assert format_now and stated and stated[1] == format_now[1]


def test_the_log_of_changes_is_short_enough_to_be_read():
    lines = (ROOT / "CHANGELOG.md").read_text().splitlines()
    assert max(map(len, lines)) <= 120
    newest = [k for k, line in enumerate(lines) if line.startswith("## ")]
    assert newest[1] - newest[0] <= 150


@pytest.mark.parametrize("form", [form for form in sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml")) if form.stem != "config"],
                         ids=lambda form: form.stem)
def test_a_form_for_issues_has_what_a_form_needs(form):
    found = yaml.safe_load(form.read_text())
    assert found["name"] and found["description"]
    fields = [field["id"] for field in found["body"]]
    assert len(fields) == len(set(fields)) >= 3
    for field in found["body"]:
        assert field["type"] in ("textarea", "input", "dropdown", "checkboxes") and field["attributes"]["label"]


@pytest.mark.parametrize("workflow", sorted((ROOT / ".github/workflows").glob("*.yml")), ids=lambda workflow: workflow.stem)
def test_a_workflow_calls_what_is_there(workflow):
    jobs = yaml.safe_load(workflow.read_text())["jobs"]
    verbs = re.findall(r"^  ([a-z]+)\) ", (ROOT / "bootstrap").read_text(), re.M)
    for step in (step for job in jobs.values() for step in job["steps"]):
        command = step.get("run", "")
        if command.startswith("./bootstrap "):
            assert command.split()[1] in verbs
        elif command.startswith("."):
            assert (ROOT / command.split()[0]).is_file()


def test_addresses_of_the_playground_name_scenes_that_it_has():
    scenes = set(re.findall(r'^    id: "(\w+)"', (ROOT / "playground/scenes/scenes.js").read_text(), re.M))
    named = {name for page in (ROOT / "docs").rglob("*.md") for name in re.findall(r"[?&]scene=(\w+)", page.read_text())}
    assert len(scenes) > 20 and len(named) > 5
    assert named <= scenes


#: Pages of the product; the log of changes tells what was so at its time.
PAGES = [ROOT / "README.md", *sorted(page for page in (ROOT / "docs").rglob("*.md"))]


def stated(pattern):
    """Returns page and number wherever a page states a number of something."""
    return [(str(page.relative_to(ROOT)), int(number)) for page in PAGES for number in re.findall(rf"\b(\d+)\s+{pattern}", page.read_text())]


def test_pages_state_the_number_of_scenes_of_the_playground():
    scenes = re.findall(r'^    id: "\w+"', (ROOT / "playground/scenes/scenes.js").read_text(), re.M)
    found = [*stated(r"scenes\s+run\s+live"), *stated(r"scenes: gases")]
    assert len(found) >= 2
    assert {number for _, number in found} == {len(scenes)}, found


def test_the_page_of_validation_lists_every_check_of_every_trial():
    listed = subprocess.run([PROGRAM, "validate", "--list"], capture_output=True, text=True, check=True).stdout
    trials = [line for line in listed.splitlines() if line.startswith("  ") and "(--full)" not in line]
    page = (ROOT / "docs/validation.md").read_text()
    table = page.partition("## Every check of a quick validation")[2]
    judged = [line for line in table.splitlines() if line.startswith("| ") and not line.startswith("| what |") and "(not judged)" not in line]
    stated = re.findall(r"(\d+) trials, (\d+) checks", page) + [(m, n) for n, m in re.findall(r"(\d+) checks in (\d+) trials", table)]
    assert len(stated) == 2 and {(int(m), int(n)) for m, n in stated} == {(len(trials), len(judged))}


def test_no_page_counts_the_gallery():
    pictures = r"\b(?:\d+|[a-z]+(?:teen|ty)(?:-[a-z]+)?)\s+(?:pictures|players|scenes, each)"  # 31, nineteen, twenty-eight
    for page in ("README.md", "docs/index.md", "docs/tour.md", "docs/gallery.md", "docs/how-to.md", "docs/tutorials/teaching.md", "docs/site/conf.py"):
        assert not re.search(pictures, (ROOT / page).read_text(), re.I), page
    drawn = {picture.stem for picture in (ROOT / "docs/images/gallery").glob("*.png") if not picture.stem.endswith("_dark")}
    assert drawn == set(re.findall(r"images/gallery/(\w+?)(?:_dark)?\.png", (ROOT / "docs/gallery.md").read_text()))


def test_results_have_the_prices_of_accuracy():
    def rows(name):
        return [line.strip("|").split(" | ") for line in (ROOT / "docs" / name).read_text().splitlines() if re.match(r"\| .*\d to \d.*\)", line)]

    states = [(row[0], *row[1:4]) for row in rows("results.md") if "specular" in row[0] or "reversal" in row[0]]
    priced = [row[3].split(", dt")[0] for row in rows("accuracy.md") if len(row) == 6]
    assert len(states) == 4
    assert [price.strip() for _, *prices in states for price in prices] == priced
