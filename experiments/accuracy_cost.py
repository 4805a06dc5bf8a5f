#!/usr/bin/python3
"""Ladders of several experiments side by side, as docs/results/accuracy_cost.md has them: errors and costs of all rungs, the rung to
take for a wanted error, and a picture of error against processor time, a row an experiment.

    experiments/accuracy_cost.py experiments/*/ladder.json --picture docs/results/accuracy_cost.png
"""
import argparse
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "app/report"))
import style  # noqa: E402
from study_ladder import draw_quantity  # noqa: E402
from style import plt  # noqa: E402


def percent(share):
    return "-" if share is None else f"{100 * share:.2g} %" if abs(share) < 1 else f"{100 * share:.0f} %"


def seconds(value):
    return f"{1e3 * value:.2g} ms" if value < 0.01 else f"{value:.2g} s" if value < 100 else f"{value:.0f} s"


def error(figures):
    if figures["error"] is None:
        return "-"
    scatter = f" ± {100 * figures['scatter']:.1f}" if figures["scatter"] else ""
    return f"{100 * figures['bias']:+.1f}{scatter} %" + (" *" if figures["front"] else "")


def flow(scene):
    told = {"Fr": "froude", "depth over obstacle": "depth_over_height", "depth over grain": "depth_over_diameter"}
    return "".join(f"; {word} {scene[key]:.2g}" for word, key in told.items() if scene[key] is not None)


def rungs(ladder):
    quantities = ladder["quantities"]
    heads = [f"{q['quantity']} [{q['unit'] or '1'}]" for q in quantities]
    print("| | rung | " + " | ".join(heads) + " | processor time |")
    print("| --- | --- |" + " --- |" * (len(heads) + 1))
    print("| | reference | " + " | ".join(f"{q['reference']:.4g}" for q in quantities) + " | |")
    for n, rung in enumerate(ladder["rungs"]):
        print(f"| {n + 1} | {rung['name']} | " + " | ".join(error(q["rungs"][n]) for q in quantities) + f" | {seconds(rung['cpu'])} |")


def choices(ladder):
    wanted = [c["wanted"] for c in ladder["quantities"][0]["choices"]]
    print("| quantity | " + " | ".join(f"for {percent(w)}" for w in wanted) + " |")
    print("| --- |" + " --- |" * len(wanted))
    for q in ladder["quantities"]:
        cells = []
        for c in q["choices"]:
            packings = f", mean of {c['packings']}" if c["rung"] and c["packings"] > 1 else ""
            cells.append(f"{c['rung']}{packings}: {percent(c['error'])}, {seconds(c['cpu'])}" if c["rung"] else "no rung")
        print(f"| {q['quantity']} | " + " | ".join(cells) + " |")


def draw(ladders, path):
    columns = max(len(ladder["quantities"]) for ladder in ladders)
    figure, axes = plt.subplots(len(ladders), columns, figsize=(5.4 * columns, 4 * len(ladders)), squeeze=False, layout="constrained")
    for row, ladder in zip(axes, ladders):
        for a, quantity in zip(row, ladder["quantities"]):
            draw_quantity(a, ladder, quantity)
            a.set_title(f"{ladder['name']}: {quantity['quantity']}", loc="left")
            a.get_legend().remove()
        for a in row[len(ladder["quantities"]):]:
            a.set_axis_off()
    handles = {label: handle for a in axes.flat for handle, label in zip(*a.get_legend_handles_labels())}
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.4 / figure.get_figheight()))
    figure.legend(handles.values(), handles.keys(), loc="upper center", ncols=len(handles))
    style.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ladders", nargs="+", type=pathlib.Path)
    parser.add_argument("--picture", type=pathlib.Path)
    args = parser.parse_args()
    ladders = [json.loads(path.read_text()) for path in args.ladders]
    for ladder in ladders:
        print(f"### {ladder['title']}\n\n`experiments/{ladder['name']}`, revision {ladder['revision']}, {ladder['cpu']}{flow(ladder['scene'])}.\n")
        rungs(ladder)
        print()
        choices(ladder)
        print()
    if args.picture:
        draw(ladders, args.picture)


if __name__ == "__main__":
    main()
