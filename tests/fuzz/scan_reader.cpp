// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/scan_reader.h"

#include <tbb/global_control.h>

#include "preprocess/ingest/formats.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::fuzz {
namespace {

/// The folder of files that an input may name. It holds a single file, a.xyz.
const std::string& folderOfScans() {
    static const test::TemporaryFolder folder;
    static const std::string path = folder.path.string();
    static const std::string scan = folder.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n");
    return path;
}

void readAtOnce(const FormatReader& reader, const InputFile& source) {
    Cloud cloud;
    Sink sink(cloud);
    reader.read(source, sink);
}

void readInBatches(const FormatReader& reader, const InputFile& source) {
    constexpr std::size_t kPoints = 2; // so few that a batch ends within small files
    Cloud cloud;
    Sink sink(cloud, {}, {kPoints, [](const PointBatch&) {}});
    reader.read(source, sink);
}

} // namespace

void readScan(const FormatReader& reader, Input input) {
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    if (input.empty()) return; // openInputFile refuses it
    InputFile source;
    source.name = folderOfScans() + "/input";
    source.bytes = textOf(input);
    expectReadOrRefused(folderOfScans(), [&] { readAtOnce(reader, source); });
    expectReadOrRefused(folderOfScans(), [&] {
        if (reader.readsInBatches && reader.readsInBatches(source)) readInBatches(reader, source);
    });
}

} // namespace pointrt::fuzz
