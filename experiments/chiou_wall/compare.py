#!/usr/bin/env python3
"""compare.py RUN...: wall force, overtopping and cost of runs of this experiment, by mode, with the scatter over seeds.

Groups the runs by mode and prints for each: peak of the 15 ms mean, impulse, final force, overtopped mass, processor time; then the
ratios of the other modes to `grains`.
"""
import json
import pathlib
import sys

import numpy as np


def figures(run):
    s = json.loads((pathlib.Path(run) / "summary.json").read_text())
    wall = s["obstacles"]["wall"]
    return s["mode"], {
        "peak of 15 ms mean [N]": wall["force_peak"],
        "impulse [N s]": wall["impulse"],
        "final force [N]": wall["force_final"],
        "overtopped [kg]": s["mass"]["overtopped"],
        "processor time [s]": s["time"]["cpu"],
        "coupling's share [%]": 100 * s["time"]["share_coupling"],
        "largest mass error [-]": s["mass"]["relative_error"],
        "largest momentum residual [-]": s["momentum"]["relative_residual"],
    }


def main(runs):
    modes = {}
    for run in runs:
        mode, row = figures(run)
        modes.setdefault(mode, []).append(row)
    order = [m for m in ("continuum", "coupled", "grains") if m in modes]
    print("| figure | " + " | ".join(f"{m} ({len(modes[m])} run{'s' if len(modes[m]) > 1 else ''})" for m in order) + " |")
    print("| --- |" + " --- |" * len(order))
    means = {}
    for key in modes[order[0]][0]:
        cells = []
        for m in order:
            values = np.array([row[key] for row in modes[m]])
            means[m, key] = values.mean()
            scatter = f" ± {np.ptp(values) / 2:.2g}" if len(values) > 1 else ""
            cells.append(f"{values.mean():.4g}{scatter}")
        print(f"| {key} | " + " | ".join(cells) + " |")
    if "grains" in modes:
        for m in order[:-1]:
            ratios = ", ".join(f"{key.split(' [')[0]} {means[m, key] / means['grains', key]:.3f}"
                               for key in ("peak of 15 ms mean [N]", "impulse [N s]", "processor time [s]"))
            print(f"\n{m} / grains: {ratios}")


if __name__ == "__main__":
    main(sys.argv[1:])
