"""Cuts a sheet that hangs by two corners, and plots its pieces: flat, and as they fall. Needs numpy and matplotlib.

    python3 pieces.py [PICTURE]    a window, or a file such as pieces.png"""

import sys

import matplotlib
if len(sys.argv) > 1:
    matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import kiri

world = kiri.World()
sheet = world.create_rectangle(1.0, 1.0, 48, 48, frameCount=25, position=(0, 0, -1), axisU=(1, 0, 0), axisV=(0, 0, 1))
for corner in (0.0, 1.0):
    sheet.create_pin((corner, 1.0), (corner, 0.0, 0.0))

turn = np.linspace(0, 2 * np.pi, 61)
circle = np.stack([0.5 + 0.25 * np.cos(turn), 0.6 + 0.25 * np.sin(turn)], axis=1)
across = np.stack([np.linspace(-0.1, 1.1, 40), 0.2 + 0.05 * np.sin(np.linspace(0, 20, 40))], axis=1)
for line in (circle, across):
    cut = sheet.begin_cut(line[0])
    cut.extend(line[1:])
    cut.end()
for _ in range(18):
    world.tick(1 / 60)

figure = plt.figure(figsize=(11, 5), layout="constrained")
flat = figure.add_subplot(1, 2, 1, title="pieces in the rest plane", xlabel="u, m", ylabel="v, m", aspect="equal")
space = figure.add_subplot(1, 2, 2, projection="3d", title="after 0.3 s", xlabel="x, m", ylabel="y, m", zlabel="z, m")
mesh = sheet.mesh("positions", "restPositions")
for index in range(sheet.counts().pieces):
    state, triangles = sheet.piece(index), sheet.piece_mesh(index).indices
    color = f"C{index}"
    flat.triplot(*mesh.restPositions.T, triangles, color=color, linewidth=0.5)[0].set_label(f"{state.area:.3f} m²")
    space.plot_trisurf(*mesh.positions.T, triangles=triangles, color=color, linewidth=0)
flat.legend(loc="upper right")
space.set(ylim=(-0.25, 0.25), yticks=(-0.2, 0, 0.2))
space.set_box_aspect((1, 0.5, np.ptp(mesh.positions[:, 2])))
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1], dpi=100)
else:
    plt.show()
print(sheet.counts().pieces, "pieces")
