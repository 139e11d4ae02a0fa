#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws docs/images/wireframe.svg: the wireframe of the bottle's first face in its parameter plane.

Usage: wireframe.py [UMBILIC_COMMAND]
"""
import json
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
command = sys.argv[1] if len(sys.argv) > 1 else str(here.parents[1] / "build/release/bin/umbilic")
model = here.parents[1] / "models" / "bottle.step"
run = subprocess.run(
    [command, "wireframe", str(model), "--face", "1", "--quiet", "--json", "-"], capture_output=True, check=True, text=True
)
face = json.loads(run.stdout)["faces"][0]
nodes = [(node["u"], node["v"]) for node in face["nodes"]]
low = [min(node[k] for node in nodes) for k in (0, 1)]
high = [max(node[k] for node in nodes) for k in (0, 1)]
size, margin = 600, 8
colours = {"maximum": "#c0392b", "minimum": "#2460a7", "geodesic": "#999", "boundary": "#222"}


def place(i):
    x, y = ((nodes[i][k] - low[k]) / (high[k] - low[k]) for k in (0, 1))
    return f"{margin + size * x:.1f}", f"{margin + size * (1 - y):.1f}"


lines = [
    f'<svg xmlns="http://www.w3.org/2000/svg" width="{size + 2 * margin}" height="{size + 2 * margin}">',
    '<rect width="100%" height="100%" fill="white"/>',
]
for cell in face["cells"]:
    if len(cell) == 4:
        corners = " ".join(",".join(place(i)) for i in cell)
        lines.append(f'<polygon points="{corners}" fill="#eef3e6"/>')
for edge in face["edges"]:
    (x, y), (a, b) = place(edge["from"]), place(edge["to"])
    lines.append(f'<line x1="{x}" y1="{y}" x2="{a}" y2="{b}" stroke="{colours[edge["kind"]]}" stroke-width="1.2"/>')
for i in range(len(nodes)):
    x, y = place(i)
    lines.append(f'<circle cx="{x}" cy="{y}" r="2" fill="#222"/>')
lines.append("</svg>")
(here / "wireframe.svg").write_text("\n".join(lines) + "\n")
