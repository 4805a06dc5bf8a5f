#!/usr/bin/env python3
"""compare.py RUN... [--from T0] [--to T1]: depth and velocity along the chute of several runs of one scene, means from T0 to T1 [s].

Columns of cells, across the whole width; where there are grains theirs count. The last run is the measure: the largest and the mean
deviation of the others from it are printed, over the zone's columns.
"""
import argparse
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "app" / "report"))
from read import Run  # noqa: E402

COLUMN, WIDTH = 50e-3, 80e-3  # [m] of a column, of the chute


def profile(run, frame, edges):
    """Mass and momentum over the bulk density, per column [m3], [m4/s]."""
    volume, flux = np.zeros(len(edges) - 1), np.zeros(len(edges) - 1)
    if run.has_flow and frame.flow("h") is not None and run.mode != "grains":
        x = run.grid[0]
        cell = (x[1] - x[0]) * WIDTH
        h, hu = frame.flow("h").mean(axis=0), frame.flow("hu").mean(axis=0)
        volume += np.histogram(x, edges, weights=h * cell)[0]
        flux += np.histogram(x, edges, weights=hu * cell)[0]
    else:
        g = frame.grains()
        m = grain_volume(run) * (g["radius"] / np.mean(g["radius"])) ** 3
        volume += np.histogram(g["s"], edges, weights=m)[0]
        flux += np.histogram(g["s"], edges, weights=m * g["speed"])[0]
    return volume / (COLUMN * WIDTH), flux / (COLUMN * WIDTH)


def grain_volume(run):
    """Of the released volume, by the number of grains at the start."""
    g = run.frames[0].grains()
    cubes = (g["radius"] / np.mean(g["radius"])) ** 3
    return run.figure("mass.initial") / 1425.0 / cubes.sum()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("runs", nargs="+")
    parser.add_argument("--from", dest="t0", type=float, default=0.2)
    parser.add_argument("--to", dest="t1", type=float, default=0.4)
    arguments = parser.parse_args()
    runs = [Run(p) for p in arguments.runs]
    zone = next((z for r in runs for f in r.frames for z in f.zones), (0.85, 1.45))
    edges = np.arange(0.6, 1.55, COLUMN)
    means = []
    for run in runs:
        frames = [f for f in run.frames if arguments.t0 - 1e-9 <= f.time <= arguments.t1 + 1e-9]
        both = [profile(run, f, edges) for f in frames]
        h, q = np.mean([b[0] for b in both], axis=0), np.mean([b[1] for b in both], axis=0)
        means.append((h, q / np.maximum(h, 1e-9)))
    print("x [m]   " + "   ".join(f"{r.mode:>20}" for r in runs) + "      depth [mm], velocity [m/s]")
    for k in range(len(edges) - 1):
        inside = zone[0] - 1e-9 <= edges[k] and edges[k + 1] <= zone[1] + 1e-9
        print(f"{(edges[k] + edges[k + 1]) / 2:.3f} {'*' if inside else ' '} "
              + "   ".join(f"{1e3 * h[k]:10.2f} {u[k]:9.3f}" for h, u in means))
    inside = (edges[:-1] >= zone[0] - 1e-9) & (edges[1:] <= zone[1] + 1e-9) & (means[-1][0] > 0.2 * means[-1][0].max())
    for run, (h, u) in zip(runs, means):
        d, v = 100 * (h / means[-1][0] - 1)[inside], 100 * (u / means[-1][1] - 1)[inside]
        print(f"{run.mode}: depth {d.mean():+.1f} % (largest {np.abs(d).max():.1f}), velocity {v.mean():+.1f} % "
              f"(largest {np.abs(v).max():.1f}); mass error {run.figure('mass.relative_error'):.1e}, momentum residual "
              f"{run.figure('momentum.relative_residual'):.2g}")


if __name__ == "__main__":
    main()
