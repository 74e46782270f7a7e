"""The classes in Godot: python3 tests/test_godot.py --build DIR --godot3 G --godot4 G classes --twin TWIN | pictures |
packages --version V | bench | project3 | project4. Where an engine is missing, a line says that it was not tested
there."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree
import zipfile

here = pathlib.Path(__file__).resolve().parent
repository = here.parent
binding = repository / "bindings/godot"
sys.path.insert(0, str(repository / "bindings/generator"))
sys.dont_write_bytecode = True

sys.path.insert(0, str(repository / "samples"))

import check_paper
import naming
import to_godot

SAMPLES = {3: repository / "samples/godot", 4: repository / "samples/godot4"}
EMPTY = {3: 'config_version=4\n\n[rendering]\n\nquality/driver/driver_name="GLES2"\n',
         4: 'config_version=5\n\n[rendering]\n\nrenderer/rendering_method="gl_compatibility"\n'}
# compatibility_minimum of kiri.gdextension.
OLDEST = 2
LINE = "KiriSheet.create_pin: rest_point (5, 5) lies outside the material (ERROR_ARGUMENT)"
MARKS = {3: [f"ERROR: kiri: {LINE}"], 4: [f"ERROR: {LINE}", "typed calls good"]}


class Engine:
    def __init__(self, version, command, build):
        self.version, self.command, self.build = version, command, pathlib.Path(build).resolve()

    def missing(self, windows):
        """What is not here. Godot 3 has a window always."""
        needs = [self.command] + (["xvfb-run"] if windows or self.version == 3 else [])
        return ", ".join(name for name in needs if not shutil.which(name))

    # ---- Projects

    def addon(self, folder):
        """addons/kiri, as the package has it."""
        (folder / "bin").mkdir(parents=True)
        own = ["kiri.gd", "kiri.gdns", "kiri_world.gdns", "kiri.gdnlib"] if self.version == 3 else ["kiri.gdextension", "icon.svg"]
        for file in [*(binding / f"godot{self.version}" / name for name in own), binding / "README.md", repository / "LICENSE"]:
            shutil.copy(file, folder)
        shutil.copy(self.build / f"libkiri_godot{self.version}.so", folder / "bin")
        (folder / "example").mkdir()
        for file in SAMPLES[self.version].iterdir():
            if file.name != "project.godot":
                shutil.copy(file, folder / "example")

    def project(self, name, files, sample=False):
        """A new one with the addon and some files."""
        folder = self.build / f"{name}{self.version}"
        shutil.rmtree(folder, ignore_errors=True)
        self.addon(folder / "addons/kiri")
        self.listed(folder)
        if sample:
            files = [*files, *SAMPLES[self.version].iterdir()]
        else:
            (folder / "project.godot").write_text(EMPTY[self.version])
        for file in files:
            shutil.copy(file, folder)
        return folder

    def listed(self, folder):
        """Godot 4 finds extensions when its editor opens a project for the first time."""
        if self.version == 4:
            (folder / ".godot").mkdir()
            (folder / ".godot/extension_list.cfg").write_text("res://addons/kiri/kiri.gdextension\n")

    # ---- Runs

    def run(self, folder, arguments, window=False, check=True):
        home = self.build / "home"
        home.mkdir(exist_ok=True)
        command = [self.command, "--path", str(folder), "--audio-driver", "Dummy"]
        command += ["--headless"] if self.version == 4 and not window else []
        if self.version == 3 or window:
            command = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24", *command]
        done = subprocess.run(command + arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100,
                              env={**os.environ, "HOME": str(home), "LIBGL_ALWAYS_SOFTWARE": "1"})
        (folder / "log").write_text(done.stdout)
        if check and (done.returncode or "SCRIPT ERROR" in done.stdout or "leaked" in done.stdout):
            sys.exit(f"{done.stdout}\ngodot: {' '.join(command + arguments)} ended with {done.returncode}")
        return done.stdout

    def name(self):
        return f"Godot {self.version}"


# ---- Classes


def methods():
    """Class and name of each function of the header, and of what is beside them."""
    description = json.loads((repository / "bindings/kiri.json").read_text())
    names = {f"Kiri{f['class'] or ''}.{naming.snake(f['method'])}" for f in description["functions"]}
    return names | {f"Kiri{of}.{name}" for of, name, *_ in to_godot.MORE}


def check_classes(engine, twin):
    folder = engine.project("test", [here / "test_godot.gd", binding / "twin.gd",
                                     *(binding / f"godot{engine.version}").glob("*.gd")])
    log = engine.run(folder, ["-s", "run.gd"])
    missing = methods() - set(re.findall(r"^method (\S+)$", log, re.M))
    assert not missing, f"{engine.name()} has no {sorted(missing)}"
    assert twin in log, f"{engine.name()}: the twin's hash is not that of C, {twin}:\n{log[-600:]}"
    for mark in MARKS[engine.version]:
        assert mark in log, f"{engine.name()}: no line '{mark}' in {folder}/log"
    checks = re.search(r"(\d+) checks, 0 failed", log)
    assert checks, "\n".join(re.findall(r"FAILED.*", log))
    assert engine.run(folder, ["-s", "first_cut.gd"]).endswith("2 pieces\n"), "the first cut"
    if engine.version == 4:
        check_interface(engine, folder)
        check_documents(engine, folder)
    print(f"{engine.name()}: {checks[1]} checks, all {len(methods())} methods are there, and {twin.splitlines()[0]} is that of C")


def check_called():
    """No method that the checks leave out."""
    text = "".join(path.read_text() for path in (here / "test_godot.gd", binding / "twin.gd", binding / "godot4/first_cut.gd"))
    missing = {name for name in methods() if f".{name.split('.')[1]}(" not in text}
    assert not missing, f"not called: {sorted(missing)}"


# What Godot writes of its interface, and what host4.h has of it.
LAYOUT = """
#include <stddef.h>
#include "gdextension_interface.h"
#include "host4.h"
#define SAME(is) typedef char Same[(is) ? 1 : -1]
#define SIZE(own, of) SAME(sizeof(own) == sizeof(of))
#define AT(own, a, of, b) SAME(offsetof(own, a) == offsetof(of, b))
int main(void)
{
    { SIZE(Initialization, GDExtensionInitialization); }
    { AT(Initialization, deinitialize, GDExtensionInitialization, deinitialize); }
    { SIZE(PropertyInfo, GDExtensionPropertyInfo); }
    { AT(PropertyInfo, usage, GDExtensionPropertyInfo, usage); }
    { SIZE(ClassInfo, GDExtensionClassCreationInfo2); }
    { AT(ClassInfo, create, GDExtensionClassCreationInfo2, create_instance_func); }
    { AT(ClassInfo, free, GDExtensionClassCreationInfo2, free_instance_func); }
    { AT(ClassInfo, user, GDExtensionClassCreationInfo2, class_userdata); }
    { SIZE(MethodInfo, GDExtensionClassMethodInfo); }
    { AT(MethodInfo, flags, GDExtensionClassMethodInfo, method_flags); }
    { AT(MethodInfo, arguments, GDExtensionClassMethodInfo, arguments_info); }
    { AT(MethodInfo, defaults, GDExtensionClassMethodInfo, default_arguments); }
    { SIZE(CallError, GDExtensionCallError); }
    { SAME(GODOT_STRING_NAME == GDEXTENSION_VARIANT_TYPE_STRING_NAME); }
    { SAME(GODOT_BASIS == GDEXTENSION_VARIANT_TYPE_BASIS); }
    { SAME(GODOT_OBJECT == GDEXTENSION_VARIANT_TYPE_OBJECT); }
    { SAME(GODOT_COLORS == GDEXTENSION_VARIANT_TYPE_PACKED_COLOR_ARRAY); }
    { SAME(METHOD_STATIC == GDEXTENSION_METHOD_FLAG_STATIC); }
    return 0;
}
"""


def check_interface(engine, folder):
    """host4.h is as the header that this Godot writes."""
    engine.run(folder, ["--dump-gdextension-interface"])
    written = next((path for path in (folder, pathlib.Path.cwd()) if (path / "gdextension_interface.h").exists()), None)
    assert written, "Godot wrote no gdextension_interface.h"
    if written != folder:
        shutil.move(written / "gdextension_interface.h", folder)
    (folder / "layout.c").write_text(LAYOUT)
    subprocess.run([os.environ.get("CC", "cc"), "-std=c99", "-Wno-unused-local-typedefs", f"-I{folder}", f"-I{binding}", "-c",
                    str(folder / "layout.c"), "-o", str(folder / "layout.o")], check=True)
    header = (folder / "gdextension_interface.h").read_text()
    for name in re.findall(r"X\([\w*]+,\s+(\w+),", (binding / "host4.h").read_text()):
        since = re.search(rf"@name {name}\n \* @since 4\.(\d)", header)
        assert since and int(since[1]) <= OLDEST, f"{name} is not in the interface of Godot 4.{OLDEST}"


def signatures(path):
    """Of a class: methods with answer, arguments and defaults; constants with values."""
    root = xml.etree.ElementTree.parse(path).getroot()
    found = {}
    for method in root.iter("method"):
        takes = tuple((p.get("name"), p.get("type"), p.get("default")) for p in method.iter("param"))
        found[method.get("name")] = (method.find("return").get("type"), method.get("qualifiers", ""), takes)
    for constant in root.iter("constant"):
        found[constant.get("name")] = (constant.get("value"), constant.get("enum"), constant.get("is_bitfield"))
    return found


def check_documents(engine, folder):
    """What Godot has registered is what the documents say."""
    (folder / "dumped").mkdir()
    engine.run(folder, ["--doctool", str(folder / "dumped"), "--gdextension-docs"])
    dumped = {path.name: path for path in (folder / "dumped").rglob("Kiri*.xml")}
    for path in (binding / "doc_classes").glob("*.xml"):
        own, godots = signatures(path), signatures(dumped[path.name])
        for name in sorted({*own, *godots}):
            assert own.get(name) == godots.get(name), f"{path.stem}.{name}: {own.get(name)}, in Godot {godots.get(name)}"


# ---- Pictures, packages


def picture(engine, folder, scene=()):
    path = folder / "picture.png"
    option = [f"--picture={path}"] if engine.version == 3 else ["--", f"--picture={path}"]
    log = engine.run(folder, [*scene, *option], window=True)
    assert re.search(r"^2 sheets, hash", log, re.M), log
    subprocess.run([sys.executable, str(repository / "samples/check_paper.py"), str(path)], check=True)
    return path


def check_pictures(engine):
    made = picture(engine, engine.project("project", [], sample=True))
    if engine.version == 4:
        # The boxes around pieces are orange.
        rows = check_paper.pixels_of(made.with_name("picture_debug.png"))
        boxes = sum(red > 200 and 130 < green < 200 and blue < 60 for row in rows for red, green, blue in row)
        assert boxes > 200, f"debug draw: {boxes} pixels of boxes"
    shutil.copy(made, engine.build / f"godot{engine.version}.png")


def check_package(engine, version):
    """The zip in an empty project, which Godot 4 opens in its editor once."""
    source, folder = engine.build / f"package{engine.version}", engine.build / f"empty{engine.version}"
    for old in (source, folder):
        shutil.rmtree(old, ignore_errors=True)
    engine.addon(source / "addons/kiri")
    made = engine.build / f"kiri-godot{engine.version}-{version}"
    shutil.make_archive(str(made), "zip", source)
    folder.mkdir()
    zipfile.ZipFile(f"{made}.zip").extractall(folder)
    (folder / "project.godot").write_text(EMPTY[engine.version])
    shutil.copy(binding / f"godot{engine.version}/first_cut.gd", folder)
    if engine.version == 4:
        # Godot 4.6.3 aborts as it ends, when it has just found an extension, any that has a class. Not the next time.
        engine.run(folder, ["--import"], check=False)
        log = engine.run(folder, ["--import"])
        assert "ERROR" not in log, log
        extension = (folder / "addons/kiri/kiri.gdextension").read_text()
        for name, icon in re.findall(r'^(Kiri\w*) = "res://(.*)"$', extension, re.M):
            assert (folder / icon).exists() and (binding / f"doc_classes/{name}.xml").exists(), f"the icon of {name}"
        assert list((folder / ".godot/imported").glob("icon.svg-*.ctex")), "Godot takes the icon"
    assert engine.run(folder, ["-s", "first_cut.gd"]).endswith("2 pieces\n"), "the first cut"
    picture(engine, folder, ["res://addons/kiri/example/main.tscn"])
    print(f"{engine.name()}: {made}.zip, used in an empty project")


def bench(engine):
    folder = engine.project("bench", [binding / "bench.gd", binding / f"godot{engine.version}/bench_run.gd"])
    print(engine.name(), *re.findall(r"^.* us$", engine.run(folder, ["-s", "bench_run.gd"]), re.M), sep="\n")


def main():
    parser = argparse.ArgumentParser()
    for option in ("--build", "--godot3", "--godot4", "--twin", "--version"):
        parser.add_argument(option)
    parser.add_argument("what")
    options = parser.parse_args()
    engines = {3: Engine(3, options.godot3, options.build), 4: Engine(4, options.godot4, options.build)}
    if options.what.startswith("project"):
        engines[int(options.what[-1])].project("project", [], sample=True)
        return
    if options.what == "classes":
        check_called()
        twin = "\n".join(subprocess.run([options.twin], stdout=subprocess.PIPE, text=True).stdout.splitlines()[:2])
    for engine in engines.values():
        missing = engine.missing(windows=options.what in ("pictures", "packages"))
        if missing:
            print(f"godot: no {missing}, not tested in {engine.name()}")
        elif options.what == "classes":
            check_classes(engine, twin)
        elif options.what == "bench":
            bench(engine)
        elif options.what == "pictures":
            check_pictures(engine)
        else:
            check_package(engine, options.version)


main()
