// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/splat_selection.h"

#include <algorithm>
#include <array>
#include <bit>

#include "format/base/parallel.h"
#include "pointrt/pro_index_layout.h"
#include "pointrt/pro_layout.h"

namespace pointrt {
namespace {

/// Splats per task: they and their numbers fit in the L1 cache, and they fill whole words of bits.
constexpr std::size_t kSelectedAtOnce = 1024;
constexpr std::size_t kBits = 64;
/// Near splats per task.
constexpr std::size_t kCopiedAtOnce = std::size_t{1} << 16;

bool isShown(const std::vector<std::uint64_t>& shown, std::size_t splat) {
    return (shown[splat / kBits] >> splat % kBits & 1) != 0;
}

/// For splats from number first on: sets the bits of those that are in all selections.
void selectSplats(const std::vector<SplatOverride::OfNumbers>& selections, std::size_t first, std::span<bool> shown) {
    std::fill(shown.begin(), shown.end(), true);
    std::vector<double> numbers(shown.size());
    for (const SplatOverride::OfNumbers& each : selections) {
        readNumbers(each.numbers, first, numbers);
        for (std::size_t i = 0; i < shown.size(); ++i) shown[i] = shown[i] && holdsNumber(each.ranges, numbers[i]);
    }
}

} // namespace

std::vector<std::uint64_t> shownSplats(const std::vector<SplatOverride::OfNumbers>& selections, std::size_t count) {
    std::vector<std::uint64_t> bits((count + kBits - 1) / kBits);
    forAll((count + kSelectedAtOnce - 1) / kSelectedAtOnce, [&](std::size_t k) {
        const std::size_t first = k * kSelectedAtOnce;
        std::array<bool, kSelectedAtOnce> shown;
        const auto part = std::span(shown).first(std::min(kSelectedAtOnce, count - first));
        selectSplats(selections, first, part);
        for (std::size_t i = 0; i < part.size(); ++i)
            bits[(first + i) / kBits] |= std::uint64_t{part[i]} << (first + i) % kBits;
    });
    return bits;
}

void moveHiddenAway(const std::vector<std::uint64_t>& shown, std::size_t first, std::span<std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size() / PRO_SPLAT_WORDS; ++i) {
        if (isShown(shown, first + i)) continue;
        words[i * PRO_SPLAT_WORDS] = 0;
        words[i * PRO_SPLAT_WORDS + 1] &= PRO_SPLAT_BALL;
    }
}

namespace {

/// The code of a near splat's squared radius multiplied by a factor; at least 1 if it was above 0, since 0 means no
/// splat.
std::uint32_t resizedCode(std::uint32_t code, float square) {
    if (code == 0) return 0;
    const float before = std::bit_cast<float>((code << PRO_NEAR_RADIUS_SHIFT) + PRO_NEAR_RADIUS_BIAS);
    const auto bits = std::bit_cast<std::uint32_t>(before * square);
    return std::max(1u, (std::max(bits, PRO_NEAR_RADIUS_BIAS) - PRO_NEAR_RADIUS_BIAS) >> PRO_NEAR_RADIUS_SHIFT);
}

} // namespace

void resizeNear(float factor, std::span<std::uint32_t> near) {
    constexpr std::size_t kWordsAtOnce = kCopiedAtOnce * PRO_NEAR_WORDS;
    forAll((near.size() + kWordsAtOnce - 1) / kWordsAtOnce, [&](std::size_t task) {
        const std::size_t end = std::min((task + 1) * kWordsAtOnce, near.size());
        for (std::size_t k = task * kWordsAtOnce; k < end; k += PRO_NEAR_WORDS) {
            std::uint32_t &high = near[k], &low = near[k + 1];
            const std::uint32_t code =
                (high & PRO_NEAR_RADIUS_HIGH_MASK) << PRO_NEAR_RADIUS_LOW_BITS | (low & PRO_NEAR_RADIUS_LOW_MASK);
            const std::uint32_t resized = resizedCode(code, factor * factor);
            high = (high & ~PRO_NEAR_RADIUS_HIGH_MASK) | resized >> PRO_NEAR_RADIUS_LOW_BITS;
            low = (low & ~PRO_NEAR_RADIUS_LOW_MASK) | (resized & PRO_NEAR_RADIUS_LOW_MASK);
        }
    });
}

void copyShownNear(const std::vector<std::uint64_t>& shown, std::span<const std::uint32_t> near,
                   std::span<const std::uint32_t> listed, std::span<std::uint32_t> copy) {
    forAll((listed.size() + kCopiedAtOnce - 1) / kCopiedAtOnce, [&](std::size_t task) {
        const std::size_t end = std::min((task + 1) * kCopiedAtOnce, listed.size());
        for (std::size_t k = task * kCopiedAtOnce; k < end; ++k) {
            const bool is_shown = isShown(shown, listed[k]);
            for (std::size_t word = PRO_NEAR_WORDS * k; word < PRO_NEAR_WORDS * (k + 1); ++word)
                copy[word] = is_shown ? near[word] : 0;
        }
    });
}

} // namespace pointrt
