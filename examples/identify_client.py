#!/usr/bin/env python3
"""Sends experiments to a running identification node and prints the model it answers.

    identify_client.py DATA.csv [CONFIG.yaml]

DATA.csv has the columns experiment,t,u,y with t in seconds on a uniform grid; an empty y was not measured. Without a
configuration the node's own is used. Start the node by: roslaunch uncertainty_identification identification.launch
"""

import csv
import math
import sys

import rospy
from uncertainty_identification.msg import Experiment
from uncertainty_identification.srv import Identify, IdentifyResponse


def read_experiments(path):
    """The file's experiments as messages, in the order of their first rows."""
    experiments = {}
    times = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            name = row["experiment"]
            experiment = experiments.setdefault(name, Experiment(id=name, valid=b""))
            measured = row["y"] != "" and math.isfinite(float(row["y"]))
            experiment.u.append(float(row["u"]))
            experiment.y.append(float(row["y"]) if measured else 0.0)
            experiment.valid += bytes([measured])
            times.setdefault(name, []).append(float(row["t"]))
    for name, experiment in experiments.items():
        first, last = times[name][0], times[name][-1]
        experiment.header.stamp = rospy.Time.from_sec(first)
        experiment.sample_time = (last - first) / max(len(times[name]) - 1, 1)
    return list(experiments.values())


def print_model(result):
    """What a reader wants to know first."""
    model = result.nominal_model
    print(f"{model.structure}, {result.experiment_count} experiments, {result.message}")
    for parameter in model.parameters:
        print(f"  {parameter.name} = {parameter.value:.6g} +- {parameter.standard_error:.2g} {parameter.unit}")
    print(f"  noise variance = {model.noise_variance:.6g} +- {model.noise_variance_standard_error:.2g}")
    for component in result.error_model.components:
        mean = ", ".join(f"{value:.4g}" for value in component.mean)
        print(f"  error component: weight {component.weight:.3f}, mean [{mean}]")
    for warning in result.warnings:
        print(f"  warning: {warning}")


def main():
    arguments = rospy.myargv(sys.argv)[1:]
    if len(arguments) not in (1, 2):
        sys.exit(__doc__)
    configuration = ""
    if len(arguments) == 2:
        with open(arguments[1]) as file:
            configuration = file.read()
    rospy.init_node("identify_client", anonymous=True)
    experiments = read_experiments(arguments[0])
    rospy.wait_for_service("identification/identify", timeout=30)
    answer = rospy.ServiceProxy("identification/identify", Identify)(
        experiments=experiments, bags=[], configuration=configuration)
    if answer.code != IdentifyResponse.OK:
        sys.exit(f"the node answered with code {answer.code}: {answer.message}")
    print_model(answer.result)


if __name__ == "__main__":
    main()
