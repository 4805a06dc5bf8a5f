#!/usr/bin/env python3
"""The table and the pictures of docs/results/verification.md, from what the verification tests record.

    figures.py RECORDS OUT      RECORDS: the folder that COULOIR_VERIFICATION named; OUT: where the pictures go
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

SECTIONS = ["smooth", *"abcdefghi"]
SCHEMES = {"central_upwind": ("tab:red", 4), "noc": ("tab:blue", 1.8)}  # colour, size


def table(records):
    rows = list(csv.reader((records / "table.csv").open(), delimiter=";"))
    print("| | case | measure | scheme | cells | value | order | asserted |\n" + "| --- " * 8 + "|")
    for row in rows:
        row[3:3] = [row.pop().split("/")[1].split(".")[0].replace("noc_velocity_slopes", "noc, velocity slopes")]
    for row in sorted(rows, key=lambda r: (SECTIONS.index(r[0]), r[1], r[2], r[3])):
        print("| " + " | ".join(row) + " |")


def profile(records, name, scheme="central_upwind"):
    return np.genfromtxt(records / f"{name}_{scheme}.csv", delimiter=",", names=True)


def profiles(records, out):
    fig, axes = plt.subplots(2, 2, figsize=(10, 6.4), layout="constrained")
    for ax, name, title in [(axes[0, 0], "incline_dam_break", "d  dam break, $\\zeta$ 30°, $\\delta$ 22°, 400 cells"),
                            (axes[0, 1], "thacker", "e  Thacker's basin, 1.1 periods, 200 cells"),
                            (axes[1, 0], "wall_shock", "f  shock at a wall, Fr 7, 200 cells")]:
        d = profile(records, name)
        base = d["bed"] if "bed" in d.dtype.names else 0 * d["x"]
        if base.any():
            ax.fill_between(d["x"], 0, base, color="0.85", label="bed")
        there = d["exact"] > 0
        ax.plot(d["x"][there], (base + d["exact"])[there], color="black", lw=1, label="exact")
        for scheme, (color, size) in SCHEMES.items():
            h = profile(records, name, scheme)["h"]
            ax.plot(d["x"][h > 1e-6], (base + h)[h > 1e-6], ".", ms=size, color=color, label=scheme)
        ax.set(title=title, xlabel="x [m]", ylabel="surface [m]" if base.any() else "h [m]")
        ax.legend(frameon=False)
    axes[0, 0].set_xlim(-0.9, 1.5)
    axes[0, 1].set(xlim=(-1.7, 1.9), ylim=(0, 0.3))
    d, ax = profile(records, "arc"), axes[1, 1]
    ax.plot(d["x"], d["without"], "--", color="0.5", lw=1, label="exact, without curvature")
    ax.plot(d["x"], d["exact"], color="black", lw=1, label="exact")
    for scheme, (color, size) in SCHEMES.items():
        ax.plot(d["x"], profile(records, "arc", scheme)["u"], ".", ms=1.5 * size, color=color, label=scheme)
    for edge in (0.5, 1.1):
        ax.axvline(edge, color="0.8", lw=0.8, zorder=0)
    ax.set(title="i  layer down a slope, an arc and a run-out, 75 cells", xlabel="x [m]", ylabel="u [m/s]")
    ax.legend(frameon=False)
    fig.savefig(out / "verification_profiles.png", dpi=110)


def oblique(records, out):
    fig, axes = plt.subplots(2, 1, figsize=(8, 6), layout="constrained")
    for ax, scheme in zip(axes, SCHEMES):
        d = profile(records, "oblique_shock", scheme)
        x, y = np.unique(d["x"]), np.unique(d["y"])
        mesh = ax.pcolormesh(x, y, d["h"].reshape(len(y), len(x)), cmap="viridis", shading="nearest", vmin=0.05, vmax=0.17)
        fig.colorbar(mesh, label="h [m]")
        turn = np.radians(30.692 - 20)
        ax.plot(x[x >= 0], x[x >= 0] * np.tan(turn), "--", color="white", lw=1.2, label="exact, 30.69° to the flow")
        ax.annotate("", xy=(0.32, 0.30), xytext=(0.32 - 0.2, 0.30 + 0.2 * np.tan(np.radians(20))),
                    arrowprops={"arrowstyle": "->", "color": "white"})
        ax.text(0.33, 0.305, f"{scheme}: F 5, 20° to the wall y = 0", color="white")
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", xlim=(0, x[-1]), ylim=(0, y[-1]))
        ax.legend(frameon=False, labelcolor="white", loc="upper right")
    fig.savefig(out / "verification_oblique.png", dpi=110)


if __name__ == "__main__":
    source, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    table(source)
    profiles(source, target)
    oblique(source, target)
