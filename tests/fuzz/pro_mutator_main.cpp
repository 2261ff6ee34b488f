// SPDX-License-Identifier: Apache-2.0
// Lets libFuzzer mutate .pro files by mutatePro.
#include <algorithm>

#include "tests/fuzz/pro_mutator.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    std::mt19937 random(seed);
    const std::vector<std::uint8_t> mutant =
        pointrt::fuzz::mutatePro({data, data + size}, most, random, LLVMFuzzerMutate);
    std::copy(mutant.begin(), mutant.end(), data);
    return mutant.size();
}
