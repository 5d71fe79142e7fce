"""The studies from Python have the numbers, sentences and errors of the program."""

import json
import os
import pickle
import re
import signal
import threading

import matplotlib
import numpy as np
import pytest

import carom

matplotlib.use("Agg")

#: What a clock measures, and what follows from it.
CLOCKS = ("seconds", "setup", "price", "sentence", "timed_until")


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """Twelve disks as a file: the program and Python read the same."""
    path = tmp_path_factory.mktemp("scene") / "gas.toml"
    path.write_text(
        'title = "Twelve disks"\n[box]\nx = [0.0, 6.0]\ny = [0.0, 4.0]\nboundary = "walls"\n'
        '[[disks]]\ncount = 12\nradius = 0.4\nmass = 1.0\npositions = "random"\nvelocities = { temperature = 1.0 }\n'
        '[collision]\nrule = "specular"\n[run]\ntime = 10.0\nsample_every = 0.25\n'
    )
    return path


@pytest.fixture(scope="module")
def comparison(scene):
    return carom.compare(scene, dts=0.01)


@pytest.fixture(scope="module")
def horizon(scene):
    return carom.horizon(scene, collisions=2000)


def without_clocks(value):
    """Leaves out what a clock has measured, all the way down."""
    if isinstance(value, dict):
        kept = {key: entry for key, entry in value.items() if not any(clock in key for clock in CLOCKS)}
        return {key: without_clocks(entry) for key, entry in kept.items()}
    return [without_clocks(entry) for entry in value] if isinstance(value, list) else value


def numbers_out(sentence):
    """Leaves out numbers, and what follows from a clock: the unit of a time, and the width of a column."""
    without = re.sub(r"[-+]?\d[\d.,e+-]*", "#", sentence)
    return re.sub(r" +", " ", re.sub(r"# (ns|µs|ms|s)\b", "# s", without))


def test_a_comparison_has_the_programs_numbers(comparison, scene, program, tmp_path):
    done = program("compare", scene, "--dt", "0.01", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    expected = json.loads((tmp_path / "out/compare.json").read_text())
    assert list(comparison.summary) == list(expected)
    for part in ("carom", "title", "disks", "packing_fraction", "complete", "plan", "horizon", "summary", "runs"):
        assert without_clocks(comparison.summary[part]) == without_clocks(expected[part]), part
    header = (tmp_path / "out/compare.csv").read_text().split("\n")[0].split(",")
    assert comparison.runs.columns == header
    assert comparison.runs["method"].tolist() == [run["method"] for run in expected["runs"]]
    assert comparison.runs["Z"].tolist() == [run["Z"] for run in expected["runs"]]
    # Which method is the cheapest depends on the clock, and so do words about it.
    assert numbers_out(str(comparison)).split("\n")[:6] == numbers_out(done.stdout).split("\n")[:6]
    assert comparison.sentences[0] in str(comparison)
    assert comparison.best_fixed_step == comparison.summary["best_fixed_step"]


@pytest.fixture(scope="module")
def two_runs(scene, tmp_path_factory):
    """The same disks by exact events and by fixed steps."""
    place = tmp_path_factory.mktemp("runs")
    exact = carom.run(scene, out=place / "exact", events=True)
    return exact, carom.run(scene, out=place / "steps", events=True, method="naive", dt=0.01)


def test_a_difference_has_the_programs_numbers(two_runs, program):
    exact, steps = two_runs
    found = carom.diff(steps, exact)
    told = program("diff", steps.directory, exact.directory, "--json")
    assert told.returncode == 1 and json.loads(told.stdout) == found.summary
    assert str(found) + "\n" == program("diff", steps.directory, exact.directory).stdout
    assert not found.same and found.sentence in found._repr_html_()
    assert found.distances["rms"][0] == 0.0 and (np.diff(found.distances["time"]) > 0).all()
    again = pickle.loads(pickle.dumps(found))
    assert again.summary == found.summary and str(again) == str(found)


def test_a_run_is_the_same_as_itself_however_it_is_named(two_runs):
    exact, _ = two_runs
    for other in (exact.directory, str(exact.directory), carom.open_run(exact.directory), exact.directory / "trajectory.h5md"):
        found = carom.diff(exact, other)
        assert found.same and "are the same run" in found.sentence
        assert not found.distances["largest"].any()


@pytest.mark.parametrize(
    "other, kind, sentence",
    [
        ("nowhere", carom.OutputError, "nowhere: "),
        (5, TypeError, "a run is 5; give a path"),
        (lambda scene: carom.run(scene), ValueError, 'this run has written no files; give it out="directory"'),
    ],
)
def test_what_is_no_run_is_refused(two_runs, scene, other, kind, sentence):
    with pytest.raises(kind, match=sentence) as raised:
        carom.diff(two_runs[0], other(scene) if callable(other) else other)
    assert "\n" not in str(raised.value)


def test_runs_of_other_disks_are_refused(two_runs, tmp_path):
    carom.run(carom.Scene.preset("box").set({"run.time": 0.01}), out=tmp_path / "box")
    with pytest.raises(carom.OutputError, match="the first has 12 disks and the second 64"):
        carom.diff(two_runs[0], tmp_path / "box")


def test_prices_of_a_comparison_are_a_table(comparison):
    prices = comparison.prices
    exact = prices["method"] == comparison.answers["exact"]
    of_errors = exact & np.char.startswith(prices["target"].astype(str), "error")
    assert of_errors.any() and (prices["ratio"][of_errors] == 1.0).all()
    stored = [price["ratio"] for price in comparison.summary["prices"] if price["ratio"] is not None]
    assert prices["ratio"][~np.isnan(prices["ratio"])].tolist() == stored


def test_a_spectrum_has_the_programs_numbers_and_pairs(scene, program):
    spectrum = carom.lyapunov_spectrum(scene, collisions=2000)
    expected = json.loads(program("horizon", scene, "--spectrum", "--collisions", "2000", "--json", "--quiet").stdout)
    assert spectrum.summary["lyapunov_spectrum"] == expected["lyapunov_spectrum"]
    exponents = spectrum.exponents["exponent"]
    assert len(exponents) == 4 * expected["disks"] and np.all(np.diff(exponents) <= 0)
    assert np.max(np.abs(exponents + exponents[::-1])) == spectrum.pairing < 1e-9 * spectrum.collision_rate
    assert spectrum.entropy.value == pytest.approx(exponents[exponents > 0].sum(), rel=1e-9)
    assert "Kolmogorov-Sinai" in str(spectrum) and "<table>" in spectrum._repr_html_()
    assert "1 / time" in spectrum.plot().get_ylabel()
    assert pickle.loads(pickle.dumps(spectrum)).entropy == spectrum.entropy


def test_what_studies_show(comparison, horizon):
    html = comparison._repr_html_()
    assert html.startswith("<p>") and "<table>" in html and comparison.runs.rows >= 5
    axes = comparison.plot()
    assert axes.get_xscale() == axes.get_yscale() == "log"
    drawn = {line.get_label() for line in axes.get_lines()}
    assert {"naive", "grid", "textbook"} <= drawn
    assert "<table>" in horizon._repr_html_() and horizon.sentence in str(horizon)
    assert "bits" in horizon.plot().get_xlabel()
    matplotlib.pyplot.close("all")


def test_labels_of_plots_cover_nothing_and_stay_in_the_picture(comparison, horizon):
    axes = comparison.plot()
    axes.figure.canvas.draw()
    legend = axes.get_legend().get_window_extent()
    points = np.concatenate([axes.transData.transform(line.get_xydata()) for line in axes.get_lines()])
    assert not any(legend.contains(*point) for point in points)
    assert axes.figure.bbox.containsx(legend.x1) and axes.figure.bbox.containsy(legend.y0) and axes.figure.bbox.containsy(legend.y1)
    axes = horizon.plot()
    axes.figure.canvas.draw()
    labels = [text.get_window_extent() for text in axes.texts]
    assert len(labels) == 5 and all(axes.bbox.containsx(label.x0) and axes.bbox.containsx(label.x1) for label in labels)
    assert not any(one.overlaps(other) for k, one in enumerate(labels) for other in labels[:k])
    matplotlib.pyplot.close("all")


def test_studies_pickle(comparison, horizon):
    assert pickle.loads(pickle.dumps(comparison)).summary == comparison.summary
    assert pickle.loads(pickle.dumps(horizon)).sentence == horizon.sentence


def test_a_horizon_has_the_programs_numbers(horizon, scene, program):
    expected = json.loads(program("horizon", scene, "--collisions", "2000", "--json", "--quiet").stdout)
    assert without_clocks(horizon.summary) == without_clocks(expected)
    assert numbers_out(horizon.sentence) == numbers_out(expected["sentence"])
    rows = expected["horizon"]["rows"]
    assert horizon.rows["time"].tolist() == [row["time"] for row in rows]
    assert horizon.rows["estimated"].tolist() == [row["estimated"] for row in rows]
    exponent = expected["horizon"]["lyapunov"]
    assert (horizon.lyapunov.value, horizon.lyapunov.error) == (exponent["per_time"], exponent["per_time_error"])
    # 24 bits are right for less time than 53, and those for less than 113.
    right = dict(zip(horizon.rows["engine"], horizon.rows["time"], strict=True))
    assert right["textbook-float"] < right["textbook"] < right["textbook-quad"]


def test_a_page_of_two_sides(scene):
    page = carom.beside(scene, "naive:0.02")
    assert isinstance(page, carom.Page) and "naive" in page.html and "<iframe" in page._repr_html_()


def test_a_page_of_soft_disks_depends_on_their_stiffness(scene):
    pages = {carom.beside(scene, "soft:0.001", stiffness=stiffness).html for stiffness in (1e4, 2e4, 2e4)}
    assert len(pages) == 2


def test_studies_have_the_programs_pages(comparison):
    page = comparison.page()
    assert isinstance(page, carom.Page) and page.html.startswith("<!doctype html>")
    assert carom.validate(only="grid-0.02").page().html.startswith("<!doctype html>")


def test_a_validation_has_the_programs_numbers(program, tmp_path):
    trial = "grid-0.02"
    done = program("validate", "--only", trial, "--json", "--quiet", "--out", tmp_path / "out")
    expected = json.loads(done.stdout)
    validation = carom.validate(only=[trial])
    assert without_clocks(validation.summary) == {**without_clocks(expected), "command_line": ""}
    checks = [check for one in expected["trials"] for check in one["checks"]]
    assert np.array_equal(validation.checks["z"], np.array([check["z"] for check in checks], dtype=float), equal_nan=True)
    assert validation.checks["holds"].tolist() == [check["holds"] for check in checks]
    assert set(validation.checks["verdict"]) <= {"agrees", "fails, as it must", "consistent (not judged)", "differs (not judged)"}
    assert validation.passed and validation.failed == 0 and validation.complete
    assert trial in carom.validation_trials() and set(carom.validation_trials()) < set(carom.validation_trials(full=True))
    assert "all hold" in validation.sentence and validation.sentence in validation._repr_html_()


def test_a_validation_runs_on_as_many_threads_as_asked_for_and_finds_the_same():
    def found_by(threads):
        running = []
        validation = carom.validate(
            only=["equipartition-walls", "grid-0.02", "grid-0.004"], threads=threads, progress=lambda fraction: running.append(len(os.listdir("/proc/self/task")))
        )
        return without_clocks(validation.summary), max(running)

    (one, few), (three, more) = found_by(1), found_by(3)
    assert one == three and more == few + 2


def test_hard_cases_have_the_programs_verdicts(program):
    names = ["all_at_rest", "gap_of_one_ulp"]
    table = carom.hardcases(names)
    expected = json.loads(program("hardcases", *names, "--json").stdout)["cases"]
    assert table["case"].tolist() == names
    assert table["verdict"].tolist() == [case["verdict"] for case in expected] == ["holds"] * len(names)
    assert table["checks"].tolist() == [len(case["checks"]) for case in expected]
    assert "all hold" in table.title


def test_a_hard_case_of_ones_own_may_fail(tmp_path):
    own = tmp_path / "own.toml"
    own.write_text(
        'title = "Two disks meet twice"\n[case]\nfamily = "contact"\nwhy = "they do not"\nsource = "nowhere"\n[expect]\npair = 2\n'
        '[box]\nx = [0.0, 10.0]\ny = [0.0, 2.0]\nboundary = "walls"\n'
        "[[disks]]\nradius = 0.5\nmass = 1.0\npositions = [[2.0, 1.0], [8.0, 1.0]]\nvelocities = [[1.0, 0.0], [-1.0, 0.0]]\n"
        '[collision]\nrule = "specular"\n[run]\ntime = 3.0\n'
    )
    table = carom.hardcases(own, engine="fast")
    assert table["verdict"].tolist() == ["FAILS"] and "1 in place of 2" in table["nearest_to_its_bound"][0]


@pytest.mark.parametrize(
    ("study", "sentence"),
    [
        (lambda scene: carom.compare(scene, seeds=0), "seeds=0: it can be 1 to 10000"),
        (lambda scene: carom.compare(scene, dts=-1.0), "dts=-1: a time step must be positive and finite"),
        (lambda scene: carom.compare(scene, dts=[0.1, float("nan")]), "dts=nan: a time step must be positive and finite"),
        (lambda scene: carom.compare(scene, longest=0), "longest=0: a run takes some time; give a positive number"),
        (lambda scene: carom.compare(scene, stiffness=0), "stiffness=0: it must be positive and finite"),
        (lambda scene: carom.compare(scene, dts=0.1, stiffness=1e5), "stiffness=100000: a time step of 0.1 is unstable with a"),
        (lambda scene: carom.compare(scene, engine="slow"), "engine=slow: there is no such engine; choose auto or one of: fast"),
        (lambda scene: carom.compare(scene, engine="textbook-quad"), "engine=textbook-quad: every precision is compared anyway"),
        (lambda scene: carom.compare(scene, dts=0.1, stiffness=1e9), "stiffness=1e+09: "),
        (lambda scene: carom.beside(scene, "naive:0.01", stiffness=1e4), 'a stiffness is that of the springs of method="soft"'),
        (lambda scene: carom.beside(scene, "soft:0.1", stiffness=1e9), "method=soft:0.1: "),
        (lambda scene: carom.horizon(scene, collisions=0), "collisions=0: an exponent needs some collisions"),
        (lambda scene: carom.lyapunov_spectrum(scene, collisions=0), "collisions=0: an exponent needs some collisions"),
        (
            lambda scene: carom.lyapunov_spectrum({**scene, "disks": [{**scene["disks"][0], "count": 300, "radius": 0.01}]}),
            "has 300 disks, and the exponents of at most 256 are measured",
        ),
        (lambda scene: carom.horizon(scene, engine="slow"), "engine=slow: there is no such engine"),
        (lambda scene: carom.beside(scene, "nave"), 'method=nave: there is no fixed-step method "nave"; choose one of naive'),
        (lambda scene: carom.beside(scene, "naive:soon"), "method=naive:soon: after the colon stands a time step"),
        (lambda scene: carom.beside(scene, "naive:100"), "method=naive:100: the scene's run ends at time 10, within"),
        (
            lambda scene: carom.beside({**scene, "gravity": {"acceleration": (0, -1)}}),
            "the page shows disks on which nothing acts but the collision rule, and this scene asks for gravity",
        ),
        (lambda scene: carom.validate(only="presure"), "only=presure: there is no such trial and no such group; carom.validation_trials() names"),
        (lambda scene: carom.validate(seed=10**13), "seed=10000000000000: it can be 0 to 9000000000000"),
        (lambda scene: carom.validate(seed=-1), "seed is -1; it must be from 0"),
        (lambda scene: carom.validate(threads=0), "threads is 0; it must be from 1 to 4096"),
        (lambda scene: carom.compare(scene, seeds="many"), "seeds is 'many'; give a whole number"),
        (lambda scene: carom.compare(scene, stiffness="stiff"), "stiffness is 'stiff'; give a number"),
        (lambda scene: carom.compare(scene, dts="long"), "dts: an array of <U4 is given; give real numbers"),
        (lambda scene: carom.horizon(scene, engine=None), "engine is None; give a string"),
        (lambda scene: carom.hardcases("no_case"), "no_case: there is no such case; carom.hard_case_names() names them all"),
        (lambda scene: carom.hardcases(engine="slow"), "engine=slow: there is no such engine"),
    ],
)
def test_wrong_arguments_are_refused_in_one_sentence(scene, study, sentence):
    tables = carom.Scene.load(scene).to_dict()
    with pytest.raises((ValueError, TypeError), match=re.escape(sentence)) as caught:
        study(tables)
    assert "\n" not in str(caught.value) and "--" not in str(caught.value)


@pytest.mark.parametrize("study", ["compare", "horizon"])
def test_what_a_study_does_not_know_is_refused_as_by_the_program(scene, program, study):
    change = ("--set", "shear.rate=0.1", "--set", "box.boundary=\"periodic\"")
    refused = program(study, scene, *change)
    assert refused.returncode == 2 and "shear" in refused.stderr
    sheared = carom.Scene.load(scene, [override for override in change if override != "--set"])
    with pytest.raises(ValueError, match="shear") as caught:
        getattr(carom, study)(sheared)
    assert refused.stderr.strip() == f"carom: {caught.value}"


def test_springs_have_the_stiffness_that_is_given(scene):
    assert carom.compare(scene, dts=1e-3, stiffness=1e5).summary["plan"]["stiffness"] == 1e5


def interrupted_at(call):
    """Calls with a progress that sends Ctrl-C as soon as the study has begun, and returns what came out."""
    told = []

    def tell(fraction):
        if not told:
            threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
        told.append(fraction)

    with pytest.raises(KeyboardInterrupt) as caught:
        call(tell)
    assert told and all(0.0 <= fraction <= 1.0 for fraction in told)
    return caught.value


@pytest.mark.parametrize(
    "study",
    [
        lambda tell: carom.compare(carom.Scene.preset("box"), progress=tell),
        lambda tell: carom.horizon(carom.Scene.preset("box"), collisions=10**9, progress=tell),
        lambda tell: carom.beside(carom.Scene.preset("box"), progress=tell),
        lambda tell: carom.hardcases(carom.hard_case_names(), progress=tell),
    ],
    ids=["compare", "horizon", "beside", "hardcases"],
)
def test_ctrl_c_ends_a_study(study):
    interrupted_at(study)


def test_ctrl_c_keeps_the_finished_trials_of_a_validation():
    result = interrupted_at(lambda tell: carom.validate(full=True, progress=tell)).result
    assert isinstance(result, carom.Validation) and not result.complete and not result.passed


def test_what_progress_raises_comes_out(scene):
    def broken(fraction):
        raise RuntimeError("it broke")

    for study in (
        lambda: carom.compare(scene, progress=broken),
        lambda: carom.horizon(scene, progress=broken),
        lambda: carom.validate(progress=broken),
        lambda: carom.hardcases(progress=broken),
    ):
        with pytest.raises(RuntimeError, match="it broke"):
            study()


def test_studies_run_side_by_side(scene):
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(2) as pool:
        one, other = pool.map(lambda _: carom.horizon(scene, collisions=2000), range(2))
    assert without_clocks(one.summary) == without_clocks(other.summary)


def test_a_validation_is_said_to_take_as_long_as_the_program_says(program):
    told = " ".join(program("help", "validate").stdout.split()).lower()
    for time in ("one to two minutes on two cores", "one to two hours"):
        assert time in told and time in " ".join(carom.validate.__doc__.split())
    assert len(carom.validation_trials(full=True)) - len(carom.validation_trials()) == 7
