// SPDX-License-Identifier: GPL-3.0-or-later
// One reader of scans. The build says which: POINTRT_FUZZ_READER is its name in formats.h, POINTRT_FUZZ_NAME the
// target's.
#include <tbb/global_control.h>

#include "preprocess/input/formats.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

using namespace pointrt;

namespace {

/// Where files that an input names are looked for: one is there, others are not.
const std::string& folderOfScans() {
    static const test::TemporaryFolder folder;
    static const std::string path = folder.path.string();
    static const std::string scan = folder.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n");
    return path;
}

void readAll(const Source& source, Batches* batches) {
    Cloud cloud;
    Sink sink(cloud);
    sink.batches = batches;
    readers::POINTRT_FUZZ_READER.read(source, sink);
}

} // namespace

POINTRT_FUZZ_TARGET(POINTRT_FUZZ_NAME) {
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    if (input.empty()) return; // which openSource refuses
    Source source;
    source.name = folderOfScans() + "/input";
    source.bytes = fuzz::textOf(input);
    fuzz::expectReadOrRefused(folderOfScans(), [&] { readAll(source, nullptr); });
    fuzz::expectReadOrRefused(folderOfScans(), [&] {
        const auto batched = readers::POINTRT_FUZZ_READER.readsInBatches;
        if (!batched || !batched(source)) return;
        Batches batches;
        batches.points = 2; // as few as have a batch end within small files
        batches.take = [](const PointBatch&) {};
        readAll(source, &batches);
    });
}
