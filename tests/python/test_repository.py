"""What a host of repositories reads: the citation file, the forms for issues, the workflows."""

import pathlib
import re

import pytest

yaml = pytest.importorskip("yaml", reason="PyYAML is not installed")
ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_the_citation_names_the_version_of_the_build():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    version = re.search(r"project\(carom VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert version and citation["version"] == version[1]
    assert citation["cff-version"] == "1.2.0" and citation["title"] and citation["authors"] and citation["license"] == "MIT"


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
