#!/usr/bin/env python3
"""calibration.py RECORD... --out PICTURE: mu against I, and delta against base friction, of calibration records."""
import argparse
import pathlib

import numpy as np
import style
import yaml


def degrees(tangent):
    return np.degrees(np.arctan(tangent))


def label(r):
    return f"{r['material'].replace('_', ' ')}, {1000 * r['diameter']:g} mm"


def mu_against_inertia(axes, r, colour, marker):
    rows = np.array(r["phi_slabs"])
    for depth, filled in zip(sorted(set(rows[:, 0])), (True, False)):
        inertia, mu = rows[rows[:, 0] == depth][:, 2:].T
        seen = (inertia >= 0.01) & (inertia <= 0.3)
        edges = np.linspace(0, 0.3, 9)
        for low, high in zip(edges, edges[1:]):
            inside = seen & (inertia >= low) & (inertia < high)
            if inside.sum() < 3:
                continue
            axes.errorbar(inertia[inside].mean(), mu[inside].mean(), 2 * mu[inside].std() / np.sqrt(inside.sum()), color=colour,
                          marker=marker, ms=6, mfc=colour if filled else "white", lw=0, elinewidth=1)
    line = np.array([0, 0.3])
    axes.plot(line, np.tan(np.radians(r["phi_reached"])) + r["phi_slope"] * line, color=colour, lw=1)
    axes.plot(0, np.tan(np.radians(r["phi_asked"])), color=colour, marker=marker, mfc="white", mew=2, ms=10, clip_on=False, zorder=5)


def delta_against_base_friction(axes, r, colour, marker, usual):
    rows = np.array(r["base_curve"])
    found = rows[:, 1] == r["rolling_friction"]
    axes.plot(rows[found][:, 2], degrees(rows[found][:, 3]), color=colour, marker=marker, ms=5, label=label(r))
    if usual:
        axes.plot(rows[~found][:, 2], degrees(rows[~found][:, 3]), color=style.GREY, marker="x", ls="--",
                  label=f"friction 0.5, rolling 0.15 ({label(r)})")
    axes.plot(r["base_friction"], r["delta_reached"], color=colour, marker=marker, mfc="white", mew=2, ms=10, zorder=5)


def main():
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("records", nargs="+", type=pathlib.Path)
    words.add_argument("--out", required=True)
    words = words.parse_args()
    figure, (left, right) = style.plt.subplots(1, 2, figsize=(style.WIDTH, 4.6), layout="constrained")
    for k, path in enumerate(words.records):
        r = yaml.safe_load(path.read_text())
        mu_against_inertia(left, r, style.SERIES[k], "osD^"[k % 4])
        delta_against_base_friction(right, r, style.SERIES[k], "osD^"[k % 4], usual=k == 0)
    left.set(title="Rough base: friction within", xlabel="inertial number I", ylabel="mu of the slab", xlim=(0, 0.31))
    left.set_title("filled: 10 d deep, open: 20 d; large: tan(phi) measured", loc="right", fontsize=7.5, fontweight="normal", y=-0.22)
    line = np.linspace(0.15, 1.02, 50)
    right.plot(line, degrees(line), color=style.INK, lw=0.8, ls=":", label="arctan of the base friction")
    right.set(title="Flat base", xlabel="base friction", ylabel="delta [deg]")
    right.set_title("large: calibrated", loc="right", fontsize=7.5, fontweight="normal", y=-0.22)
    right.legend(fontsize=7.5)
    style.save(figure, words.out)


if __name__ == "__main__":
    main()
