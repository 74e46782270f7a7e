"""Holds a picture of the paper of macroquad and Godot against what it should show: check_paper.py PICTURE.png."""

import struct
import sys
import zlib


def pixels_of(path):
    """Rows of (red, green, blue) of a PNG of 8 bits and 4 channels."""
    data, at, packed = open(path, "rb").read(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
            assert (depth, colour) == (8, 6), "8 bits, red, green, blue and opacity"
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    raw, stride, before, rows = zlib.decompress(packed), 4 * width, bytearray(4 * width), []
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            a, b, c = (line[i - 4] if i >= 4 else 0), before[i], (before[i - 4] if i >= 4 else 0)
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        rows.append([tuple(line[i:i + 3]) for i in range(0, stride, 4)])
        before = line
    return rows


def is_paper(pixel):
    """Near white, or in shade, and not the sky, which is bluish."""
    return min(pixel) > 110 and 0 <= pixel[0] - pixel[2] < 14


def main(path):
    rows = pixels_of(path)
    at = lambda share: int(share * len(rows))
    ball = sum(pixel[2] > pixel[0] + 60 for row in rows for pixel in row)
    paper = lambda first, last: sum(map(is_paper, sum(rows[at(first):at(last)], [])))
    hangs, between, fell = paper(0, 0.4), paper(0.42, 0.58), paper(0.6, 1)
    print(f"{path}: {ball} pixels of the ball, {hangs} of paper that hangs, {between} under it, {fell} of what fell")
    assert ball > 5000 and hangs > 20000 and between < 1000 and fell > 5000, "what came off lies on the ball"


if __name__ == "__main__":
    main(sys.argv[1])
