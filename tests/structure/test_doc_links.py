#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""doc_links.py finds links that lead nowhere."""
import pathlib
import tempfile
import unittest

import doc_links


def errorsOf(text: str) -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "a.md").write_text(text, encoding="utf-8")
        (root / "b.md").write_text("# The `b` of it\n```\n# not one\n```\n", encoding="utf-8")
        return doc_links.check(root, "a.md")[1]


class DocLinks(unittest.TestCase):
    def test_accepts_files_headings_and_addresses(self):
        self.assertEqual(errorsOf("# Here\n[b](b.md#the-b-of-it) [up](#here) [out](https://example.com/none)"), [])

    def test_finds_missing_files(self):
        self.assertEqual(len(errorsOf("[c](c.md)")), 1)
        self.assertEqual(len(errorsOf("![c](c.png)")), 1)
        self.assertEqual(len(errorsOf("[![c](c.png)](b.md)")), 1)

    def test_finds_missing_headings(self):
        self.assertEqual(len(errorsOf("[b](b.md#not-one)")), 1)

    def test_leaves_code_alone(self):
        self.assertEqual(errorsOf("`[c](c.md)`\n```\n[c](c.md)\n```\n"), [])


if __name__ == "__main__":
    unittest.main()
