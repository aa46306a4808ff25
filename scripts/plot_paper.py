#!/usr/bin/python3
"""Draws Figures 3 and 4 of the paper from the output of the program `paper`: plot_paper.py figures.json FOLDER."""
import json
import math
import os
import sys

import matplotlib

matplotlib.use("Agg")  # pictures only, no window
from matplotlib import pyplot  # noqa: E402

BLUE, RED = "#0072b2", "#d55e00"  # colour-blind readers can distinguish these


def density(components, x):
    """Value at x of a mixture given as [weight, mean, standard deviation]."""
    return sum(w * math.exp(-0.5 * ((x - m) / s) ** 2) / (s * math.sqrt(2 * math.pi)) for w, m, s in components)


def decibel(values):
    return [20 * math.log10(max(value, 1e-6)) for value in values]


def save(figure, folder, name):
    path = os.path.join(folder, name + ".png")
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
    print("wrote", path)


def draw_distribution(data, folder):
    figure, axes = pyplot.subplots(figsize=(6, 4))
    grid = [-3 + 6 * k / 600 for k in range(601)]
    runs = [[density(mixture, x) for x in grid] for mixture in data["estimated"]]
    for k, run in enumerate(runs):
        axes.plot(grid, run, color=BLUE, alpha=0.3, linewidth=0.6, label="estimated, each data set" if k == 0 else None)
    axes.plot(grid, [sum(column) / len(runs) for column in zip(*runs)], color=BLUE, label="their mean")
    axes.plot(grid, [density(data["true"], x) for x in grid], color=RED, linestyle="--", label="true")
    axes.set(xlabel="error parameter $\\eta_0$", ylabel="probability density", xlim=(-3, 3),
             ylim=(0, 1.35 * max(max(run) for run in runs)))
    axes.legend(loc="upper center", ncol=3, fontsize="small")
    axes.grid(alpha=0.3)
    save(figure, folder, "figure3a")


def draw_magnitude(data, folder, name, region, own):
    figure, axes = pyplot.subplots(figsize=(6, 4))
    omega = data["omega"]
    axes.fill_between(omega, decibel(data["lower"]), decibel(data["upper"]), color=BLUE, alpha=0.25, linewidth=0,
                      label=region)
    for k, line in enumerate(data["own_models"]):
        axes.plot(omega, decibel(line), color="black", linestyle=":", linewidth=0.7, label=own if k == 0 else None)
    axes.plot(omega, decibel(data["nominal"]), color=BLUE, label="nominal model, mean of the data sets")
    axes.plot(omega, decibel(data["true"]), color=RED, linestyle="--", label="nominal system, true")
    axes.set(xscale="log", xlabel="frequency [rad/s]", ylabel="magnitude [dB]", xlim=(omega[0], omega[-1]))
    lowest = min(decibel(data["nominal"]) + decibel(data["true"]) + [min(decibel(line)) for line in data["own_models"]])
    axes.set_ylim(lowest - 5, None)  # a region's lower limit may be a zero
    axes.legend(fontsize="small", loc="best")
    axes.grid(alpha=0.3, which="both")
    save(figure, folder, name)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1]) as file:
        figures = json.load(file)
    folder = sys.argv[2]
    draw_distribution(figures["figure3a"], folder)
    own = "PEM, 25 experiments"
    draw_magnitude(figures["figure3b"], folder, "figure3b", "95 % region, SE", "FIR models, 25 experiments")
    draw_magnitude(figures["figure4a"], folder, "figure4a", "95 % region, SE", own)
    draw_magnitude(figures["figure4b"], folder, "figure4b", "95 % region, MEM", own)
    draw_magnitude(figures["figure4_parameter_spread"], folder, "figure4_parameter_spread",
                   "95 % region, parameter spread", own)


if __name__ == "__main__":
    main()
