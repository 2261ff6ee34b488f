// SPDX-License-Identifier: Apache-2.0
// The metadata of .pro files, as printed by pointrt-info.
#include "format/pointio/metadata.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(metadata) {
    fuzz::expectReadOrRefused("", [&] {
        const nlohmann::ordered_json json = parseMetadata(fuzz::textOf(input));
        for (const bool ascii : {false, true}) dumpJson(json, ascii);
    });
}
