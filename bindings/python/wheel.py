"""Makes a wheel, with library and header inside: python3 wheel.py LIBRARY FOLDER. Needs nothing but Python."""

import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here))
sys.dont_write_bytecode = True


def version():
    text = (here / "kiri/_declarations.py").read_text()
    return text.partition('VERSION = "')[2].partition('"')[0]


def contents(library):
    """Path in the wheel to bytes."""
    name = f"kiri-{version()}.dist-info"
    tag = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    files = {f"kiri/{path.name}": path.read_bytes() for path in sorted((here / "kiri").glob("*.py"))}
    files["kiri/py.typed"] = (here / "kiri/py.typed").read_bytes()
    files["kiri/libkiri.so"] = pathlib.Path(library).read_bytes()
    files["kiri/include/kiri/kiri.h"] = (here.parents[1] / "include/kiri/kiri.h").read_bytes()
    files[f"{name}/METADATA"] = f"""Metadata-Version: 2.1
Name: kiri
Version: {version()}
Summary: Cuts thin sheets while they move, inside a game's fixed tick
License: MIT
Requires-Python: >=3.8
Requires-Dist: cffi
Provides-Extra: numpy
Requires-Dist: numpy; extra == "numpy"
Description-Content-Type: text/markdown

{(here / "README.md").read_text()}""".encode()
    files[f"{name}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: kiri\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{name}/LICENSE"] = (here.parents[1] / "LICENSE").read_bytes()
    return files, f"{name}/RECORD", f"kiri-{version()}-{tag}.whl"


def main(library, folder):
    files, record, wheel = contents(library)
    rows = [f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}"
            for path, data in files.items()]
    files[record] = "\n".join([*rows, f"{record},,", ""]).encode()
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(folder / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, (2026, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    print(folder / wheel)


if __name__ == "__main__":
    main(*sys.argv[1:])
