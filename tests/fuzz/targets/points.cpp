// SPDX-License-Identifier: Apache-2.0
// Points of LAS, LAZ and PLY files with their columns, as pointrt-rays reads them.
#include <cstdlib>

#include "format/pointio/point_reader.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

namespace {

/// Columns must have the length given in the outline.
void readBlocks(const std::string& path, std::size_t most) {
    const std::unique_ptr<PointReader> reader = openPointReader(path);
    if (!reader) return;
    PointBlock block;
    while (reader->next(block, most)) {
        if (block.count() > most || block.columns.size() != reader->outline().columns.size()) std::abort();
        for (std::size_t i = 0; i < block.columns.size(); ++i)
            if (block.columns[i].size() != block.count() * reader->outline().columns[i].rowBytes()) std::abort();
    }
}

} // namespace

POINTRT_FUZZ_TARGET(points) {
    const fuzz::MemoryFile file(input);
    for (const std::size_t most : {std::size_t{3}, std::size_t{65536}})
        fuzz::expectReadOrRefused(file.path(), [&] { readBlocks(file.path(), most); });
}
