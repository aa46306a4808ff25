#!/usr/bin/env python3
"""A simulation of one's own for explain: a driven pendulum with friction (docs/own_simulation.md).

Reads one JSON object a line, {"sample_time": .., "u": [..], "covariates": {..}, "parameters": {..}},
and answers each with one line, {"y": [..]}. Messages go to the standard error.
"""
import json
import math
import sys


def simulate(torque, sample_time, mass, friction, length):
    """Angle [rad] at each sample, from rest, for torques [N m] that are held between samples."""
    steps = 4
    step = sample_time / steps
    inertia = mass * length ** 2
    angle = speed = 0.0
    angles = []
    for held in torque:
        angles.append(angle)
        for _ in range(steps):
            gravity = mass * 9.81 * length * math.sin(angle)
            speed += step * (held - friction * speed - gravity) / inertia
            angle += step * speed
    return angles


def main():
    for line in sys.stdin:
        request = json.loads(line)
        angles = simulate(request["u"], request["sample_time"], **request["parameters"])
        print(json.dumps({"y": angles}), flush=True)


if __name__ == "__main__":
    main()
