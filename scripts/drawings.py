#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""drawings.py [--check]: draws docs/images/layers.svg, from the table of tests/repository/check_includes.sh, and
docs/images/frame.svg, whose files must be there. --check: fails where the drawings are not these any more."""
import html
import os
import re
import sys

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# What a frame goes through: title, the steps as (what, where), of which the last one hands over.
FRAME = [
    ("your program", [("arrays: centres, vertices, radii, indices", "include/cgt/cgt.h")]),
    ("cgt_scene_commit", [
        ("arrays that cannot be read in place are copied", "src/builders/order/copy_arrays.c"),
        ("bounds, validity, sizes: one pass", "src/kernel/builders/bound_vectors.c"),
        ("choose: loose grid or BVH", "src/builders/commit.c"),
        ("grid: levels of sizes, sort into cells", "src/builders/grid/loose_grid_commit.c"),
        ("or BVH: sort, split, nodes, leaves", "src/builders/bvh/bvh_commit.c"),
    ]),
    ("cgt_trace_camera, cgt_occluded_frame", [
        ("tiles of 64 x 64 pixels, each a task", "src/trace/trace_camera.c"),
        ("march through cells, near to far", "src/kernel/tile/tile_march.h"),
        ("cull cells that are outside or behind", "src/kernel/tile_frame/tile_cull.h"),
        ("references wait for their data", "src/kernel/tile/prefetch_queue.h"),
        ("draw: a vector of rays a step", "src/kernel/tile_draw/tile_sphere_draw.h"),
        ("decide exactly what floats leave open", "src/exact/decide.c"),
        ("t, ids, normals, u, v", "src/kernel/tile_frame/tile_resolve.c"),
    ]),
    ("cgt_trace_rays, cgt_occluded_rays, ...", [
        ("chunks of rays, each a task", "src/trace/trace_rays.c"),
        ("streams: many rays a node", "src/kernel/stream/stream_trace.c"),
        ("rays alone in a node", "src/kernel/stream/stream_single.c"),
        ("decide exactly what floats leave open", "src/exact/decide.c"),
        ("t, ids, normals, u, v", "src/kernel/entry/entry_rays.c"),
    ]),
    ("your program", [("planes of the frame, arrays of hits", "include/cgt/cgt.h")]),
]

STYLE = """<style>
text { font: 13px sans-serif; fill: #222 } .where { font: 11px monospace; fill: #555 } .head { font-weight: bold }
rect { fill: #f6f6f4; stroke: #888 } .row { fill: none; stroke: #ccc } .kernel { fill: #e8f0f8 } .papers { fill: #f6efe2 }
path { stroke: #888; fill: none; marker-end: url(#end) }
</style><defs><marker id="end" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto"><path
d="M0,0 L8,4 L0,8" style="marker-end: none"/></marker></defs>"""


def svg(width, height, parts):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}">\n{STYLE}\n<rect width="{width}" height="{height}" style="fill: #fff; stroke: none"/>\n'
            + "\n".join(parts) + "\n</svg>\n")


def text(x, y, words, kind=""):
    return f'<text x="{x}" y="{y}" class="{kind}">{html.escape(words)}</text>'


def box(x, y, width, height, kind=""):
    return f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="4" class="{kind}"/>'


def read_layers():
    with open(os.path.join(TOP, "tests/repository/check_includes.sh"), encoding="utf-8") as file:
        table = re.search(r"^layers='\n(.*?)^'", file.read(), re.M | re.S).group(1)
    return {name: rest.split() for name, rest in (line.split(":") for line in table.splitlines())}


def rank(name, layers, above=()):
    if name in above:
        sys.exit(f"drawings.py: folders include each other: {' '.join(above)} {name}")
    return 1 + max((rank(other, layers, above + (name,)) for other in layers[name]), default=0)


def draw_layers():
    layers = read_layers()
    missing = [name for name in layers if not os.path.isdir(os.path.join(TOP, "src", name))]
    if missing:
        sys.exit(f"drawings.py: no folder src/{missing[0]}")
    rows = {}
    for name in layers:
        rows.setdefault(rank(name, layers), []).append(name)
    around = [("programs, tests, bench, examples, python", ""), ("picture, mpi, programs/trajectory: libraries of their own", ""),
              ("include/cgt: the public API", ""), ("backends: threads; a simulated Cell", "")]
    wide = 8.2
    width = max(sum(len(n) * wide + 24 for n in names) for names in rows.values()) + 40
    width, y, parts = int(max(width, 640)), 16, []
    for words, kind in around:
        parts += [box(16, y, width - 32, 28, kind), text(26, y + 19, words)]
        y += 34
    parts.append(text(16, y + 16, "src: a folder may include some of those in rows below it", "head"))
    y += 26
    for r in sorted(rows, reverse=True):
        x = 16
        for name in sorted(rows[r]):
            w = int(len(name) * wide + 16)
            kind = "kernel" if name.startswith("kernel") else "papers" if name.startswith("papers") else ""
            parts += [box(x, y, w, 28, kind), text(x + 8, y + 19, name)]
            x += w + 8
        y += 34
    parts += [box(16, y, width - 32, 28), text(26, y + 19, "simd: the words of the SPU on today's vectors")]
    y += 48
    for kind, words in (("", "compiled once"), ("kernel", "compiled for each instruction set"), ("papers", "the papers' structures")):
        parts += [box(16, y - 12, 16, 16, kind), text(40, y + 1, words)]
        y += 22
    return svg(width, y, parts)


def draw_frame():
    parts, y, width, places = [], 16, 720, {}
    lefts = {2: (16, 344), 3: (372, 332)} # two ways beside each other
    for i, (title, steps) in enumerate(FRAME):
        left, wide = lefts.get(i, (16, 688))
        if i == 3:
            y = places[2][0]
        height = 26 + 40 * len(steps)
        places[i] = (y, y + height)
        parts += [box(left, y, wide, height, "kernel" if i in lefts else ""), text(left + 10, y + 18, title, "head")]
        for k, (what, where) in enumerate(steps):
            if not os.path.isfile(os.path.join(TOP, where)):
                sys.exit(f"drawings.py: no file {where}")
            parts += [text(left + 10, y + 38 + 40 * k, what), text(left + 10, y + 54 + 40 * k, where, "where")]
        y += height + 28
        if i == 3:
            y = max(places[2][1], places[3][1]) + 28
    ways = [(188, places[0][1], places[1][0]), (188, places[1][1], places[2][0]), (538, places[1][1], places[3][0]),
            (188, places[2][1], places[4][0]), (538, places[3][1], places[4][0])]
    parts += [f'<path d="M{x},{a} L{x},{b}"/>' for x, a, b in ways]
    return svg(width, places[4][1] + 16, parts)


def main():
    status = 0
    for name, draw in (("layers", draw_layers), ("frame", draw_frame)):
        path, drawn = os.path.join(TOP, f"docs/images/{name}.svg"), draw()
        if sys.argv[1:] == ["--check"]:
            with open(path, encoding="utf-8") as file:
                if file.read() != drawn:
                    print(f"FAILED: {path} is not what scripts/drawings.py draws: run it")
                    status = 1
        else:
            with open(path, "w", encoding="utf-8") as file:
                file.write(drawn)
    return status


if __name__ == "__main__":
    sys.exit(main())
