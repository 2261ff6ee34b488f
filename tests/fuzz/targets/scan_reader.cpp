// SPDX-License-Identifier: GPL-3.0-or-later
// One reader of scans, chosen by the build: POINTRT_FUZZ_READER is its name in formats.h, POINTRT_FUZZ_NAME that of the
// target.
#include <tbb/global_control.h>

#include "preprocess/ingest/formats.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

using namespace pointrt;

namespace {

/// The folder of files that an input may name. It holds a single file, a.xyz.
const std::string& folderOfScans() {
    static const test::TemporaryFolder folder;
    static const std::string path = folder.path.string();
    static const std::string scan = folder.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n");
    return path;
}

void readAtOnce(const InputFile& source) {
    Cloud cloud;
    Sink sink(cloud);
    readers::POINTRT_FUZZ_READER.read(source, sink);
}

void readInBatches(const InputFile& source) {
    constexpr std::size_t kPoints = 2; // so few that a batch ends within small files
    Cloud cloud;
    Sink sink(cloud, {}, {kPoints, [](const PointBatch&) {}});
    readers::POINTRT_FUZZ_READER.read(source, sink);
}

} // namespace

POINTRT_FUZZ_TARGET(POINTRT_FUZZ_NAME) {
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    if (input.empty()) return; // openInputFile refuses it
    InputFile source;
    source.name = folderOfScans() + "/input";
    source.bytes = fuzz::textOf(input);
    fuzz::expectReadOrRefused(folderOfScans(), [&] { readAtOnce(source); });
    fuzz::expectReadOrRefused(folderOfScans(), [&] {
        const auto batched = readers::POINTRT_FUZZ_READER.readsInBatches;
        if (batched && batched(source)) readInBatches(source);
    });
}
