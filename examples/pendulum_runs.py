#!/usr/bin/env python3
"""Writes pendulum_runs.csv, on which docs/own_simulation.md tries explain: twenty runs of a pendulum
whose mass is 15 % larger than that of pendulum_simulation.py, with noise, and the simulation's own
output as the column y_sim."""
import random

from pendulum_simulation import simulate

SAMPLE_TIME = 0.02  # [s]


def main():
    generator = random.Random(1)
    with open("pendulum_runs.csv", "w") as file:
        file.write("experiment,t,u,y,y_sim\n")
        for run in range(20):
            torque = []
            for k in range(300):
                torque.append(generator.gauss(0, 0.6) if k % 15 == 0 else torque[-1])
            measured = simulate(torque, SAMPLE_TIME, mass=1.15, friction=0.4, length=0.5)
            simulated = simulate(torque, SAMPLE_TIME, mass=1.0, friction=0.4, length=0.5)
            for k, (u, y, y_sim) in enumerate(zip(torque, measured, simulated)):
                y += generator.gauss(0, 0.003)
                file.write(f"run{run:02},{k * SAMPLE_TIME:.2f},{u:.6f},{y:.6f},{y_sim:.6f}\n")


if __name__ == "__main__":
    main()
