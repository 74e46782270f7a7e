"""Reads what `kiri-run --export` writes, by the specification of glTF 2.0, and compares it with the scene.

    python3 tests/test_glb.py KIRI_RUN FOLDER"""

import json
import pathlib
import struct
import subprocess
import sys

run, folder = sys.argv[1], pathlib.Path(sys.argv[2])
TICKS, EVERY = 200, 25
path = folder / "bunny.glb"
subprocess.run([run, "--quiet", "--scene", "bunny", "--ticks", str(TICKS), "--every", str(EVERY), "--size", "100x100",
                "--output", str(folder), "--export", str(path)], check=True, stdout=subprocess.DEVNULL)
data = path.read_bytes()

magic, version, length, json_length, json_kind = struct.unpack_from("<4sII I4s", data)
assert (magic, version, length, json_kind) == (b"glTF", 2, len(data), b"JSON") and json_length % 4 == 0
model = json.loads(data[20:20 + json_length])
binary_length, binary_kind = struct.unpack_from("<I4s", data, 20 + json_length)
start = 28 + json_length
assert binary_kind == b"BIN\0" and start + binary_length == len(data) and binary_length % 4 == 0
assert model["asset"]["version"] == "2.0" and model["buffers"] == [{"byteLength": binary_length}]


def read(index):
    """Rows of an accessor, as its bounds say."""
    accessor = model["accessors"][index]
    view = model["bufferViews"][accessor["bufferView"]]
    width, kind = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]], {5126: "f", 5125: "I"}[accessor["componentType"]]
    count = accessor["count"] * width
    assert count > 0 and view["byteLength"] == 4 * count and view["byteOffset"] % 4 == 0
    assert view["byteOffset"] + view["byteLength"] <= binary_length
    numbers = struct.unpack_from(f"<{count}{kind}", data, start + view["byteOffset"])
    columns = [numbers[i::width] for i in range(width)]
    if kind == "f":
        near = lambda told, right: all(abs(a - b) <= 1e-6 * max(1, abs(b)) for a, b in zip(told, right, strict=True))
        assert near(accessor["min"], map(min, columns)) and near(accessor["max"], map(max, columns))
    return list(zip(*columns))


# Nodes: the root, then a moment each, with its mesh.
moments = [node for node in model["nodes"] if "mesh" in node]
assert len(moments) == TICKS // EVERY == len(model["meshes"]) == len(model["nodes"]) - 1
assert model["nodes"][0]["children"] == list(range(1, len(model["nodes"]))) and model["scenes"] == [{"nodes": [0]}]
counts, lowest = [], []
for number, node in enumerate(moments):
    assert node["mesh"] == number
    (part,) = model["meshes"][number]["primitives"]
    positions, normals, rest = (read(part["attributes"][name]) for name in ("POSITION", "NORMAL", "TEXCOORD_0"))
    indices = [row[0] for row in read(part["indices"])]
    assert len(positions) == len(normals) == len(rest) and len(indices) % 3 == 0 and max(indices) < len(positions)
    assert all(abs(sum(x * x for x in normal) - 1) < 1e-4 for normal in normals)
    counts.append(len(positions))
    lowest.append(min(z for _, _, z in positions))
assert counts == sorted(counts) and counts[0] < counts[-1], "cuts add vertices"
assert min(lowest) < lowest[0] - 0.01, "the sheet moves"
first, last, end = (model["meshes"][i]["primitives"][0]["indices"] for i in (0, -2, -1))
assert first != last == end, "indices are written when they change: all cuts are before the last two moments"

# At each time one moment has size 1, the others 0.
(animation,) = model["animations"]
keys = {}
for channel in animation["channels"]:
    sampler = animation["samplers"][channel["sampler"]]
    times = [row[0] for row in read(sampler["input"])]
    assert channel["target"]["path"] == "scale" and sampler["interpolation"] == "STEP"
    assert all(a < b for a, b in zip(times, times[1:]))
    keys[channel["target"]["node"]] = list(zip(times, read(sampler["output"]), strict=True))
assert sorted(keys) == list(range(1, len(model["nodes"])))
for number in range(len(moments)):
    now = number * EVERY / 60 + 1e-4
    sizes = [max((key for key in rows if key[0] <= now), default=rows[0])[1] for _, rows in sorted(keys.items())]
    assert sizes == [(float(i == number),) * 3 for i in range(len(moments))], (now, sizes)
print(f"glb: {len(moments)} moments, {counts[0]} to {counts[-1]} vertices")
