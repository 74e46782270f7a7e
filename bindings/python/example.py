"""Cuts a sheet that hangs by two corners, and prints what comes of it. Needs cffi and `make lib`; numpy is not needed."""

import sys

try:
    import kiri
    kiri.load()
except ImportError as error:
    sys.exit(f"example.py: {error}")


def main():
    world = kiri.World()
    sheet = world.create_rectangle(1.0, 1.0, 24, 24, frameCount=9, axisU=(1, 0, 0), axisV=(0, 0, 1))
    for corner in (0.0, 1.0):
        sheet.create_pin((corner, 1.0), (corner, 0.0, 1.0))

    cut = sheet.begin_cut((-0.1, 0.4))
    for tick in range(60):
        if tick < 22:
            cut.extend([(0.05 * tick, 0.4 + 0.1 * (tick % 2))])
        elif tick == 22:
            cut.end()
        world.tick(1 / 60)
        for event in world.events():
            if event.type == kiri.KIRI_EVENT_PIECE_OFF:
                print(f"tick {tick}: a piece of {event.area:.3f} m^2 came off")

    counts = sheet.counts()
    mesh = sheet.mesh("positions")
    lowest = min(mesh.positions[i, 2] for i in range(mesh.vertexCount))
    print(f"{counts.vertices} vertices, {counts.triangles} triangles, {counts.frames} frames, {counts.pieces} pieces")
    print(f"lowest vertex at {lowest:.2f} m, state hash {world.state_hash():016x}")


if __name__ == "__main__":
    main()
