// SPDX-License-Identifier: Apache-2.0
// Entry point of libFuzzer in a program with one target.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const pointrt::fuzz::Target& target = pointrt::fuzz::onlyTarget();
    target.run({data, size});
    return 0;
}
