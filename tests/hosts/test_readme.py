# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documents say of the plugin and of the code is so, and their links lead somewhere.
Usage: test_readme.py BUILD_DIR [TEST...]. common.py holds what the plugins are tested against."""

import ast
import os
import re
import unittest

import common

KINDS = {"int": "Int", "float": "Float", "bool": "Bool", "str": "String"}


def read(*path):
    with open(os.path.join(common.REPOSITORY, *path), encoding="utf-8") as source:
        return source.read()


def documents():
    """All Markdown files of the repository, relative to it."""
    found = []
    for place, folders, names in os.walk(common.REPOSITORY):
        folders[:] = [name for name in folders if name not in (".git", "build")]
        found += [os.path.relpath(os.path.join(place, name), common.REPOSITORY)
                  for name in names if name.endswith(".md")]
    return sorted(found)


def anchors(text):
    """Those that a Markdown page gives its headings."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    titles = re.findall(r"^#+ +(.*?) *$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def tables(text, header):
    """The rows below each such header, as lists of cells."""
    found = []
    for part in text.split(header + "\n")[1:]:
        rows = []
        for line in part.splitlines()[1:]:
            if not line.startswith("|"):
                break
            rows.append([cell.strip() for cell in line.replace("\\|", " ").strip("|").split("|")])
        found.append(rows)
    return found


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = read("filter_ricci", "README.md")

    def check_parameters(self, page, our_filter):
        """The page of a filter names its parameters where dialogs have them, and what is the same in both once."""
        expected = {name: (name, kind, value) for name, kind, value in common.all_parameters(our_filter)}
        choices = {**our_filter.CHOICES, **our_filter.RARE_CHOICES}
        shown, rest = page.split("**Advanced parameters:**")
        places = [shown.split("**Parameters:**")[1], *rest.split("**Options**")]
        names = [sorted(name for line in re.findall(r"(?m)^- (.*?)(?:<br>|: as in)", place)
                        for name in re.findall(r"\*\*`(\w+)", line)) for place in places]
        listed = list(expected)
        rare = [name for name, _, _ in our_filter.RARE]
        self.assertEqual(names, [sorted(part) for part in (
            listed[:common.SHOWN], listed[common.SHOWN:len(listed) - len(rare)], rare)])
        for same in re.findall(r"(?m)^- (.*): as in the Euclidean filter\.$", page):
            for name in re.findall(r"`(\w+)`", same):
                self.assertIn(expected.pop(name), common.all_parameters(common))
                self.assertEqual(choices.get(name), {**common.CHOICES, **common.RARE_CHOICES}.get(name))
        for name, kind, value in expected.values():
            with self.subTest(parameter=name):
                python, default, number, listed, text = re.search(
                    rf"(?m)^- \*\*`{name} : (\w+) = (.*?)(?: \(or int = (\d+)\))?`\*\*"
                    r"(?:<br>Possible enum values: (.*?)<br>|<br>) \*[^*]*\*: (.*)$", page).groups()
                self.assertEqual("Enum" if number else KINDS[python], kind)
                self.assertEqual(int(number) if number else ast.literal_eval(default), value)
                self.assertEqual(listed, ", ".join(
                    f"{i}. `'{c}'`" for i, c in enumerate(choices.get(name, []))) or None)
                tooltip = re.sub(r"\(.*?\)|\d\.\d", "", text)
                self.assertLessEqual(len(re.findall(r"[a-z0-9\])]\.(?: |$)", tooltip)), 2, "sentences")
                self.assertLessEqual(len(text.split()), 25)

    def test_parameters(self):
        for key, our_filter in (("Euclidean", common), ("hyperbolic", common.HYPERBOLIC)):
            page, = re.findall(rf"(?s)<!-- begin: the {key} filter.*?-->(.*?)<!-- end: the {key}",
                               self.text)
            self.assertIn(f"### {our_filter.PYTHON_NAME}\n", page)
            self.assertIn(f"'{our_filter.NAME}'", page)
            self.check_parameters(page, our_filter)

    def test_results(self):
        euclidean, hyperbolic = (
            {key: kind for row in rows
             for key, kind in zip(re.findall(r"`(\w+)`", row[0]),
                                  row[1].split(", ") * (1 if ", " in row[1] else 9))}
            for rows in tables(self.text, "| key | type | |"))
        expected = {**common.ALWAYS, **common.INVARIANTS, **common.CHOSEN, **common.FREE_BOUNDARY,
                    **common.TEXTURE, **common.SPHERE}
        self.assertEqual(euclidean, {key: kind.__name__ for key, kind in expected.items()})
        self.assertEqual(
            hyperbolic, {"hyperbolic_area": "float", "left_out_components": "int",
                         "relation_error": "float", "generators": "vector",
                         "generators_low": "vector", "generators_error": "float"})

    def test_messages(self):
        """Every part of a message between two values ends in words of the bridge, or of the core's
        typed errors."""
        bridge = os.path.join("filter_ricci", "bridge")
        names = sorted(os.listdir(os.path.join(common.REPOSITORY, bridge)))
        makers = [os.path.join(bridge, name) for name in names]
        makers.append(os.path.join("vcg_ext", "ricci", "base", "error.cpp"))
        sources = "".join(re.sub(r'"\s*"', "", read(name)) for name in makers)
        sources = re.sub(r"\{(\w+)\}", r"\1", sources)  # names of parameters
        rows, = tables(self.text, "| input | message |")
        self.assertGreaterEqual(len(rows), 10)
        for row in rows:
            with self.subTest(input=row[0]):
                parts = re.split(r"\b(?:[NX]|NAME|REASON|WHAT|ID)\b|…", row[1].split("Use 0 (")[0])
                self.assertTrue(any(len(part.split()) >= 4 for part in parts))
                for words in (part.split() for part in parts):
                    if len(words) >= 6:
                        self.assertIn(" ".join(words[-3:]), sources)

    FACADE = "vcg_ext/vcg/complex/algorithms/parametrization"

    def test_files_and_functions(self):
        """The pages of the core name files that are there, and functions that they hold."""
        pages = read("vcg_ext", "ricci", "README.md") + read("vcg_ext", "ricci", "PAPER.md")
        for line in pages.splitlines():
            for name, functions in re.findall(r"`([\w/]+\.(?:cpp|h|cmake))`((?: \(`.*?`\))?)", line):
                places = [p for p in ("", "vcg_ext/ricci", "vcg_ext", self.FACADE)
                          if os.path.isfile(os.path.join(common.REPOSITORY, p, name))]
                with self.subTest(file=name):
                    self.assertTrue(places)
                    source = read(places[0], name)
                    for function in re.findall(r"`(\w+)`", functions):
                        self.assertIn(function, source)

    def test_order_of_folders(self):
        """The page of the core gives the order that core.structure checks."""
        checked = re.search(r"(?s)set\(order\s+(.*?)\)", read("tests", "check_structure.cmake")).group(1)
        page = read("vcg_ext", "ricci", "README.md")
        written = re.search(r"in the order of their includes: ([\w,\s]+)\.", page).group(1)
        self.assertEqual(re.split(r",\s+", written), checked.split())

    def test_links(self):
        """Relative links lead to a file, and to a heading of it where they name one."""
        for name in documents():
            links = re.findall(r"\]\(([^)\s]+)\)", read(name))
            for link in links:
                if re.match(r"\w+:", link):
                    continue
                with self.subTest(document=name, link=link):
                    path, _, anchor = link.partition("#")
                    target = name
                    if path:
                        target = os.path.normpath(os.path.join(os.path.dirname(name), path))
                    self.assertTrue(os.path.exists(os.path.join(common.REPOSITORY, target)))
                    if anchor:
                        self.assertIn(anchor, anchors(read(target)))

    def test_version(self):
        """One version everywhere."""
        version = re.search(r"project\(\w+ VERSION ([\d.]+)", read("CMakeLists.txt")).group(1)
        for name, pattern in (
                ("CHANGELOG.md", r"^## \[(\d.*?)\]"), ("CITATION.cff", r"^version: (.*)"),
                (os.path.join("vcg_ext", "ricci", "CMakeLists.txt"), r"^project\(ricci VERSION ([\d.]+)")):
            self.assertEqual(re.search(pattern, read(name), re.M).group(1), version, name)
        for name in ("README.md", os.path.join("filter_ricci", "README.md")):
            self.assertEqual(set(re.findall(r"ricciflow-(.*?)-", read(name))), {version}, name)

    def test_script(self):
        """The script that users start from has every parameter, with its type."""
        sample = read("filter_ricci", "samples", "automatic.mlx")
        written = re.findall(r'<Param type="Rich(\w+)" name="(\w+)"', sample)
        self.assertEqual([(name, kind) for kind, name in written],
                         [(name, kind) for name, kind, _ in common.PARAMETERS])

    def test_every_group_of_host_tests_is_run(self):
        listed = read("tests", "hosts", "CMakeLists.txt")
        for name in os.listdir(os.path.join(common.REPOSITORY, "tests", "hosts")):
            if not re.match(r"test_.*\.py$", name):
                continue
            # Either a loop over groups, or one line for one group, or all of the file.
            before, after = re.search(rf"(?s)^(.*){name}(.*?)\)", listed).groups()
            looped = re.findall(r"foreach\(group (.*?)\)", before)
            for group in re.findall(r"^class (\w+)\(unittest.TestCase\)",
                                    read("tests", "hosts", name), re.MULTILINE):
                if "${group}" in after:
                    self.assertIn(group, looped[-1].split(), name)
                elif after and "${CMAKE_BINARY_DIR}" not in after:
                    self.assertIn(group, after.split(), name)


if __name__ == "__main__":
    common.main()
