// SPDX-License-Identifier: Apache-2.0
// .pro files: opened in every way, traversed as by a tracer, and verified.
#include <cstdio>
#include <cstdlib>

#include "tests/format/file_bytes.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/header_share.h"

using namespace pointrt;

namespace {

constexpr float kLargestRadius = 4; // cube units, the limit of radius_max in SPEC

/// Decodes all splats, which touchEverything does not.
double sumOfSplats(const test::Bytes& bytes) {
    pro_file* file = nullptr;
    if (pro_open_memory(bytes.data(), bytes.size(), PRO_OPEN_SKIP_CHECKSUMS, &file, nullptr) != PRO_OK) return 0;
    pro_info info;
    pro_view view;
    pro_get_info(file, &info);
    pro_get_view(file, &view);
    double sum = 0;
    for (std::size_t i = 0; i < info.splat_count; ++i) {
        pro_splat splat;
        pro_splat_decode(view.splats + i * PRO_SPLAT_WORDS, info.radius_max, info.radius_step, &splat);
        for (const float value : {splat.position[0], splat.normal[1]})
            if (!(value >= -1 && value <= 1)) std::abort(); // cube units, and a unit vector
        if (!(splat.radius > 0 && splat.radius <= kLargestRadius)) std::abort();
        sum += double(splat.radius);
    }
    pro_close(file);
    return sum;
}

} // namespace

POINTRT_FUZZ_TARGET(pro) {
    const auto* const first = reinterpret_cast<const std::byte*>(input.data());
    const test::Bytes bytes(first, first + input.size());
    const test::OpenResult opened = test::openCopy(bytes);
    fuzz::countMutant(opened.result, opened.message.finding);
    test::openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS);
    test::openCopy(bytes, PRO_OPEN_SKIP_CHECKSUMS | PRO_OPEN_TRACE);
    [[maybe_unused]] static volatile double sum;
    sum = sumOfSplats(bytes);
}
