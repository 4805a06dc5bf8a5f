"""The pictures of one run. Each function saves one PNG and returns its path, or None where the run has nothing to show."""

from functools import cache

import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.patches import Rectangle

import bodies
import style
from read import pick, running_mean
from style import plt

MM = 1e3


@cache
def wet_depth(run):
    """[m] above which a cell counts as flow in the pictures."""
    return max(0.25 * run.diameter if run.mode != "continuum" else 0, 0.01 * deepest(run))


@cache
def deepest(run, share=99.8):
    """[m] a robust largest depth, so that one splash does not take the colours from all the rest."""
    depths = [run.depth(frame)[2] for frame in pick(run.frames, 12)]
    most = max(float(h.max()) for h in depths)
    wet = np.concatenate([h[h > 1e-4 * most] for h in depths])
    return float(np.percentile(wet, share)) if wet.size else 1e-3


def extent(run, frames):
    """(x from, to, y from, to) [m] that holds the flow of these frames, its outermost cells whole, and the obstacles, with a
    margin."""
    wet = wet_depth(run)
    x, y, h = run.depth(frames[0])
    shape = np.any([run.depth(frame)[2] > wet for frame in frames], axis=0)
    columns, rows = np.flatnonzero(shape.any(axis=0)), np.flatnonzero(shape.any(axis=1))
    half_x = (x[1] - x[0]) / 2
    half_y = (y[1] - y[0]) / 2 if len(y) > 1 else half_x  # one row is drawn as square cells
    left, right, low, high = x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y
    xs = [x[columns[0]] - half_x, x[columns[-1]] + half_x] if columns.size else [left, right]
    ys = [y[rows[0]] - half_y, y[rows[-1]] + half_y] if rows.size else [low, high]
    for o in run.obstacles.values():
        xs += [o["x"], o["x"] + o["length"]]
        ys += [o["y"] - o["width"] / 2, o["y"] + o["width"] / 2]
    margin = 0.04 * (max(xs) - min(xs)) + 0.01
    return (max(left, min(xs) - margin), min(right, max(xs) + margin), max(low, min(ys) - margin), min(high, max(ys) + margin))


def common_instants(runs, count):
    """For each of at most `count` frames of the run with the fewest, in the time that all cover, the nearest frame of each run."""
    last = min(run.frames[-1].time for run in runs)
    first = max(run.frames[0].time for run in runs)
    coarse = min(runs, key=lambda run: len(run.frames))
    wanted = [frame.time for frame in pick(coarse.frames, count, first, last)]
    return [[min(run.frames, key=lambda frame: abs(frame.time - t)) for run in runs] for t in wanted]


def common_box(runs, rows):
    """(x from, to, y from, to) [m] that holds the flow of all runs in all rows of frames."""
    boxes = np.array([extent(run, [row[k] for row in rows]) for k, run in enumerate(runs)])
    return boxes[:, 0].min(), boxes[:, 1].max(), boxes[:, 2].min(), boxes[:, 3].max()


def draw_obstacles_from_above(axes, run):
    for o in run.obstacles.values():
        if "triangles" in o:
            axes.add_collection(PolyCollection(bodies.seen_from_above(o["triangles"]) * MM, facecolor="#FFFFFF", edgecolor=style.INK,
                                               linewidth=0, hatch="/////", zorder=4))
            axes.add_collection(LineCollection(bodies.outline(o["triangles"]) * MM, colors=style.INK, linewidths=1.3, zorder=4))
            continue
        axes.add_patch(Rectangle((o["x"] * MM, (o["y"] - o["width"] / 2) * MM), o["length"] * MM, o["width"] * MM,
                                 facecolor="#FFFFFF", edgecolor=style.INK, linewidth=1.3, hatch="/////", zorder=4))


def outline(x, y, wet):
    """Segments [n, 2, (x, y)] of the cells' edges between wet and dry: a line between the centres would lie beside the colours."""
    dx, dy = x[1] - x[0], (y[1] - y[0]) if len(y) > 1 else x[1] - x[0]
    j, i = np.nonzero(wet[:, 1:] != wet[:, :-1])
    upright = np.stack([x[i] + dx / 2, y[j] - dy / 2, x[i] + dx / 2, y[j] + dy / 2], axis=-1)
    j, i = np.nonzero(wet[1:] != wet[:-1])
    level = np.stack([x[i] - dx / 2, y[j] + dy / 2, x[i] + dx / 2, y[j] + dy / 2], axis=-1)
    return np.concatenate([upright, level]).reshape(-1, 2, 2)


def draw_depth(axes, run, frame, top, box):
    """Depth from above with the outline of the flow, of the obstacles and of the zone; returns the image."""
    x, y, h = run.finest_depth(frame, box)
    dx, dy = x[1] - x[0], (y[1] - y[0]) if len(y) > 1 else x[1] - x[0]
    wet = wet_depth(run)
    image = axes.imshow(np.ma.masked_less(h, wet) * MM, origin="lower", cmap=style.DEPTH, vmin=0, vmax=top * MM, aspect="equal",
                        extent=[(x[0] - dx / 2) * MM, (x[-1] + dx / 2) * MM, (y[0] - dy / 2) * MM, (y[-1] + dy / 2) * MM],
                        interpolation="nearest")
    axes.add_collection(LineCollection(outline(x, y, h > wet) * MM, colors=style.INK, linewidths=0.8))
    for a, b, c, d in frame.zones * MM:
        axes.add_patch(Rectangle((a, c), b - a, d - c, fill=False, edgecolor=style.RED, linewidth=1.4, linestyle="--", zorder=5))
    draw_obstacles_from_above(axes, run)
    style.plain_map(axes)
    axes.set_xlim(box[0] * MM, box[1] * MM)
    axes.set_ylim(box[2] * MM, box[3] * MM)
    return image


def panels(count, box):
    """A figure with `count` maps of the box's proportions: in three columns where they are tall, in one where they are wide."""
    ratio = max(box[3] - box[2], 0.06 * (box[1] - box[0])) / (box[1] - box[0])
    columns = min(count, 1 if ratio < 0.15 else 2 if ratio < 0.8 else 3)
    figure, axes = style.map_grid(-(-count // columns), columns, ratio)
    for spare in axes.flat[count:]:
        spare.set_visible(False)
    for a in axes[:, 0]:
        a.set_ylabel("y [mm]")
    return figure, axes


def top_view(run, path, count=6):
    if not run.frames or not (run.has_flow or run.has_grains):
        return None
    frames = pick(run.frames, count)
    box, top = extent(run, frames), deepest(run)
    figure, axes = panels(len(frames), box)
    for a, frame in zip(axes.flat, frames):
        image = draw_depth(a, run, frame, top, box)
        a.set_title(f"t = {frame.time:.3f} s")
    style.colour_bar(figure, axes, image, "depth along the normal [mm]")
    return style.save(figure, path)


def same_mesh(frames):
    return all(np.array_equal(frame.places, frames[0].places) for frame in frames)


def draw_mesh(axes, run, frame):
    """The outlines of all blocks, of the coarsest ones in grey."""
    x, y, _ = run.grid
    dx = x[1] - x[0]
    dy = y[1] - y[0] if len(y) > 1 else dx
    for level in np.unique(frame.places[:, 0]):
        _, i0, j0, nx, ny = frame.places[frame.places[:, 0] == level].T
        a, b = x[0] + (np.array([i0, i0 + nx]) / 2.0**level - 0.5) * dx
        c, d = y[0] + (np.array([j0, j0 + ny]) / 2.0**level - 0.5) * dy
        outlines = np.stack([np.stack(corner, axis=-1) for corner in ((a, c), (b, c), (b, d), (a, d), (a, c))], axis=1)
        axes.add_collection(LineCollection(outlines * MM, colors=style.INK if level else style.GREY, linewidths=0.5, zorder=5))


def mesh_view(run, path):
    """The mesh over the flow: once where it stays, else at four instants."""
    frames = [frame for frame in run.frames if len(frame.places)] if run.has_flow else []
    if not frames:
        return None
    shown = frames[len(frames) // 2:][:1] if same_mesh(frames) else pick(frames, 5)[1:]
    box, top = extent(run, shown), deepest(run)
    figure, axes = panels(len(shown), box)
    for a, frame in zip(axes.flat, shown):
        image = draw_depth(a, run, frame, top, box)
        draw_mesh(a, run, frame)
        cells = int(np.sum(frame.places[:, 3] * frame.places[:, 4]))
        a.set_title(f"t = {frame.time:.3f} s: {len(frame.places)} blocks, {cells} cells")
    style.colour_bar(figure, axes, image, "depth along the normal [mm]")
    return style.save(figure, path)


def side_box(run, frames, name):
    """Middle y and (x from, to, top) [m] of the side view: about this obstacle, or the whole flow."""
    box = extent(run, frames)
    top = 1.3 * deepest(run, 100)
    if name is None:
        return 0.0, box[0], box[1], top
    o = run.obstacles[name]
    top = max(top, 1.5 * o["height"])
    held = [z for f in reversed(frames) for z in f.zones if z[0] <= o["x"] <= z[1] and z[2] <= o["y"] <= z[3]]
    if held:
        zone = held[0]
        margin = 0.15 * (zone[1] - zone[0])
        return o["y"], zone[0] - margin, zone[1] + margin, top
    reach = 5 * max(o["height"], o["length"])
    return o["y"], max(box[0], o["x"] - reach), min(box[1], o["x"] + o["length"] + 0.6 * reach), top


def in_section(run, frame, middle):
    """The grains (as of Frame.grains) within two diameters of the section, the nearest ones last; None where there are none."""
    grains = frame.grains()
    if grains is None:
        return None
    off = np.abs(grains["y"] - middle)
    near = np.flatnonzero(off < 2 * (run.diameter or 0.005))
    return {name: values[near[np.argsort(-off[near])]] for name, values in grains.items()} if near.size else None


def draw_side(axes, run, frame, middle, fastest):
    grains = in_section(run, frame, middle)
    dots = None
    if run.has_flow:
        x, y, bed = run.grid
        row = int(np.argmin(np.abs(y - middle)))
        h, base = frame.flow("h")[row], bed[row]
        wet = h > wet_depth(run)
        axes.fill_between(x * MM, base * MM, (base + h) * MM, where=wet, color="#DCE6EE", linewidth=0, step="mid", zorder=1)
        line = np.where(wet, base + h, np.nan)
        axes.plot(x * MM, line * MM, color=style.BLUE, linewidth=1.6, zorder=4, label="surface of the flow")
    if grains is not None:
        size = 2 * grains["radius"] * MM
        dots = EllipseCollection(size, size, np.zeros(len(size)), units="x", transOffset=axes.transData, cmap=style.SPEED,
                                 offsets=np.column_stack([grains["s"], grains["n"]]) * MM,
                                 edgecolors="#20303A", linewidths=0.25, zorder=2)
        dots.set_array(grains["speed"])
        dots.set_clim(0, fastest)
        axes.add_collection(dots)
    for o in run.obstacles.values():
        if "triangles" in o:
            axes.add_collection(PolyCollection([loop * MM for loop in bodies.section(o["triangles"], middle)], facecolor="#C9CDD1",
                                               edgecolor=style.INK, linewidth=1.2, hatch="////", zorder=3))
        elif abs(o["y"] - middle) <= o["width"] / 2:
            axes.add_patch(Rectangle((o["x"] * MM, 0), o["length"] * MM, o["height"] * MM, facecolor="#C9CDD1",
                                     edgecolor=style.INK, linewidth=1.2, hatch="////", zorder=3))
    axes.axhline(0, color=style.INK, linewidth=1.4, zorder=3)
    return dots


def upper_sides(grains, x0, x1):
    """[m] of the grains of a section between x0 and x1: how high they reach."""
    if grains is None:
        return np.array([])
    return (grains["n"] + grains["radius"])[(grains["s"] > x0) & (grains["s"] < x1)]


def side_frames(run, name, count):
    """From the first contact with this obstacle on."""
    contact = (run.figure(("obstacles", name, "first_contact")) if name else None) or np.inf
    late = [f for f in run.frames if f.time >= contact - 0.02]
    return pick(late if len(late) >= count else run.frames if contact == np.inf else run.frames[-count:], count)


def side_views(run, folder):
    """{name of an obstacle, or None where there is none: picture of the section through its middle}; one that another's section
    shows has none of its own."""
    if not run.frames or not (run.has_flow or run.has_grains):
        return {}
    boxes, views = [], {}
    for name in run.obstacles or [None]:
        o = run.obstacles.get(name)
        if o and any(abs(o["y"] - middle) <= o["width"] / 2 and x0 <= o["x"] <= x1 for middle, x0, x1, _ in boxes):
            continue
        frames = side_frames(run, name, count=4)
        boxes.append(side_box(run, frames, name))
        views[name] = side_view(run, frames, boxes[-1], folder / ("side.png" if not views else f"side_{len(views) + 1}.png"))
    return views


def side_view(run, frames, box, path):
    middle, x0, x1, top = box
    sections = [in_section(run, frame, middle) for frame in frames]
    highest = [upper_sides(grains, x0, x1) for grains in sections]
    top = max([top] + [min(h.max(), 0.5 * (x1 - x0)) for h in highest if h.size])
    ratio = 1.08 * top / (x1 - x0)
    columns = 2 if ratio > 0.25 else 1
    figure, axes = style.map_grid(-(-len(frames) // columns), columns, ratio)
    speeds = np.concatenate([g["speed"] for g in sections if g] or [[]])
    fastest = max(float(np.percentile(speeds, 99.5)), 1e-3) if speeds.size else 1
    dots = None
    for a, frame, heights in zip(axes.flat, frames, highest):
        dots = draw_side(a, run, frame, middle, fastest) or dots
        style.plain_map(a)
        a.set_xlim(x0 * MM, x1 * MM)
        a.set_ylim(-0.06 * top * MM, 1.02 * top * MM)
        out = np.sum(heights > top * 1.02)
        a.set_title(f"t = {frame.time:.3f} s" + (f"; {out} higher, up to {heights.max() * MM:.0f} mm" if out else ""))
    for spare in axes.flat[len(frames):]:
        spare.set_visible(False)
    figure.supylabel("height [mm]", fontsize=10)
    if dots is not None:
        style.colour_bar(figure, axes, dots, "speed of the grains [m/s]")
    return style.save(figure, path)


def packing_means(run, name):
    """The 15 ms mean of each packing's force [N] at this run's times: an array (packings, times)."""
    times = run.forces[name]["time"]
    means = []
    for one in run.packings:
        f = one.forces[name]
        means.append(np.interp(times, f["time"], running_mean(f["time"], one.windows["length"], f["fx"])))
    return np.array(means)


def forces(run, path):
    """Raw window means, their 15 ms mean, the peak; with several packings the band of their 15 ms means."""
    if not run.forces or not len(run.time):
        return None
    figure, axes = plt.subplots(len(run.forces), 1, figsize=(style.WIDTH, 3.4 * len(run.forces)), sharex=True, squeeze=False,
                                layout="constrained")
    for a, (name, f) in zip(axes.flat, run.forces.items()):
        mean = running_mean(f["time"], run.windows["length"], f["fx"])
        a.plot(f["time"], f["fx"], color=style.SKY, linewidth=0.8, label="mean of a window")
        if run.packings:
            every = packing_means(run, name)
            middle, scatter = every.mean(axis=0), every.std(axis=0, ddof=1)
            a.fill_between(f["time"], middle - scatter, middle + scatter, color=style.ORANGE, alpha=0.45, linewidth=0, zorder=3,
                           label=f"mean and scatter of {len(every)} packings")
            a.plot(f["time"], middle, color=style.ORANGE, linewidth=2.2, zorder=3)
        label = "mean of 15 ms" + (", first packing" if run.packings else "")
        a.plot(f["time"], mean, color=style.BLUE, linewidth=1.2 if run.packings else 2.2, label=label, zorder=4)
        at, peak = run.peak(name)
        if peak != 0:
            whose = " of the first packing" if run.packings else ""
            a.plot(at, peak, "o", color=style.RED, markersize=7, zorder=5, label=f"peak{whose} {style.short(peak)} N at {at:.3f} s")
        a.axhline(0, color=style.GREY, linewidth=0.8)
        a.set_title(f"Force on {name}, along the slope")
        a.set_ylabel("force [N]")
        a.set_xlim(f["time"][0] - run.windows["length"][0], f["time"][-1])
        a.margins(y=0.12)
        a.legend(loc="best")
    axes.flat[-1].set_xlabel("time [s]")
    return style.save(figure, path)
