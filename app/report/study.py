#!/usr/bin/python3
"""Pictures of a study, and a page with them and its table.

    study.py STUDY.H5 [--out DIR]

Prints nothing but errors. Exit codes: 0 done, 2 it is no table of a study or the page cannot be written.
"""

import argparse
import re
import sys
from html import escape
from pathlib import Path

import numpy as np

import style
from page import number, page, picture, section, write_page
from study_ladder import ladder_section
from study_read import Layout, NoStudy, Study, file_name
from style import plt


MARKS = "os^Dvp"


def look(n, layout):
    """Of the n-th line: its own colour, mark and dashes; without an axis there is nothing to draw a line along."""
    return {"color": style.SERIES[n % len(style.SERIES)], "marker": MARKS[n % len(MARKS)], "markersize": 5, "clip_on": False,
            "linestyle": style.DASHES[n % len(style.DASHES)] if layout.axis else "none"}


def draw_lines(axes, study, layout, quantity):
    """The quantity against the parameter: means, the replicates' scatter as a band, the reference in black."""
    mean, scatter, reference = (study.of(quantity, role) for role in ("mean", "scatter", "reference"))
    for n, (label, rows) in enumerate(layout.lines.items()):
        points = layout.points(rows, mean.values)
        if not points:
            continue
        x, y, first = (np.array(part) for part in zip(*points))
        if not layout.axis:  # side by side, so that none hides another
            x = x + 0.2 * (n - (len(layout.lines) - 1) / 2)
        axes.plot(x, y, label=label, **look(n, layout))
        colour = style.SERIES[n % len(style.SERIES)]
        spread = np.nan_to_num(scatter.values[first])
        if spread.any():
            if layout.axis:
                axes.fill_between(x, y - spread, y + spread, color=colour, alpha=0.18, linewidth=0)
            axes.errorbar(x, y, spread, color=colour, fmt="none", capsize=3, linewidth=1)
    if reference:
        points = layout.points([k for rows in layout.lines.values() for k in rows], reference.values)
        if points:
            axes.plot(*list(zip(*points))[:2], color=style.INK, linestyle=":" if layout.axis else "none", marker="D", markersize=7,
                      markerfacecolor="none", markeredgewidth=1.4, label=reference.about)
    if layout.axis:
        places = sorted(set(layout.place.values()))
        if places[0] > 0 and places[-1] >= 10 * places[0]:
            axes.set_xscale("log")
        if len(places) <= 8:
            axes.set_xticks(places, [f"{p:g}" for p in places])
            axes.minorticks_off()
    else:
        axes.set_xticks(range(len(layout.labels)), layout.labels, rotation=30 if len(layout.labels) > 4 else 0)
        axes.margins(x=0.1)
    axes.set_xlabel(layout.name)
    axes.set_ylabel(folded(quantity.heading()))
    axes.ticklabel_format(axis="y", useOffset=False)


def folded(text, width=30):
    """A path that is longer than a picture is high, on two lines or more."""
    lines, line = [], ""
    for part in re.split(r"(?<=[./ ])", text):
        if line and len(line + part) > width:
            lines.append(line)
            line = ""
        line += part
    return "\n".join([*lines, line])


def draw_cost(axes, study, layout, quantity):
    """The same against the processor time of a setting's runs, the mean over its replicates."""
    mean, cpu, group = study.of(quantity, "mean").values, study.columns["cpu"].values, study.columns["replicates"].values
    for n, rows in enumerate(layout.lines.values()):
        points = layout.points(rows, mean)
        if not points:
            continue
        own = lambda place: [cpu[k] for k in rows if layout.place[k] == place and group[k] > 0]
        x, y = [np.mean(own(place)) for place, _, _ in points], [value for _, value, _ in points]
        ordered = sorted(x) in (x, x[::-1])  # a line that runs to and fro tells nothing
        axes.plot(x, y, **{**look(n, layout), **({} if ordered else {"linestyle": "none"})})
        for seconds, value, (_, _, k) in zip(x, y, points):
            axes.annotate(layout.mark[k], (seconds, value), textcoords="offset points", xytext=(5, 5), fontsize=7.5, color=style.GREY)
    shown = [line.get_xdata() for line in axes.lines]
    least, most = (f(map(f, shown), default=0) for f in (min, max))
    if least > 0 and most >= 10 * least:
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
        axes.xaxis.set_minor_formatter("")
        style.log_ticks(axes.xaxis, least, most)
    axes.margins(x=0.15, y=0.12)
    axes.set_xlabel("processor time [s]")


def draw_table(study, name, rows, path):
    layout = Layout(study, rows)
    quantities = [q for q in study.role("quantity") if not np.isnan(study.of(q, "mean").values[rows]).all()]
    if not quantities:
        return None
    figure, axes = plt.subplots(len(quantities), 2, figsize=(style.WIDTH + 1, 3.3 * len(quantities) + 0.6), squeeze=False, sharey="row",
                                layout="constrained")
    for (left, right), quantity in zip(axes, quantities):
        draw_lines(left, study, layout, quantity)
        draw_cost(right, study, layout, quantity)
        left.margins(y=0.12)
        values = np.concatenate([np.asarray(line.get_ydata(), float) for line in left.lines])
        if values.min() >= 0 and values.max() > 0 and values.min() < 0.6 * values.max():
            left.set_ylim(bottom=0)
        elif np.ptp(values) <= 1e-6 * np.abs(values).max():  # all the same: no picture of round-off
            left.set_ylim(values[0] - 0.1 * abs(values[0]) - 1e-12, values[0] + 0.1 * abs(values[0]) + 1e-12)
    axes[0, 0].set_title(name)
    axes[0, 1].set_title("what it costs")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    if any(labels):
        axes[0, 0].legend([h for h, label in zip(handles, labels) if label], [label for label in labels if label])
    return style.save(figure, path)


def rows_table(study, rows):
    """Each setting a line: what it sets, mean and scatter, reference, cost."""
    used = lambda c: any(c.shown(k) for k in rows)
    labels = [c for c in [study.columns["variant"], study.columns["mode"], *study.role("parameter")] if used(c)]
    quantities = [q for q in study.role("quantity") if used(study.of(q, "mean"))]
    numbers = []
    for q in quantities:
        numbers += [q.heading()] + ([study.of(q, "reference").about] if study.of(q, "reference") else [])
    body, seen = "", set()
    for k in rows:
        key = tuple(c.shown(k) for c in labels)
        status, count = study.columns["status"].values[k], int(study.columns["replicates"].values[k])
        if key in seen and status == "done":
            continue
        if status == "done":
            seen.add(key)
        cells = [f"<td>{escape(c.shown(k))}</td>" for c in labels]
        for q in quantities:
            value = lambda role: None if np.isnan(study.of(q, role).values[k]) else float(study.of(q, role).values[k])
            scatter = value("scatter")
            cells.append(f'<td class="n">{number(value("mean"))}{"" if scatter is None else f" ± {number(scatter, 2)}"}</td>')
            if study.of(q, "reference"):
                cells.append(f'<td class="n">{number(value("reference"))}</td>')
        cpu = float(np.mean([study.columns["cpu"].values[j] for j in rows if tuple(c.shown(j) for c in labels) == key]))
        end = status if status != "done" else f"done, {count} seeds" if count > 1 else "done"
        reason = study.columns["reason"].values[k]
        body += f'<tr>{"".join(cells)}<td class="n">{number(cpu, 3)}</td><td>{escape(end + (": " + reason if reason else ""))}</td></tr>'
    head = "".join(f"<th>{escape(c.heading())}</th>" for c in labels)
    head += "".join(f'<th class="n">{escape(h)}</th>' for h in [*numbers, "processor time [s]"]) + "<th>status</th>"
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>\n'


def study_page(study, out):
    count = {s: list(study.columns["status"].values).count(s) for s in ("done", "failed", "not run")}
    good = count["failed"] == count["not run"] == 0
    verdict = ", ".join(f"<b>{n}</b> rows {status}" for status, n in count.items() if n)
    body = ""
    if study.ladder:
        body += section("What accuracy costs", ladder_section(study.ladder, out / "ladder.png"))
    for name, rows in study.tables():
        if study.ladder and name == "ladder":
            continue
        drawn = draw_table(study, name, rows, out / f"{file_name(name)}.png")
        caption = ("Left: against what was set; bands and bars: scatter of the replicates (standard deviation). "
                   "Right: the same against the processor time that the runs of a point took, beside it what was set.")
        body += section(name, picture(drawn, caption) + rows_table(study, rows))
    a = study.attributes
    about = f"study {a['name']} · couloir {a['couloir_version']} ({a['git_revision']}) · {a['cpu']}"
    return page(str(a["title"]), about, f"{verdict}; {number(float(a['total_cpu']), 3)} s of processor time in all.", good, body)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, metavar="STUDY.H5")
    parser.add_argument("--out", type=Path, help="folder of the page and its pictures; default: beside the table")
    arguments = parser.parse_args()
    out = arguments.out or arguments.table.parent
    return write_page(out, lambda: study_page(Study(arguments.table), out), NoStudy)


if __name__ == "__main__":
    sys.exit(main())
