// SPDX-License-Identifier: Apache-2.0
#include "format/info/print.h"

#include <fmt/format.h>

#include "format/base/printable.h"
#include "format/info/metadata.h"

namespace pointrt {

namespace {

using Json = nlohmann::ordered_json;

std::string humanBytes(std::uint64_t bytes) {
    constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {} ({} bytes)", value, kUnits[unit], bytes);
}

const char* yesNo(std::uint32_t flags, std::uint32_t flag) { return flags & flag ? "yes" : "no"; }

/// Ten digits: millimetres in a national grid of metres.
std::string vectorText(const double v[3]) { return fmt::format("({:.10g}, {:.10g}, {:.10g})", v[0], v[1], v[2]); }

std::string levelsText(const Summary& summary) {
    std::string text =
        fmt::format("\n{:>7} {:>12} {:>14} {:>14}\n", "depth", "inner nodes", "filled leaves", "empty leaves");
    for (std::size_t depth = 0; depth < summary.levels.size(); ++depth) {
        const LevelSummary& level = summary.levels[depth];
        text += fmt::format("{:>7} {:>12} {:>14} {:>14}\n", depth, level.inner, level.filled, level.empty);
    }
    return text;
}

std::string indexText(const Summary& summary, const pro_index* index) {
    if (!index) return "none; viewers build it when they load";
    const auto& size = index->size;
    std::string text =
        fmt::format("{}, {:.1f} bytes a splat; grid of {} x {} x {}, {} bricks, ", humanBytes(summary.index_bytes),
                    static_cast<double>(summary.index_bytes) / summary.info.splat_count, size[0], size[1], size[2],
                    index->brick_count);
    if (index->group_count > 0) text += fmt::format("{} groups, ", index->group_count);
    return text + fmt::format("{} cells, {:.2f} near splats a cell", index->cell_count,
                              static_cast<double>(index->near_count) / index->cell_count);
}

std::string sectionsText(const Summary& summary) {
    std::string text = fmt::format("\n{:>7} {:>12} {:>14} {:>14}\n", "section", "elements", "bytes each", "at byte");
    for (const SectionSummary& section : summary.sections)
        text +=
            fmt::format("{:>7} {:>12} {:>14} {:>14}\n", section.kind, section.count, section.stride, section.offset);
    return text;
}

std::string materialsText(const ProFile& file) {
    std::string text = fmt::format("\n{:>8} {:>24} {:>13} {:>9} {:>10}\n", "material", "base colour", "reflectivity",
                                   "specular", "shininess");
    const auto floats = file.materials();
    for (std::size_t row = 0; row * PRO_MATERIAL_FLOATS < floats.size(); ++row) {
        const float* m = floats.data() + row * PRO_MATERIAL_FLOATS;
        text += fmt::format("{:>8} {:>24} {:>13.3g} {:>9.3g} {:>10.4g}\n", row,
                            fmt::format("{:.3g} {:.3g} {:.3g}", m[0], m[1], m[2]), m[PRO_MAT_REFLECTIVITY],
                            m[PRO_MAT_SPECULAR], m[PRO_MAT_SHININESS]);
    }
    return text;
}

Json vectorJson(const double v[3]) { return {v[0], v[1], v[2]}; }

Json sectionsJson(const Summary& summary) {
    Json sections = Json::array();
    for (const SectionSummary& section : summary.sections)
        sections.push_back({{"kind", section.kind},
                            {"count", section.count},
                            {"stride", section.stride},
                            {"offset", section.offset},
                            {"bytes", section.bytes},
                            {"required", section.required}});
    return sections;
}

Json levelsJson(const Summary& summary) {
    Json levels = Json::array();
    for (const LevelSummary& level : summary.levels)
        levels.push_back({{"inner", level.inner}, {"filled", level.filled}, {"empty", level.empty}});
    return levels;
}

/// Null where the file has none.
Json indexJson(const Summary& summary, const pro_index* index) {
    if (!index) return nullptr;
    return {{"bytes", summary.index_bytes}, {"grid", {index->size[0], index->size[1], index->size[2]}},
            {"bricks", index->brick_count}, {"groups", index->group_count},
            {"cells", index->cell_count},   {"near_splats", index->near_count},
            {"listed", index->list_count}};
}

Json materialsJson(const ProFile& file) {
    Json materials = Json::array();
    const auto floats = file.materials();
    for (std::size_t row = 0; row < floats.size(); row += PRO_MATERIAL_FLOATS) {
        const float* m = floats.data() + row;
        materials.push_back({{"base_color", {m[0], m[1], m[2]}},
                             {"reflectivity", m[PRO_MAT_REFLECTIVITY]},
                             {"specular", m[PRO_MAT_SPECULAR]},
                             {"shininess", m[PRO_MAT_SHININESS]}});
    }
    return materials;
}

Json flagsJson(const pro_info& info) {
    return {{"has_color", (info.flags & PRO_FLAG_COLOR) != 0},
            {"oriented", (info.flags & PRO_FLAG_ORIENTED) != 0},
            {"pruned", (info.flags & PRO_FLAG_PRUNED) != 0}};
}

} // namespace

std::string summaryText(const std::string& path, const Summary& s, const ProFile& file) {
    const pro_info& info = s.info;
    const float radius_min = info.radius_max * std::exp2(-float{PRO_RADIUS_CODE_MAX} * info.radius_step);
    std::string text = fmt::format("{}: .pro version {}.{}\n\n", printable(path, std::string::npos), info.version_major,
                                   info.version_minor);
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("{:<16}{}\n", name, value);
    };
    line("size", fmt::format("{}, {:.1f} bytes a splat", humanBytes(info.file_bytes), s.bytes_per_splat));
    line("splats", std::to_string(info.splat_count));
    line("octree", fmt::format("{} nodes to depth {}: {} filled leaves ({} with references only), {} empty", s.nodes,
                               info.max_depth, info.leaf_count, s.border_leaves, s.empty_leaves));
    line("references", fmt::format("{}, {:.2f} a splat", s.references, s.references_per_splat));
    line("bounds", fmt::format("{} to {} input units", vectorText(info.bounds_min), vectorText(info.bounds_max)));
    line("cube", fmt::format("edge {:.10g} from {} input units", info.scale, vectorText(info.origin)));
    line("radii",
         fmt::format("{:.4g} to {:.4g} input units, at most {:.2f} % too large", double{radius_min} * info.scale,
                     double{info.radius_max} * info.scale, 100 * s.radius_error));
    line("position error", fmt::format("at most {:.3g} input units", s.position_error));
    line("blending slab", fmt::format("{:.3g} radii to each side", info.blend_slab));
    line("tracing index", indexText(s, file.index()));
    line("colour", yesNo(info.flags, PRO_FLAG_COLOR));
    line("oriented", yesNo(info.flags, PRO_FLAG_ORIENTED));
    line("pruned", yesNo(info.flags, PRO_FLAG_PRUNED));
    text += levelsText(s) + sectionsText(s) + materialsText(file);
    if (!file.metadata().empty()) text += "\nmetadata " + dumpJson(parseMetadata(file.metadata()), true) + "\n";
    return text;
}

std::string summaryJson(const Summary& s, const ProFile& file) {
    const pro_info& info = s.info;
    Json json = {{"version", fmt::format("{}.{}", info.version_major, info.version_minor)},
                 {"file_bytes", info.file_bytes},
                 {"splats", info.splat_count},
                 {"nodes", s.nodes},
                 {"filled_leaves", info.leaf_count},
                 {"border_leaves", s.border_leaves},
                 {"empty_leaves", s.empty_leaves},
                 {"max_depth", info.max_depth},
                 {"references", s.references},
                 {"references_per_splat", s.references_per_splat},
                 {"bytes_per_splat", s.bytes_per_splat},
                 {"origin", vectorJson(info.origin)},
                 {"scale", info.scale},
                 {"bounds_min", vectorJson(info.bounds_min)},
                 {"bounds_max", vectorJson(info.bounds_max)}};
    json.update(flagsJson(info));
    json["blend_slab"] = info.blend_slab;
    json["radius_max"] = info.radius_max * info.scale;
    json["radius_error"] = s.radius_error;
    json["position_error"] = s.position_error;
    json["index"] = indexJson(s, file.index());
    json["levels"] = levelsJson(s);
    json["sections"] = sectionsJson(s);
    json["materials"] = materialsJson(file);
    json["metadata"] = parseMetadata(file.metadata());
    return dumpJson(json, false) + "\n";
}

} // namespace pointrt
