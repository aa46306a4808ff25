"""Results, their reports and a headless Chromium that opens them: for check_report and make_screenshots."""
import json
import os
import random
import subprocess
import sys

sys.dont_write_bytecode = True

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAMS = os.path.join(ROOT, "build/devel/lib/uncertainty_identification")

TWO_DIMENSIONS_TRUTH = """
sample_time: 0.02
experiments: {count: 80, samples: 150}
input: {kind: prbs, variance: 4, hold: 2}
plant: {b: [0.2, 0.1], a: [-1.2, 0.5], delay: 1}
error_model:
  {taps: 2, constraint: free, weights: [0.6, 0.4], means: [[-0.25, 0.1], [0.3, -0.15]],
   covariances: [[[0.01, 0.004], [0.004, 0.006]], [[0.015, -0.006], [-0.006, 0.01]]]}
noise: {variance: 0.01}
"""
TWO_DIMENSIONS = """
nominal_model: {structure: output_error, nb: 2, na: 2, delay: 1}
error_model: {taps: 2, constraint: zero_mean, components: auto}
"""
ONE_EXPERIMENT_TRUTH = """
sample_time: 0.1
experiments: {count: 1, samples: 400}
plant: {b: [0.3], a: [-0.7], delay: 2}
noise: {variance: 0.01}
"""
ONE_EXPERIMENT = """
nominal_model: {structure: output_error, nb: 1, na: 1, delay: 2}
"""
DEAD_ZONE = """
nominal_model: {structure: output_error, nb: 1, na: 2, delay: 1}
error_model: {taps: 1, constraint: zero_mean, components: 1}
estimation: {initial_state: zero, offsets: none}
"""


def run(program, *arguments):
    subprocess.run([os.path.join(PROGRAMS, program), *arguments], check=True, stdout=subprocess.DEVNULL)


def written(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def make_report(folder, name, truth, configuration, validate):
    """Simulates, identifies and reports; returns the report's path."""
    base = os.path.join(folder, name)
    arguments = []
    for data, seed in (("data", "1"), ("validation", "2"))[: 2 if validate else 1]:
        run("simulate", "--config", truth, "--output", "%s_%s.csv" % (base, data), "--seed", seed)
    if validate:
        arguments = ["--validation", base + "_validation.csv"]
    run("identify", "--config", configuration, "--output", base + ".json", *arguments, "--", base + "_data.csv")
    run("report", "--output", base + ".html", base + ".json")
    return base + ".html"


def example1(folder):
    """The paper's Example 1: a mixture in one dimension, with validation."""
    config = os.path.join(ROOT, "config")
    return make_report(folder, "example1", os.path.join(config, "example1_truth.yaml"),
                       os.path.join(config, "example1.yaml"), True)


def two_dimensions(folder):
    """A mixture in two dimensions, its number of components chosen."""
    return make_report(folder, "two_dimensions", written(os.path.join(folder, "truth2.yaml"), TWO_DIMENSIONS_TRUTH),
                       written(os.path.join(folder, "two.yaml"), TWO_DIMENSIONS), False)


def one_experiment(folder):
    """One experiment: no error model."""
    return make_report(folder, "one_experiment", written(os.path.join(folder, "truth1.yaml"), ONE_EXPERIMENT_TRUTH),
                       written(os.path.join(folder, "one.yaml"), ONE_EXPERIMENT), False)


def without_bounds(folder):
    """The same without bounds, ended by the time limit; with an experiment left out whose name looks like markup."""
    with open(os.path.join(folder, "one_experiment.json"), encoding="utf-8") as file:
        result = json.load(file)
    result["bounds"] = {}
    result["termination"] = "time_limit"
    result["experiments"]["rejected"] = [{"id": "</script><b>bold</b>", "reason": "constant input"}]
    base = os.path.join(folder, "without_bounds")
    written(base + ".json", json.dumps(result))
    run("report", "--output", base + ".html", base + ".json")
    return base + ".html"


def prediction_errors(folder):
    """Each experiment of Example 1 by itself."""
    base = os.path.join(folder, "prediction_errors")
    run("identify", "--config", os.path.join(ROOT, "config/example1.yaml"), "--method", "pem", "--output", base + ".json",
        "--", os.path.join(folder, "example1_data.csv"))
    run("report", "--output", base + ".html", base + ".json")
    return base + ".html"


def dead_zone_data(path):
    """Experiments with a plant of order 2 whose actuator does not answer to commands below 0.4."""
    draw = random.Random(1)
    rows = ["experiment,t,u,y"]
    for run_number in range(1, 31):
        gain, u, passed, x = 0.15 * (1 + draw.gauss(0, 0.15)), 0.0, 0.0, [0.0, 0.0]
        for k in range(300):
            u = draw.uniform(-1.5, 1.5) if k % 8 == 0 else u
            x = [1.4 * x[0] - 0.55 * x[1] + gain * passed, x[0]]
            passed = max(u - 0.4, 0) + min(u + 0.4, 0)
            rows.append("run%02d,%.3f,%.6f,%.6f" % (run_number, 0.05 * k, u, x[0] + draw.gauss(0, 0.05)))
    return written(path, "\n".join(rows) + "\n")


def explained(folder):
    """What a simulation without the actuator's dead zone gets wrong."""
    base = os.path.join(folder, "explained")
    configuration, data = written(base + ".yaml", DEAD_ZONE), dead_zone_data(base + ".csv")
    run("identify", "--config", configuration, "--output", base + ".json", "--", data)
    run("explain", "--config", configuration, "--output", base + "_why.json", "--", data)
    run("report", "--output", base + ".html", base + ".json", base + "_why.json")
    return base + ".html"


def nothing_wrong(folder):
    """An explanation that finds nothing: Example 1."""
    base = os.path.join(folder, "nothing_wrong")
    run("explain", "--config", os.path.join(ROOT, "config/example1.yaml"), "--output", base + "_why.json", "--",
        os.path.join(folder, "example1_data.csv"))
    run("report", "--output", base + ".html", os.path.join(folder, "example1.json"), base + "_why.json")
    return base + ".html"


def open_browser():
    """A browser without a window, as wide as a laptop's, that remembers its console and what it fetched."""
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    options = Options()
    # no sandbox: Chromium has none as root, and it opens our own files only
    for switch in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--disable-dev-shm-usage",
                   "--window-size=1280,900", "--force-device-scale-factor=1"):
        options.add_argument(switch)
    options.binary_location = "/usr/bin/chromium"
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    browser.set_page_load_timeout(60)
    return browser
