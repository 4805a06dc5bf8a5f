#!/usr/bin/env python3
"""compare.py RUN [t0]: depth and velocity along the zone against the uniform flow that enters it; mean from t0 [s] to the end.

Prints the largest deviation of depth and velocity over lengths of 5 diameters, and the mass that leaves the zone over the mass
that enters it (grains handed back over grains sent in).
"""
import json
import pathlib
import sys

import h5py
import numpy as np


def main(run, t0):
    run = pathlib.Path(run)
    with h5py.File(run / "records.h5") as f:
        frames = [g for _, g in sorted(f["frames"].items()) if g["time"][()] >= t0]
        first = f["frames/000000"]
        x, h0 = f["grid/x"][:], first["h"][:].mean()
        u0 = (first["hu"][:] / first["h"][:]).mean()
        low, high = first_zone(frames)[:2]
        i0, i1 = np.searchsorted(x, low), np.searchsorted(x, high)
        h = np.mean([g["h"][:].mean(axis=0) for g in frames], axis=0)
        q = np.mean([g["hu"][:].mean(axis=0) for g in frames], axis=0)
    depth, velocity = h / h0 - 1, q / h / u0 - 1
    edges = np.arange(i0, i1 + 1, max(1, (i1 - i0) // 8))
    print("   x [m]   depth   velocity   flux     (deviation from the uniform flow, %)")
    worst = [0, 0]
    for a, b in zip(edges[:-1], edges[1:]):
        d, v, m = 100 * depth[a:b].mean(), 100 * velocity[a:b].mean(), 100 * (q[a:b].mean() / (h0 * u0) - 1)
        worst = [max(worst[0], abs(d)), max(worst[1], abs(v))]
        print(f"  {x[a:b].mean():.3f}   {d:+.2f}    {v:+.2f}     {m:+.2f}")
    before, after = q[i0 - 8 : i0].mean(), q[i1 : i1 + 8].mean()
    print(f"largest: depth {worst[0]:.2f} %, velocity {worst[1]:.2f} %; flux out / in {after / before:.4f}")
    print("mass: relative error", json.loads((run / "summary.json").read_text())["mass"]["relative_error"])


def first_zone(frames):
    return next(g["zones"][0] for g in frames if "zones" in g)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 0.2)
