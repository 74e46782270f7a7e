"""Holds bindings/kiri.json against the compiler and the library: python3 tests/test_description.py LIBRARY."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

repository = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(repository / "bindings/generator"))
sys.dont_write_bytecode = True

import describe
import header

description = json.loads((repository / "bindings/kiri.json").read_text())
library = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/release/libkiri.so")


def layout_checks(machine):
    """A C file that compiles where sizes, offsets and constants are as described."""
    lines = ["#include <stddef.h>", '#include "kiri/kiri.h"']
    for struct in description["structs"]:
        lines.append(f"_Static_assert(sizeof({struct['name']}) == {struct['size'][machine]}, \"{struct['name']}\");")
        lines += [f"_Static_assert(offsetof({struct['name']}, {field['name']}) == {field['offset'][machine]}, "
                  f"\"{struct['name']}.{field['name']}\");" for field in struct["fields"]]
    lines += [f"_Static_assert({value['name']} == {value['value']}, \"{value['name']}\");"
              for enum in description["enums"] for value in enum["values"]]
    return "\n".join(lines) + "\n"


def compiles(compiler, source):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "layout.c"
        path.write_text(source)
        return subprocess.run([*compiler.split(), "-std=c11", "-I", str(repository / "include"), "-c", str(path), "-o",
                               os.devnull if "emcc" not in compiler else str(path) + ".o"],
                              capture_output=True, text=True)


class TestLayout(unittest.TestCase):
    def test_of_64_bit_machines(self):
        made = compiles(os.environ.get("CC", "cc"), layout_checks("64"))
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_that_the_check_can_fail(self):
        wrong = layout_checks("64").replace("offsetof(kiriEvent, area) == ", "offsetof(kiriEvent, area) == 1 + ")
        self.assertNotEqual(compiles(os.environ.get("CC", "cc"), wrong).returncode, 0)

    @unittest.skipUnless(shutil.which("emcc"), "no emcc")
    def test_of_wasm(self):
        made = compiles("emcc", layout_checks("wasm32"))
        self.assertEqual(made.returncode, 0, made.stderr)


# By their values, or by the struct before them.
SAID_ELSEWHERE = ("kiriResultCode", "kiriQualityPreset", "kiriSetupPreset", "kiriBudgetLimit", "kiriNoteLimit")


class TestFunctions(unittest.TestCase):
    def test_that_all_are_described(self):
        listed = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)
        exported = set(re.findall(r" T (\w+)", listed.stdout))
        self.assertEqual(exported, {function["name"] for function in description["functions"]})

    def test_that_all_are_documented(self):
        for kind in ("functions", "structs", "enums"):
            named = [thing["name"] for thing in description[kind] if not thing["doc"]
                     and thing["name"] not in SAID_ELSEWHERE]
            self.assertEqual(named, [])

    def test_that_methods_have_one_name_each(self):
        named = [(function["class"], function["method"]) for function in description["functions"]]
        self.assertEqual(len(named), len(set(named)))

    def test_that_what_is_counted_has_its_count(self):
        for function in description["functions"]:
            names = {parameter["name"] for parameter in function["parameters"]}
            for parameter in function["parameters"]:
                for word in re.findall(r"[a-z]\w*", str(parameter.get("length", ""))):
                    self.assertIn(word, names, function["name"])
        for struct in description["structs"]:
            names = {field["name"] for field in struct["fields"]}
            for field in struct["fields"]:
                if field["form"] == "pointer" and field["name"] != "user":
                    self.assertIn(field["length"], names, struct["name"])


class TestReference(unittest.TestCase):
    text = (repository / "bindings/REFERENCE.md").read_text()
    headings = re.findall(r"^##+ (.+)$", text, re.M)

    def test_that_all_have_a_heading(self):
        for kind in ("callbacks", "enums", "structs", "functions"):
            for thing in description[kind]:
                self.assertEqual(self.headings.count(thing["name"]), 1, thing["name"])

    def test_that_links_lead_somewhere(self):
        goals = {heading.lower().replace(" ", "-") for heading in self.headings}
        links = re.findall(r"\]\(#([^)]*)\)", self.text)
        self.assertGreater(len(links), len(description["functions"]))
        self.assertEqual(sorted(set(links) - goals), [])


class TestReader(unittest.TestCase):
    def test_that_comments_find_their_declaration(self):
        text = """/* ---- Part ---- */

/* Prose. */

/* Of both. */
KIRI_API void kiriOne(void); /* More. */
KIRI_API void kiriTwo(void);

KIRI_API void kiriThree(void);
"""
        reader = header.Reader(text)
        self.assertEqual([d["doc"] for d in reader.declarations], ["Of both. More.", "Of both.", ""])
        self.assertEqual(reader.prose, [{"section": "Part", "text": "Prose."}])

    def test_that_events_name_their_fields(self):
        self.assertEqual(description["eventFields"]["KIRI_EVENT_DEFERRED"], ["sheet", "stage", "waiting"])
        self.assertEqual(description["eventFields"]["KIRI_EVENT_DIVERGED"], ["sheet"])

    def test_that_an_exception_that_matches_nothing_is_refused(self):
        describe.PARAMETERS["kiriNone.of"] = {}
        try:
            with self.assertRaises(SyntaxError):
                describe.describe((repository / "include/kiri/kiri.h").read_text())
        finally:
            del describe.PARAMETERS["kiriNone.of"]

    def test_that_tags_mark_flags(self):
        struct = next(struct for struct in description["structs"] if struct["name"] == "kiriSheetDef")
        self.assertEqual([field["name"] for field in struct["fields"] if field.get("flag")],
                         ["touchesSheets", "selfContact", "planar", "normals"])

    def test_that_tags_mark_the_pointers_that_calls_take_as_null(self):
        """every_call.h has null, or `spare`, for these alone: test_api.c makes each other pointer null, and is refused."""
        calls = repository / "tests/every_call.h"
        taken = {f"{name}.{i}" for name, given in re.findall(r"^ +(?:CHANGES|READS)\((\w+), (.*?)\)  ", calls.read_text(), re.M)
                 for i, argument in enumerate(given.split(", ")) if argument in ("NULL", "g->spare")}
        marked = {f"{function['name']}.{i}" for function in description["functions"] if function["class"]
                  for i, p in enumerate(function["parameters"]) if p.get("nullable") and p["form"] not in ("world", "id")}
        self.assertEqual(marked, taken | {"kiriFrame_Hold.2", "kiriFrame_Hold.3"})  # both, or none


if __name__ == "__main__":
    unittest.main()
