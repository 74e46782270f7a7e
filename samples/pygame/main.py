"""A curtain that is cut with the mouse, in pygame: python3 samples/pygame/main.py. R hangs a new one.

`--demo FOLDER` cuts by itself, writes pictures, and prints what came of it."""

import math
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bindings/python"))

import kiri
import pygame

WIDTH, HEIGHT = 960, 640
TICK = 1 / 60
SCALE = 2  # pixels drawn for one that is seen, along each side
BUDGET = {"cells": 32000, "samples": 4000}  # of work on cuts in a tick: about 2 ms
SKY, FLOOR, INK = (243, 234, 217), (206, 189, 163), (52, 46, 60)
SHADOW = (150, 146, 150)
STRIPES = ((214, 84, 61), (240, 196, 118))
LIGHT = (0.36, -0.80, 0.48)


class Camera:
    """Looks along y, with z up. A point of the world goes to a pixel, a pixel to a ray."""

    eye, height, focus = -3.2, 0.62, 1.75

    def pixel(self, x, y, z):
        scale = self.focus * HEIGHT / (y - self.eye)
        return WIDTH / 2 + scale * x, HEIGHT / 2 - scale * (z - self.height)

    def ray(self, pixel):
        scale = self.focus * HEIGHT
        return (0.0, self.eye, self.height), ((pixel[0] - WIDTH / 2) / scale, 1.0, (HEIGHT / 2 - pixel[1]) / scale)


class Curtain:
    """The world: a cloth on a rail, a ball that leans into it, and a floor."""

    def __init__(self):
        self.world = kiri.World(budget=BUDGET)
        self.world.create_obstacle(kiri.KIRI_OBSTACLE_PLANE, friction=0.8)
        self.world.create_obstacle(kiri.KIRI_OBSTACLE_SPHERE, radius=0.22, position=(0.15, 0.24, 0.45))
        setup = kiri.setup(kiri.SetupPreset.CURTAIN, 1.5, 1.0)
        setup.material.thickness, setup.material.density, setup.material.detail = 0.002, 150.0, 0  # felt: what falls lies flat, and is no heap
        setup.position, setup.axisV = (-0.75, 0.0, 0.18), (0, 0, 1)
        setup.collisionPoints, setup.touchesSheets = 400, 1
        self.sheet = self.world.create_rectangle(1.5, 1.0, **vars(setup))
        for i in range(7):
            u = 0.01 + 1.48 * i / 6
            self.sheet.create_pin((u, 0.99), (0.94 * (u - 0.75), 0.04 * (-1) ** i, 1.17))
        self.sheets, self.blade, self.way, self.cuts = [self.sheet], None, [], 0

    def tick(self):
        """The blade goes where the mouse was since the last tick, then all moves."""
        if self.way and not self.blade:
            self.blade = self.world.begin_blade()
            self.cuts += 1
        for origin, direction in self.way:
            if direction:
                self.blade.move_ray(origin, direction, 6.0)
            elif self.blade:
                self.blade.end()
                self.blade = None
        self.way.clear()
        self.world.tick(TICK, 2)


# ---- Drawing ---------------------------------------------------------------------------------------------------------


def color_of(rest, normal):
    """Stripes by where the material is, so that they stay on their pieces, with light from both sides."""
    stripe = STRIPES[int(20 * rest[0] / 1.5) % 2]
    light = 0.45 + 0.55 * abs(sum(a * b for a, b in zip(normal, LIGHT)))
    return tuple(int(min(255, light * part)) for part in stripe)


def spot(camera, x, y, z):
    """Where a point of the world is on the canvas, which has SCALE pixels for one of the window along each side."""
    return tuple(SCALE * part for part in camera.pixel(x, y, z))


def order_in(points, camera):
    """By what triangles of a piece are sorted, so that near ones cover far ones: the axis along which the piece is flattest,
    towards the eye. So the layers of a heap on the floor are drawn from below to above, those of a curtain from behind."""
    spans = [max(part) - min(part) for part in zip(*points)]
    middle = [sum(part) / len(points) for part in zip(*points)]
    axis = spans.index(min(spans))
    sign = 1 if (0.0, camera.eye, camera.height)[axis] > middle[axis] else -1
    return middle[1], lambda corners: sign * sum(corner[axis] for corner in corners)


def pieces_of(sheet, camera, look):
    """Of each piece: how far it is, and colour, corners and corners of the shadow of each triangle; the library's arrays are
    read without a copy. `look` keeps what only cuts change."""
    count = sheet.counts().pieces
    with sheet.mesh_view() as mesh:
        positions, normals, version = mesh.positions.tolist(), mesh.normals.tolist(), (mesh.revision, count)
        is_new = look.get("version") != version
        if is_new:
            look.update(version=version, rest=mesh.restPositions.tolist())
    if is_new:
        look["pieces"] = [[tuple(triangle) for triangle in sheet.piece_mesh(i, "indices").indices] for i in range(count)]
    pixels = [spot(camera, *position) for position in positions]
    shadows = [spot(camera, x + 0.35 * z, y + 0.55 * z, 0.0) for x, y, z in positions]
    for indices in look["pieces"]:
        away, order = order_in([positions[i] for triangle in indices for i in triangle], camera)
        drawn = []
        for a, b, c in sorted(indices, key=lambda triangle: order([positions[i] for i in triangle])):
            rest = [(look["rest"][a][i] + look["rest"][b][i] + look["rest"][c][i]) / 3 for i in (0, 1)]
            normal = [(p + q + r) / 3 for p, q, r in zip(normals[a], normals[b], normals[c])]
            drawn.append((color_of(rest, normal), (pixels[a], pixels[b], pixels[c]), (shadows[a], shadows[b], shadows[c])))
        yield away, drawn


def draw_ball(canvas, camera, radius, position):
    x, y = spot(camera, *position)
    size = SCALE * radius * camera.focus * HEIGHT / (position[1] - camera.eye)
    for i in range(48):
        part = i / 47
        shade = tuple(int(60 + 140 * part + more) for more in (0, 8, 20))
        pygame.draw.circle(canvas, shade, (x - 0.25 * part * size, y - 0.3 * part * size), size * (1 - 0.92 * part))


def make_ground(camera):
    """Wall and floor, which get darker away from the lamp."""
    ground, horizon = pygame.Surface((SCALE * WIDTH, SCALE * HEIGHT)), SCALE * camera.pixel(0, 8.0, 0.0)[1]
    for y in range(SCALE * HEIGHT):
        floor, part = y > horizon, y / (SCALE * HEIGHT)
        light = 0.72 + 0.28 * part if floor else 1.04 - 0.22 * part
        color = tuple(min(255, int(light * one)) for one in (FLOOR if floor else SKY))
        pygame.draw.line(ground, color, (0, y), (SCALE * WIDTH, y))
    return ground


def draw_shadow(canvas, corners_of_all):
    """On a surface of a few pixels, which soften when they are spread."""
    few = pygame.Surface((WIDTH // 2, HEIGHT // 2))
    few.fill("white")
    for corners in corners_of_all:
        pygame.draw.polygon(few, SHADOW, [(x / SCALE / 2, y / SCALE / 2) for x, y in corners])
    for part in (4, 8, 4, 1 / SCALE):
        few = pygame.transform.smoothscale(few, (int(WIDTH / part), int(HEIGHT / part)))
    canvas.blit(few, (0, 0), special_flags=pygame.BLEND_MULT)


def draw(screen, curtain, camera, looks, font):
    if "canvas" not in looks:
        looks.update(canvas=pygame.Surface((SCALE * WIDTH, SCALE * HEIGHT)), ground=make_ground(camera))
    canvas = looks["canvas"]
    canvas.blit(looks["ground"], (0, 0))
    pieces = [piece for sheet in curtain.sheets for piece in pieces_of(sheet, camera, looks.setdefault(sheet.id, {}))]
    pieces.sort(key=lambda piece: -piece[0])
    drawn = [triangle for _, triangles in pieces for triangle in triangles]
    draw_shadow(canvas, (corners for _, _, corners in drawn))
    draw_ball(canvas, camera, 0.21, (0.15, 0.24, 0.45))
    for color, corners, _ in drawn:
        pygame.draw.polygon(canvas, color, corners)
    pygame.draw.line(canvas, INK, spot(camera, -0.8, 0, 1.18), spot(camera, 0.8, 0, 1.18), 6 * SCALE)
    pygame.transform.smoothscale(canvas, (WIDTH, HEIGHT), screen)
    screen.blit(font.render(f"drag to cut   R: a new curtain   cuts {curtain.cuts}   pieces {len(pieces)}", True, INK), (16, 12))


# ---- The mouse, or a script ------------------------------------------------------------------------------------------

# From tick, to tick, and pixels between which the mouse goes.
STROKES = ((40, 70, (200, 260), (540, 560)), (100, 125, (760, 200), (500, 560)))


def circle(tick):
    """A disc out of the middle, from tick 150 to 190."""
    angle = 2.2 * math.pi * (tick - 150) / 40
    return 330 + 60 * math.cos(angle), 240 + 60 * math.sin(angle)


def script(curtain, camera, tick):
    for first, last, start, end in STROKES:
        if first <= tick <= last:
            share = (tick - first) / (last - first)
            curtain.way.append(camera.ray([a + share * (b - a) for a, b in zip(start, end)]))
        if tick == last:
            curtain.way.append((None, None))
    if 150 <= tick <= 190:
        curtain.way.append(camera.ray(circle(tick)))
    if tick == 190:
        curtain.way.append((None, None))


def mouse(curtain, camera, event):
    if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
        curtain.way.append(camera.ray(event.pos))
    elif event.type == pygame.MOUSEMOTION and event.buttons[0]:
        curtain.way.append(camera.ray(event.pos))
    elif event.type == pygame.MOUSEBUTTONUP and event.button == 1:
        curtain.way.append((None, None))


def demo(screen, camera, font, folder):
    curtain, looks = Curtain(), {}
    for tick in range(331):
        script(curtain, camera, tick)
        curtain.tick()
        if tick in (30, 68, 124, 195, 330):
            draw(screen, curtain, camera, looks, font)
            name = f"pygame_{tick:03}.png"
            pygame.image.save(screen, os.path.join(folder, name))
            red = sum(screen.get_at((x, y))[0] > 1.6 * screen.get_at((x, y))[2] for x in range(0, WIDTH, 4)
                      for y in range(0, HEIGHT, 4))
            print(f"picture {name} cloth {red / (WIDTH * HEIGHT / 16):.3f}")
    print(f"cuts {curtain.cuts} pieces {curtain.sheet.counts().pieces} hash {curtain.world.state_hash():016x}")


def play(screen, camera, font):
    curtain, looks, clock, late = Curtain(), {}, pygame.time.Clock(), 0.0
    while True:
        for event in pygame.event.get():
            if event.type == pygame.QUIT or event.type == pygame.KEYDOWN and event.key == pygame.K_ESCAPE:
                return
            if event.type == pygame.KEYDOWN and event.key == pygame.K_r:
                curtain, looks = Curtain(), {}
            mouse(curtain, camera, event)
        late = min(late + clock.tick(60) / 1000, 4 * TICK)  # ticks are fixed, pictures come when they come
        while late >= TICK:
            curtain.tick()
            late -= TICK
        draw(screen, curtain, camera, looks, font)
        pygame.display.flip()


def main():
    pygame.display.init()
    pygame.font.init()
    pygame.display.set_caption("Kiri in pygame")
    screen = pygame.display.set_mode((WIDTH, HEIGHT))
    font = pygame.font.Font(None, 26)
    if "--demo" in sys.argv:
        demo(screen, Camera(), font, sys.argv[sys.argv.index("--demo") + 1])
    else:
        play(screen, Camera(), font)


if __name__ == "__main__":
    main()
