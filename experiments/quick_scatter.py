#!/usr/bin/python3
"""How far the figures of `couloir check EXPERIMENT... --quick --json` scatter over runs that differ in packing and time step: what
stands behind the tolerances of evidence regression. docs/experiments.md has the commands.

    quick_scatter.py FINDINGS...      one file a run, the first being that of the scenes as they stand

A row a regression: value, mean, scatter (standard deviation of a sample), three scatters, and what is allowed.
"""
import argparse
import json
import statistics

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("findings", nargs="+", help="what `couloir check --quick --json` printed")
given = arguments.parse_args()
figures = {}
for name in given.findings:
    for f in json.load(open(name)):
        if f["evidence"] == "regression" and f["value"] is not None:
            case = f["case"] + (f" [{f['variant']}]" if f["variant"] else "")
            figures.setdefault((f["experiment"], case, f["quantity"]), []).append(f)
print("| experiment | case | quantity | as it stands | mean | scatter | three scatters | allowed |\n" + "| --- " * 8 + "|")
for (experiment, case, quantity), found in figures.items():
    values = [f["value"] for f in found]
    if len(values) < 2:
        continue  # of one run alone nothing is known
    scatter, first = statistics.stdev(values), found[0]
    allowed = "-" if first["tolerance"] is None else f"{first['tolerance'] * (abs(first['expected']) if first['tolerance_is'] == 'relative' else 1):.3g}"
    print(f"| {experiment} | {case} | {quantity} | {values[0]:.4g} {first['unit']} | {statistics.mean(values):.4g} | {scatter:.2g} "
          f"| {3 * scatter:.2g} | {allowed} |")
