"""Makes the packages of the Python binding, with nothing but Python.

    python3 pack.py LIBRARY FOLDER [PLATFORM]    a wheel with this library, and a source package

pip takes it as the build backend, too (pyproject.toml): `pip install kiri_sheets-VERSION.tar.gz`, or `pip install bindings/python` in a
checkout, compiles the library. That takes a C and a C++ compiler (CC, CXX) and Eigen (EIGEN_DIR, pkg-config, or where Debian
has it). PLATFORM is the tag of the wheel, such as manylinux_2_28_x86_64; else it is that of this machine."""

import base64
import hashlib
import io
import os
import pathlib
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

here = pathlib.Path(__file__).resolve().parent
root = here if (here / "src").is_dir() else here.parents[1]  # a source package, or the repository
sys.dont_write_bytecode = True
NAME = "kiri-sheets"  # kiri is another package on PyPI; modules are imported as kiri
TIME = (2026, 1, 1, 0, 0, 0)

METADATA = """Metadata-Version: 2.4
Name: {name}
Version: {version}
Summary: Cuts thin sheets while they move, inside a game's fixed tick
License-Expression: MIT
License-File: LICENSE
Keywords: cloth,paper,cutting,physics,simulation,games
Classifier: Development Status :: 4 - Beta
Classifier: Intended Audience :: Developers
Classifier: Intended Audience :: Science/Research
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: C
Classifier: Programming Language :: Python :: 3
Classifier: Programming Language :: Python :: 3 :: Only
Classifier: Topic :: Games/Entertainment
Classifier: Topic :: Scientific/Engineering :: Physics
Classifier: Typing :: Typed
Requires-Python: >=3.8
Requires-Dist: cffi
Provides-Extra: numpy
Requires-Dist: numpy; extra == "numpy"
Description-Content-Type: text/markdown

{readme}"""


def version():
    text = (here / "kiri/_declarations.py").read_text()
    return text.partition('VERSION = "')[2].partition('"')[0]


def base():
    return f"{NAME.replace('-', '_')}-{version()}"


def metadata():
    return METADATA.format(name=NAME, version=version(), readme=(here / "README.md").read_text()).encode()


def modules():
    return [*sorted((here / "kiri").glob("*.py")), here / "kiri/py.typed"]


def sources():
    return sorted([*(root / "src").glob("*/*.c"), *(root / "src").glob("*/*.cpp")])


def write_wheel(library, folder, platform=None):
    tag = f"py3-none-{platform or sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    name = f"{base()}.dist-info"
    files = {f"kiri/{path.name}": path.read_bytes() for path in modules()}
    files["kiri/libkiri.so"] = pathlib.Path(library).read_bytes()
    files["kiri/include/kiri/kiri.h"] = (root / "include/kiri/kiri.h").read_bytes()
    files[f"{name}/METADATA"] = metadata()
    files[f"{name}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: kiri\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{name}/licenses/LICENSE"] = (root / "LICENSE").read_bytes()
    rows = [f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}"
            for path, data in files.items()]
    files[f"{name}/RECORD"] = "\n".join([*rows, f"{name}/RECORD,,", ""]).encode()
    wheel = pathlib.Path(folder) / f"{base()}-{tag}.whl"
    wheel.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, TIME), data, zipfile.ZIP_DEFLATED)
    return wheel


def compile_library(folder):
    """libkiri.so of the sources. A fused multiply-add would give other bits than other machines do."""
    flags = ["-O3", "-DNDEBUG", "-fPIC", "-ffp-contract=off", "-fno-math-errno", "-fvisibility=hidden"]
    found = subprocess.run(["pkg-config", "--variable=includedir", "eigen3"], capture_output=True, text=True) \
        if "EIGEN_DIR" not in os.environ else None
    eigen = os.environ.get("EIGEN_DIR") or (found.stdout.strip() and f"{found.stdout.strip()}/eigen3") or "/usr/include/eigen3"
    if not (pathlib.Path(eigen) / "Eigen/Core").exists():
        raise SystemExit(f"kiri needs the headers of Eigen 3 to compile: {eigen} has none; set EIGEN_DIR")
    c, cpp = ([str(path) for path in sources() if path.suffix == kind] for kind in (".c", ".cpp"))
    cc, cxx = os.environ.get("CC", "cc").split(), os.environ.get("CXX", "c++").split()
    include = f"-I{root / 'include'}"
    subprocess.run([*cc, "-std=c99", *flags, include, "-c", *c], cwd=folder, check=True)
    subprocess.run([*cxx, "-std=c++14", "-fno-rtti", *flags, include, "-isystem", eigen, "-c", *cpp], cwd=folder, check=True)
    library = pathlib.Path(folder) / "libkiri.so"
    objects = [str(path) for path in sorted(pathlib.Path(folder).glob("*.o"))]
    subprocess.run([*cxx, "-shared", *objects, "-o", str(library)], check=True)
    return library


# ---- What pip calls

def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as folder:
        return write_wheel(compile_library(folder), wheel_directory).name


def build_sdist(sdist_directory, config_settings=None):
    files = {path.relative_to(here): path for path in [here / "pack.py", here / "pyproject.toml", here / "README.md", *modules()]}
    files.update({path.relative_to(root): path for path in [root / "LICENSE", root / "include/kiri/kiri.h", *sources(),
                                                            *sorted((root / "src").glob("*/*.h"))]})
    contents = {str(path): source.read_bytes() for path, source in files.items()}
    contents["PKG-INFO"] = metadata()
    pathlib.Path(sdist_directory).mkdir(parents=True, exist_ok=True)
    with tarfile.open(pathlib.Path(sdist_directory) / f"{base()}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path, data in sorted(contents.items()):
            entry = tarfile.TarInfo(f"{base()}/{path}")
            entry.size, entry.mtime = len(data), 1767225600
            archive.addfile(entry, io.BytesIO(data))
    return f"{base()}.tar.gz"


def main(library, folder, platform=None):
    print(write_wheel(library, folder, platform))
    print(pathlib.Path(folder) / build_sdist(folder))


if __name__ == "__main__":
    main(*sys.argv[1:])
