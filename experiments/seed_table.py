#!/usr/bin/python3
"""The dissertation's numbers beside ours, as docs/results/seed_continuum.md has them: a row for each quantity of its tables."""
import argparse
import json


# What the text gives as an interval, or friction allows: shown as such, without a deviation.
INTERVALS = ("final on the wall", "peak over end", "climb", "share over the wall")
WEIGHT = ["seed table", "measured", "exact", "regression"]  # which expectation of one figure stands in the column


def rows(findings):
    """A row for each figure; what was not run keeps the value that expected.yaml holds of an earlier revision."""
    shown_in = {}  # of the table or figure that a case stands for
    for f in findings:
        for words in (f["case"], f["source"]):
            if words.startswith(("Table", "Figure")):
                shown_in.setdefault((f["experiment"], f["case"]), words.split(",")[0].split(" row ")[0])
    out = {}
    for f in findings:
        name = f["case"].replace("what the text says, ", "").replace("our heights, ", "")  # of Figure 6.3: one row
        key = (f["experiment"], name, shown_in.get((f["experiment"], f["case"]), name), column(f["quantity"]))
        row = out.setdefault(key, {"quantity": key[3], "evidence": "", "kept": {}})
        if not row["evidence"] or WEIGHT.index(f["evidence"]) < WEIGHT.index(row["evidence"]):
            row.update(expected=f["expected"], unit=f["unit"], span=f["tolerance"], evidence=f["evidence"], source=f["source"])
        variant = f["variant"] or "default"
        if f["verdict"] != "skipped":
            row[variant] = f["value"]
        elif f["evidence"] == "regression":
            row["kept"][variant] = f["expected"]
    found = [(key, row) for key, row in out.items() if row["kept"] or "default" in row or "seed" in row]
    return dict(sorted(found, key=lambda item: (not item[0][2].startswith("Table"), item[0][2], item[0][1])))


def column(quantity):
    """Two variants may measure the same thing in two ways: (7.1) on a bed height, the flow's force on a solid step."""
    if quantity.endswith(("elevation_upstream.maximum", "force_peak_window")):
        return "maximum force"
    if quantity.endswith("elevation_upstream.mean") or quantity.startswith("obstacles.wall.impulse / time"):
        return "mean force"
    return {"critical": "critical height", "gauges.base.depth_final": "depth on the cuboid", "walls.downstream.peak": "peak on the wall",
            "walls.downstream.final": "final on the wall", "walls.downstream.peak / walls.downstream.final": "peak over end",
            "obstacles.wall.max_climbed": "climb", "obstacles.wall.overflow / mass.initial": "share over the wall",
            "obstacles.wall.force_peak": "peak of the force"}.get(quantity, quantity)


def shown(row, variant):
    value, mark = row.get(variant), ""
    if value is None:
        value, mark = row["kept"].get(variant), "\u2020"
    if value is None:
        return "-"
    expected = 0 if row["quantity"] in INTERVALS or expected_text(row) == "-" else row["expected"]
    off = f" ({100 * (value / expected - 1):+.0f} %)" if expected else ""
    return f"{value:.4g}{mark}{off}"


def expected_text(row):
    unit = f" x {row['unit']}" if row["unit"][:1].isdigit() else f" {row['unit']}" if row["unit"] else ""
    if row["evidence"] == "regression" and not row["source"].startswith("literal solver"):
        return "-"
    if row["quantity"] in INTERVALS and (row["span"] or 0) > 1e-3:
        return f"{max(0, row['expected'] - row['span']):.3g} to {row['expected'] + row['span']:.3g}{unit}"
    return f"{row['expected']:.4g}{unit}"


def value(row, variant):
    found = row.get(variant, row["kept"].get(variant))
    return float("nan") if found is None else found


def numbers(row_name):
    return [float(part.split()[0]) for part in row_name.split(" / ")]


def draw(table, out):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    panels = [("Table 5.1", "depth on the cuboid", "cell [units]", "depth on the cuboid [units]"),
              ("Table 5.5", "critical height", "cells along / across [units]", "critical height [units]"),
              ("Figure 7.8", "peak on the wall", "slope [deg]", "peak on the flume's wall [N]"),
              ("Table 7.1", "force", "slope [deg]", "force [N]"), ("Table 7.2", "force", "basal friction angle [deg]", "force [N]"),
              ("Table 7.3", "force", "internal friction angle [deg]", "force [N]")]
    fig, axes = plt.subplots(2, 3, figsize=(12, 7), layout="constrained")
    looks = [("expected", "dissertation", "black", "o"), ("seed", "noc + elevation", "tab:blue", "s"),
             ("default", "central_upwind + step", "tab:red", "^")]
    for ax, (source, quantity, across, up) in zip(axes.flat, panels):
        for wanted, line in [("maximum force", "-"), ("mean force", ":")] if quantity == "force" else [(quantity, "-")]:
            chosen = [(name.removeprefix(source).lstrip(", "), row) for (_, name, of, what), row in table.items()
                      if of == source and what == wanted and name.removeprefix(source).lstrip(", ")[:1].isdigit()]
            pairs = any(" / " in name for name, _ in chosen)
            x = range(len(chosen)) if pairs else [numbers(name)[0] for name, _ in chosen]
            for variant, label, color, mark in looks:
                y = [value(row, variant) for _, row in chosen]
                if source == "Figure 7.8" and variant == "expected":
                    label = "literal solver (the figure has no numbers)"
                if source == "Table 5.5" and variant == "default":
                    label = "central_upwind + elevation"
                if wanted == "mean force":
                    label = None
                ax.plot(x, y, linestyle="none" if pairs else line, marker=mark, color=color, label=label)
            if pairs:
                ax.set_xticks(list(x), [name.replace(" / ", "/") for name, _ in chosen])
        ax.set(title=source + (": maximum, dotted the mean" if quantity == "force" else ""), xlabel=across, ylabel=up)
        ax.set_ylim(bottom=0)
        ax.legend(frameon=False, fontsize="small")
    fig.savefig(out, dpi=100)


arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("findings", nargs="+", help="what `couloir check EXPERIMENT --json` printed, with the variants seed and default; "
                       "a later file's figures stand for an earlier one's")
arguments.add_argument("--picture", help="draw the tables into this file")
given = arguments.parse_args()
table = rows([f for name in given.findings for f in json.load(open(name))])
print("| of | row | quantity | dissertation | `noc` + `elevation` | default |\n| --- | --- | --- | --- | --- | --- |")
for (experiment, name, source, quantity), row in table.items():
    if quantity in ("mass.initial", "mass.relative_error", "momentum.relative_residual"):
        continue  # ledgers; couloir check has them
    print(f"| {source} | {name.removeprefix(source).lstrip(', ')} | {quantity} | {expected_text(row)} | {shown(row, 'seed')} "
          f"| {shown(row, 'default')} |")
if given.picture:
    draw(table, given.picture)
