#!/usr/bin/env python3
"""The table and the picture of docs/results/contacts.md, from what the engine tests record.

    figures.py RECORDS OUT      RECORDS: the folder that COULOIR_CONTACTS named; OUT: where the picture goes
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

LOOKS = {"liggghts": {"marker": "o", "ms": 11, "mfc": "none", "color": "tab:blue"}, "yade": {"marker": "x", "color": "tab:red"}}


def read(records):
    series = {}
    for check, engine, law, *numbers in csv.reader((records / "contacts.csv").open()):
        series.setdefault((check, engine, law), []).append([float(n) for n in numbers])
    return {key: np.array(sorted(rows)) for key, rows in series.items()}


def table(series):
    print("| check | law | at | theory | liggghts | yade |\n" + "| --- " * 6 + "|")
    checks = dict.fromkeys((check, law) for check, _, law in series)
    for check, law in checks:
        engines = [series.get((check, engine, law)) for engine in LOOKS]
        first = next(rows for rows in engines if rows is not None)
        shown = first[[0, len(first) // 2, -1]] if len(first) > 6 else first
        for at, _, theory in shown:
            measured = ["" if rows is None else f"{rows[abs(rows[:, 0] - at).argmin(), 1]:.4g}" for rows in engines]
            print(f"| {check} | {law} | {at:.3g} | {theory:.4g} | {' | '.join(measured)} |")


def panel(ax, series, check, law, title, xlabel, ylabel):
    for engine, look in LOOKS.items():
        rows = series.get((check, engine, law))
        if rows is None:
            continue
        ax.plot(rows[:, 0], rows[:, 1], ls="none", label=engine, **look)
        ax.plot(rows[:, 0], rows[:, 2], color="black", lw=1, zorder=0, label="theory" if engine == "liggghts" else None)
    ax.set(title=title, xlabel=xlabel, ylabel=ylabel)
    ax.set_ylim(bottom=0)


def picture(series, out):
    fig, axes = plt.subplots(2, 3, figsize=(12, 6.6), layout="constrained")
    panel(axes[0, 0], series, "restitution by damping", "kelvin_voigt", "dashpot that never pulls", "damping ratio b", "restitution e")
    panel(axes[0, 1], series, "slip to roll: speed", "hertz", "slip to roll, friction 0.3", "time [s]", "speed [m/s]")
    panel(axes[0, 2], series, "rolling: speed", "hertz", "rolling for 0.08 s, rolling friction 0.05", "inclination [deg]", "speed [m/s]")
    panel(axes[1, 0], series, "gross sliding: speed lost", "kelvin_voigt", "gross sliding, friction 0.3, v_n = 0.2 m/s",
          "restitution asked", "speed lost [m/s]")
    for engine, look in LOOKS.items():
        if (rows := series.get(("undamped: speed lost", engine, "kelvin_voigt"))) is not None:
            axes[1, 0].plot(rows[:, 0], rows[:, 1], ls="none", label=f"{engine}, undamped", **{**look, "color": "tab:green"})
            axes[1, 0].plot(rows[:, 0], rows[:, 2], color="black", lw=1, zorder=0)
    rows = series["sliding: linear law alone", "liggghts", "kelvin_voigt"]
    axes[1, 0].plot(rows[:, 0], rows[:, 2], "k--", lw=1, label="the law with its shear damper")
    panel(axes[1, 1], series, "silo: rate [kg/s/m]", "hertz", "silo's slot; theory: C = 1.03, k = 1.4", "slot over diameter",
          "discharge [kg/s/m]")
    ax = axes[1, 2]
    for n, (name, check) in enumerate([("run-out", "collapse: runout"), ("weight\non floor", "heap: weight on the floor"),
                                       ("wall over\nfloor", "heap: wall and floor")]):
        for engine, look in LOOKS.items():
            _, measured, theory = series[check, engine, "hertz"][0]
            ax.plot(n, measured / theory, ls="none", label=engine if n == 0 else None, **look)
    ax.axhline(1, color="black", lw=1)
    ax.axhspan(0.9, 1.1, color="0.92", zorder=0)
    ax.set(title="column a = 1 and its heap", xticks=range(3), ylabel="measured over theory", ylim=(0.6, 1.4), xlim=(-0.5, 2.5))
    ax.set_xticklabels(["run-out", "weight\non floor", "wall over\nfloor"])
    for ax in axes.flat:
        ax.legend(fontsize=8)
    fig.savefig(out / "contacts.png", dpi=110)


if __name__ == "__main__":
    everything = read(pathlib.Path(sys.argv[1]))
    table(everything)
    picture(everything, pathlib.Path(sys.argv[2]))
