#!/usr/bin/env python3
"""Your simulation with what recorded data say that it lacks; written by explain --write-extended.

    python3 extended_simulation.py --check [RUNS.csv]
compares it with the runs that were held out (held_out.csv beside this file), or with others that have the same
columns, and says whether it fits them as reported. Without arguments it is a program for explain's
`simulation: {command: [python3, extended_simulation.py]}`: it answers lines of JSON. Imported,
`extended(u, sample_time, covariates)` is its output. It needs Python 3 alone.
"""
import bisect
import csv
import json
import math
import os
import subprocess
import sys

FOUND = json.loads(r"""
@FOUND@
""")


class Program:
    """Your program, started once; it reads and writes lines of JSON."""

    process = None

    @classmethod
    def output(cls, u, sample_time, covariates, parameters):
        if cls.process is None:
            cls.process = subprocess.Popen(FOUND["command"], cwd=FOUND["folder"], text=True,
                                           stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        request = {"sample_time": sample_time, "u": u, "covariates": covariates, "parameters": parameters}
        cls.process.stdin.write(json.dumps(request) + "\n")
        cls.process.stdin.flush()
        line = cls.process.stdout.readline()
        if not line:
            raise SystemExit(f"{FOUND['command'][0]} ended without an answer")
        return [math.nan if value is None else value for value in json.loads(line)["y"]]


def through(curve, x):
    """A curve at x: linear between its points, and beyond the ends as in the first and the last piece."""
    signal, value = curve["signal"], curve["value"]
    k = bisect.bisect_right(signal, x, 1, len(signal) - 1)
    share = (x - signal[k - 1]) / (signal[k] - signal[k - 1])
    return value[k - 1] + share * (value[k] - value[k - 1])


def input_behind_curve(u, covariates):
    """The input behind a curve of its own, or times a factor that depends on time or on a covariate."""
    curve = FOUND["curve"]
    if curve is None or curve["of"] == "output":
        return u
    if curve["of"] == "input":
        return [through(curve, each) for each in u]
    if curve["of"] == "time":
        argument = [k / max(len(u) - 1, 1) for k in range(len(u))]
    else:
        argument = covariates[curve["of"]]
        argument = argument if isinstance(argument, list) else [argument] * len(u)
    return [through(curve, x) * each for x, each in zip(argument, u)]


def filtered(system, u):
    """num(q^-1)/den(q^-1) u, from rest."""
    num, den = system["num"], system["den"]
    y = []
    for k in range(len(u)):
        value = sum(num[j] * u[k - j] for j in range(min(len(num), k + 1)))
        y.append(value - sum(den[j] * y[k - j] for j in range(1, min(len(den), k + 1))))
    return y


def delayed(y, samples):
    """The signal so many samples later; between samples by Hermite's cubic, constant beyond the ends."""
    whole = math.floor(-samples)
    share = -samples - whole

    def at(k):
        return y[min(max(k, 0), len(y) - 1)]

    later = []
    for k in range(len(y)):
        y0, y1 = at(k + whole), at(k + whole + 1)
        slope0, slope1 = 0.5 * (y1 - at(k + whole - 1)), 0.5 * (at(k + whole + 2) - y0)
        square, cube = 3 * (y1 - y0) - 2 * slope0 - slope1, slope0 + slope1 - 2 * (y1 - y0)
        later.append(y0 + share * (slope0 + share * (square + share * cube)))
    return later


def lead_lag(y, lead, lag):
    """(1 + lead s) / (1 + lag s), time constants in samples, for a signal that is linear between samples."""
    time = max(lag, 0.02)
    kept = math.exp(-1 / time)
    ramp = 1 - time * (1 - kept)
    state = previous = y[0] if y else 0.0
    result = []
    for k, value in enumerate(y):
        if k > 0:
            state = kept * state + (1 - kept) * previous + ramp * (value - previous)
        previous = value
        result.append(lead / time * value + (1 - lead / time) * state)
    return result


def own(u, sample_time, covariates, parameters=None):
    """Your simulation as it is, or with other values of its parameters."""
    if FOUND["kind"] == "program":
        own_parameters = {each["name"]: each["yours"] for each in FOUND["parameters"]}
        return Program.output(u, sample_time, covariates, parameters or own_parameters)
    if FOUND["kind"] == "logged":
        y = covariates[FOUND["column"]]
        return y if isinstance(y, list) else [y] * len(u)
    return filtered(FOUND["yours"], u)


def extended(u, sample_time, covariates=None, parameters=None):
    """Your simulation with everything that was found; `parameters` replace the measured ones."""
    covariates = covariates or {}
    if FOUND["yours"] is not None and abs(sample_time - FOUND["sample_time"]) > 1e-6 * sample_time:
        raise ValueError(f"sample_time must be {FOUND['sample_time']} s, which the filters are made for")
    behind = input_behind_curve(u, covariates)
    if FOUND["kind"] == "linear":
        y = filtered(FOUND["measured"], behind)
    else:
        measured = {each["name"]: each["measured"] for each in FOUND["parameters"]}
        y = own(behind, sample_time, covariates, parameters={**measured, **(parameters or {})})
        if FOUND["yours"] is not None:
            of_own = u if FOUND["kind"] == "logged" else behind
            change = zip(filtered(FOUND["measured"], behind), filtered(FOUND["yours"], of_own))
            y = [value + new - old for value, (new, old) in zip(y, change)]
    if FOUND["curve"] is not None and FOUND["curve"]["of"] == "output":
        y = [through(FOUND["curve"], value) for value in y]
    if FOUND["delay"] != 0:
        y = delayed(y, FOUND["delay"] / sample_time)
    if FOUND["lead"] != 0 or FOUND["lag"] != 0:
        y = lead_lag(y, FOUND["lead"] / sample_time, FOUND["lag"] / sample_time)
    return [FOUND["gain"] * value + FOUND["offset"] for value in y]


def runs_of(path):
    """The experiments of a file with the columns experiment, t, u, y and covariates, in their order."""
    rows = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            rows.setdefault(row["experiment"], []).append(row)
    for name, each in rows.items():
        columns = {key: [float(row[key]) if row[key] else math.nan for row in each]
                   for key in each[0] if key != "experiment"}
        u, y = columns.pop("u"), columns.pop("y")
        columns.pop("t")
        covariates = {key: values[0] if len(set(values)) == 1 else values for key, values in columns.items()}
        yield name, u, y, covariates


def without_transient(error):
    """The error without what c e^(-t / transient), with the best c of this run, takes away."""
    if FOUND["transient"] == 0:
        return error
    shape = [math.exp(-k * FOUND["sample_time"] / FOUND["transient"]) for k, _ in error]
    power = sum(value * value for value in shape)
    best = sum(value * each for value, (_, each) in zip(shape, error)) / power if power > 0 else 0.0
    return [(k, each - best * value) for value, (k, each) in zip(shape, error)]


def fits_of(path, begin):
    """[%] 100 (1 - |error| / |y - mean|) of your simulation and of the extended one; `begin`: share of a run left out."""
    measured, errors = [], ([], [])
    for _, u, y, covariates in runs_of(path):
        compared = [k for k in range(int(begin * len(y)), len(y)) if math.isfinite(y[k])]
        measured += [y[k] for k in compared]
        outputs = own(u, FOUND["sample_time"], covariates), extended(u, FOUND["sample_time"], covariates)
        of_run = [[(k, y[k] - output[k]) for k in compared] for output in outputs]
        errors[0].extend(of_run[0])
        errors[1].extend(without_transient(of_run[1]))
    mean = sum(measured) / len(measured)
    power = sum((value - mean) ** 2 for value in measured)
    return [100 * (1 - math.sqrt(sum(each * each for _, each in error) / power)) for error in errors]


def check(path):
    """Prints both fits; whether they are the reported ones, where the data are those of the report."""
    reported = os.path.join(os.path.dirname(os.path.abspath(__file__)), "held_out.csv")
    if path is not None:
        print("fit %.3f %% with your simulation, %.3f %% extended" % tuple(fits_of(path, 0)))
        return True
    fits = fits_of(reported, FOUND["compared_from"])
    agrees = True
    for what, fit, expected in zip(("your simulation", "extended"), fits, (FOUND["fit_before"], FOUND["fit_after"])):
        same = abs(fit - expected) < 0.01
        agrees = agrees and same
        print(f"{what}: fit {fit:.3f} %, reported {expected:.3f} %: {'agrees' if same else 'DIFFERS'}")
    return agrees


def serve():
    """Answers requests as your simulation does."""
    for line in sys.stdin:
        request = json.loads(line)
        y = extended(request["u"], request["sample_time"], request["covariates"], request["parameters"])
        print(json.dumps({"y": y}), flush=True)


def main(arguments):
    if arguments and arguments[0] == "--check" and len(arguments) <= 2:
        return 0 if check(arguments[1] if len(arguments) == 2 else None) else 1
    if arguments:
        print(__doc__, file=sys.stderr)
        return 2
    serve()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
