"""Packages of Unity and NuGet: python3 bindings/csharp/pack.py VERSION LIBRARY ASSEMBLY FOLDER.

What is in them has the same time, so that the same sources give the same bytes."""

import gzip
import hashlib
import io
import pathlib
import sys
import tarfile
import zipfile

here = pathlib.Path(__file__).resolve().parent
UNITY = "com.kiri.kiri"
PLUGIN = "Plugins/x86_64/libkiri.so"

# A plugin says where it is for; all else has what Unity takes where a file has no more.
META = "fileFormatVersion: 2\nguid: {guid}\n"
META_PLUGIN = """PluginImporter:
  serializedVersion: 2
  isPreloaded: 0
  platformData:
  - first:
      Any:
    second:
      enabled: 0
  - first:
      Editor: Editor
    second:
      enabled: 1
      settings:
        CPU: x86_64
        OS: Linux
  - first:
      Standalone: Linux64
    second:
      enabled: 1
      settings:
        CPU: AnyCPU
"""
CONTENT_TYPES = """<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
  <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml" />
  <Default Extension="nuspec" ContentType="application/octet" />
  <Default Extension="dll" ContentType="application/octet" />
  <Default Extension="xml" ContentType="application/octet" />
  <Default Extension="so" ContentType="application/octet" />
  <Default Extension="md" ContentType="text/markdown" />
</Types>
"""
RELATIONS = """<?xml version="1.0" encoding="utf-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
  <Relationship Type="http://schemas.microsoft.com/packaging/2010/07/manifest" Target="/Kiri.nuspec" Id="R1" />
</Relationships>
"""


def meta(path, folder=False):
    """The identity of a file stays the same from version to version."""
    text = META.format(guid=hashlib.md5(f"{UNITY}/{path}".encode()).hexdigest())
    return text + ("folderAsset: yes\n" if folder else META_PLUGIN if path == PLUGIN else "")


def unity_files(version, library):
    files = {"package.json": (here / "package.json").read_text().replace("@VERSION@", version).encode(),
             "README.md": (here / "README.md").read_bytes(), "LICENSE.md": (here.parents[1] / "LICENSE").read_bytes(),
             PLUGIN: library}
    for path in sorted((here / "Runtime").rglob("*")):
        if path.is_file():
            files[path.relative_to(here).as_posix()] = path.read_bytes()
    folders = {parent.as_posix() for path in files for parent in pathlib.PurePosixPath(path).parents} - {"."}
    files.update({f"{path}.meta": meta(path).encode() for path in list(files)})
    files.update({f"{path}.meta": meta(path, True).encode() for path in folders})
    return files


def write_unity(path, files):
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for name, data in sorted(files.items()):
            entry = tarfile.TarInfo(f"package/{name}")
            entry.size, entry.mode = len(data), 0o644
            tar.addfile(entry, io.BytesIO(data))
    path.write_bytes(gzip.compress(packed.getvalue(), mtime=0))


def write_nuget(path, version, library, assembly, comments):
    files = {"[Content_Types].xml": CONTENT_TYPES.encode(), "_rels/.rels": RELATIONS.encode(),
             "Kiri.nuspec": (here / "kiri.nuspec").read_text().replace("@VERSION@", version).encode(),
             "README.md": (here / "README.md").read_bytes(), "lib/net45/Kiri.dll": assembly, "lib/net45/Kiri.xml": comments,
             "runtimes/linux-x64/native/libkiri.so": library}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        for name, data in files.items():
            package.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)


def main(version, library, assembly, folder):
    library, folder = pathlib.Path(library).read_bytes(), pathlib.Path(folder)
    write_unity(folder / f"{UNITY}-{version}.tgz", unity_files(version, library))
    write_nuget(folder / f"Kiri.{version}.nupkg", version, library, pathlib.Path(assembly).read_bytes(),
                pathlib.Path(assembly).with_suffix(".xml").read_bytes())


main(*sys.argv[1:])
