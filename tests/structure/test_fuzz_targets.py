#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""fuzz_targets.py finds formats without a fuzz target."""
import unittest
import unittest.mock

import fuzz_targets

HEADER = """#define POINTRT_INPUT_FORMATS(FORMAT) \\
    FORMAT(kPly, "ply", "PLY", "ply", kAny) \\
    FORMAT(kXyz, "xyz", "XYZ/PTS", "xyz pts", kColumns)
"""
CMAKE = """  foreach(kind IN ITEMS corpus findings)
  endforeach()
  foreach(reader IN ITEMS Ply Xyz)
    pointrt_fuzz_target(scan_${name} targets/scan_reader.cpp LINK pointrt_input)
  endforeach()
"""


def findingsOf(header: str = HEADER, cmake: str = CMAKE, corpora: tuple = ("pro", "scan_ply", "scan_xyz")) -> list[str]:
    lines = fuzz_targets.findings(fuzz_targets.formatsIn(header), fuzz_targets.fuzzedIn(cmake), corpora)
    return [line.split(":")[0] for line in lines]


class FuzzTargets(unittest.TestCase):
    def test_accepts_a_target_for_each_format(self):
        self.assertEqual(findingsOf(), [])

    def test_finds_a_format_without_a_target(self):
        self.assertEqual(findingsOf(HEADER + ' FORMAT(kLas, "las", "LAS", "las laz", kAny)\n'), ["kLas"])
        self.assertEqual(findingsOf(cmake=CMAKE.replace("scan_reader.cpp", "other.cpp")), ["kPly", "kXyz"])

    def test_finds_a_target_without_a_format_or_a_corpus(self):
        self.assertEqual(findingsOf(cmake=CMAKE.replace("Xyz", "Xyz Old")), ["kOld", "kOld"])
        self.assertEqual(findingsOf(corpora=("scan_ply",)), ["kXyz"])

    def test_exceptions_are_formats_without_a_target(self):
        with unittest.mock.patch.dict(fuzz_targets.WITHOUT, kXyz="too slow"):
            self.assertEqual(findingsOf(cmake=CMAKE.replace(" Xyz", "")), [])
            self.assertEqual(findingsOf(), ["kXyz"])

    def test_finds_that_it_reads_nothing(self):
        self.assertEqual(findingsOf("", ""), ["preprocess/ingest/formats.h"])


if __name__ == "__main__":
    unittest.main()
