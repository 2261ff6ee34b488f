// SPDX-License-Identifier: GPL-3.0-or-later
// The format of PlayCanvas' splat-transform:
// https://developer.playcanvas.com/user-manual/gaussian-splatting/formats/sog/
#include "preprocess/input/gaussian/sog_meta.h"

#include <nlohmann/json.hpp>

#include "preprocess/ingest/json_value.h"
#include "preprocess/input/gaussian/gaussians.h"

namespace pointrt {
namespace {

/// Labels of harmonics have 16 bits.
constexpr std::uint64_t kMostPalette = 1 << 16;

Vec3d threeNumbers(const JsonValue& value) {
    return {value.at(0).number(), value.at(1).number(), value.at(2).number()};
}

/// Version 1: fractions of a range.
ByteTable rangeTable(double low, double high) {
    ByteTable table{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = static_cast<float>(low + (high - low) * static_cast<double>(i) / 255);
    return table;
}

/// Version 2: a codebook. Some writers left the first value null; it is then extrapolated from the next two.
ByteTable codebookTable(const JsonValue& section) {
    const JsonValue codebook = section.member("codebook");
    ByteTable table{};
    if (codebook.size() != table.size())
        codebook.refuse(fmt::format("has {} values, but must have {}", codebook.size(), table.size()));
    const bool first_missing = codebook.at(0).isNull();
    for (std::size_t i = first_missing ? 1 : 0; i < table.size(); ++i)
        table[i] = static_cast<float>(codebook.at(i).number());
    if (first_missing) table[0] = table[1] + (table[1] - table[255]) / 255;
    return table;
}

/// The tables of a section, by axis or channel.
ByteTable partTable(const JsonValue& section, std::size_t part) {
    return rangeTable(section.member("mins").at(part).number(), section.member("maxs").at(part).number());
}

void readTables(const JsonValue& root, bool has_codebooks, SogMeta& meta) {
    const JsonValue scales = root.member("scales"), colors = root.member("sh0");
    if (has_codebooks) {
        meta.scales.fill(codebookTable(scales));
        meta.colors.fill(codebookTable(colors));
        meta.opacities = rangeTable(0, 1);
        return;
    }
    for (std::size_t part = 0; part < 3; ++part) {
        meta.scales[part] = partTable(scales, part);
        meta.colors[part] = partTable(colors, part);
    }
    meta.opacities = partTable(colors, 3);
    for (float& opacity : meta.opacities) opacity = sigmoid(opacity);
}

void readHarmonics(const JsonValue& section, bool has_codebooks, SogMeta& meta) {
    const JsonValue files = section.member("files");
    meta.images.centroids = files.at(0).text();
    meta.images.labels = files.at(1).text();
    if (has_codebooks) {
        meta.harmonics = codebookTable(section);
        meta.degree = static_cast<int>(section.member("bands").integer(3));
        meta.palette = section.member("count").integer(kMostPalette);
    } else {
        meta.harmonics = rangeTable(section.member("mins").number(), section.member("maxs").number());
    }
}

void readImageNames(const JsonValue& root, SogImageNames& names) {
    const auto file = [&](const char* section, std::size_t index) {
        return root.member(section).member("files").at(index).text();
    };
    names.means_low = file("means", 0);
    names.means_high = file("means", 1);
    names.quats = file("quats", 0);
    names.scales = file("scales", 0);
    names.colors = file("sh0", 0);
}

} // namespace

SogMeta parseSogMeta(const InputFile& input) {
    const nlohmann::json json = parseJson(input, input.bytes);
    const JsonValue root(input, json);
    constexpr std::uint64_t kNewest = 2;
    const std::uint64_t version = root.has("version") ? root.member("version").integer() : 1;
    if (version < 1 || version > kNewest)
        refuse(input, fmt::format("has version {}; this build reads SOG versions 1 to {}", version, kNewest));
    const bool has_codebooks = version == kNewest;
    const JsonValue means = root.member("means");
    SogMeta meta;
    meta.count = has_codebooks ? root.member("count").integer() : means.member("shape").at(0).integer();
    meta.low = threeNumbers(means.member("mins"));
    meta.high = threeNumbers(means.member("maxs"));
    readTables(root, has_codebooks, meta);
    readImageNames(root, meta.images);
    const auto harmonics = root.optionalMember("shN");
    if (harmonics && !(has_codebooks && harmonics->member("bands").integer(3) == 0))
        readHarmonics(*harmonics, has_codebooks, meta);
    return meta;
}

} // namespace pointrt
