// SPDX-License-Identifier: GPL-3.0-or-later
// One reader of scans, chosen by the build: POINTRT_FUZZ_READER is its name in formats.h, POINTRT_FUZZ_NAME that of the
// target. There is one such program for each format, so it reads no large header.
#include "tests/fuzz/scan_reader.h"

namespace pointrt::readers {
extern const FormatReader POINTRT_FUZZ_READER;
}

POINTRT_FUZZ_TARGET(POINTRT_FUZZ_NAME) { pointrt::fuzz::readScan(pointrt::readers::POINTRT_FUZZ_READER, input); }
