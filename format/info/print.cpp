// SPDX-License-Identifier: Apache-2.0
#include "format/info/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "format/base/number_type.h"
#include "format/base/printable.h"
#include "format/info/histogram.h"
#include "format/info/words.h"
#include "format/pointio/metadata.h"

namespace pointrt {

namespace {

using Json = nlohmann::ordered_json;

const char* yesNo(std::uint32_t flags, std::uint32_t flag) { return flags & flag ? "yes" : "no"; }

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
    return text + fmt::format("{} cells, {:.2f} near splats for each splat", index->cell_count,
                              static_cast<double>(index->near_count) / summary.info.splat_count);
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

/// "2: 61 %, 5: 39 %" for a few different values, else bars from the lowest to the highest.
std::string histogramText(const Histogram& histogram, std::uint64_t numbers) {
    constexpr std::size_t kListed = 8;
    std::string text;
    if (!histogram.values.empty() && histogram.values.size() <= kListed) {
        for (const auto& [value, count] : histogram.values)
            text += fmt::format("{}{:.10g}: {:.3g} %", text.empty() ? "" : ", ", value,
                                100 * static_cast<double>(count) / static_cast<double>(numbers));
        return text;
    }
    constexpr const char* kBars[] = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    const std::uint64_t most = *std::max_element(histogram.bins.begin(), histogram.bins.end());
    for (const std::uint64_t count : histogram.bins) text += kBars[most == 0 ? 0 : (count * 8 + most - 1) / most];
    if (histogram.not_finite > 0) text += fmt::format(", {} not finite", histogram.not_finite);
    return text;
}

std::string attributesText(const ProFile& file) {
    if (file.attributes().empty()) return {};
    std::string text = fmt::format("\n{:<20} {:<10} {:>24}  {}\n", "attribute", "type", "from ... to", "values");
    for (const pro_attribute& each : file.attributes()) {
        const std::string type =
            fmt::format("{}{}", typeName(each.type), each.components > 1 ? fmt::format(" x {}", each.components) : "");
        const Histogram histogram = histogramOf(each, file.info().splat_count);
        text += fmt::format("{:<20} {:<10} {:>24}  {}\n", printable(each.name, std::string::npos), type,
                            fmt::format("{:.10g} ... {:.10g}", each.low, each.high),
                            histogramText(histogram, std::uint64_t{file.info().splat_count} * each.components));
    }
    return text;
}

std::string sensorsText(const pro_world& world) {
    std::uint32_t known = 0;
    for (std::uint32_t i = 0; i < world.sensor_count; ++i)
        known += world.sensors[std::size_t{i} * PRO_SENSOR_DOUBLES + 3] != 0;
    return fmt::format("{} of {} scans", known, world.sensor_count);
}

/// Range and median, in radii and in input units.
std::string noiseText(const Summary& summary, const ProFile& file) {
    const NoiseSummary& noise = summary.noise;
    if (file.noise().empty()) return "none";
    return fmt::format("{:.3g} to {:.3g} radii, {:.4g} to {:.4g} input units; median {:.3g} radii, {:.4g} input units",
                       noise.low_radii, noise.high_radii, noise.low, noise.high, noise.median_radii,
                       file.sampling().noise_median);
}

std::string filledText(const ProFile& file) {
    const pro_sampling& sampling = file.sampling();
    return fmt::format("{} splats fill gaps between {} points", sampling.filled_count, sampling.input_count);
}

double perSplat(std::uint64_t count, const Summary& summary) {
    return static_cast<double>(count) / summary.info.splat_count;
}

/// "250000, 66.4 bytes each (GAUS 16.0, ...)".
std::string gaussiansText(const Summary& summary) {
    std::string text =
        fmt::format("{}, {:.1f} bytes each (", summary.info.splat_count, perSplat(summary.gaussians.bytes, summary));
    for (const SectionSummary& section : summary.gaussians.sections)
        text +=
            fmt::format("{}{} {:.1f}", text.back() == '(' ? "" : ", ", section.kind, perSplat(section.bytes, summary));
    return text + ")";
}

std::string gaussianTreeText(const Summary& summary, const pro_gaussians& gaussians) {
    return fmt::format("{} nodes, {:.2f} for each Gaussian; {} list entries, {:.2f} for each", gaussians.node_count,
                       perSplat(gaussians.node_count, summary), gaussians.list_count,
                       perSplat(gaussians.list_count, summary));
}

Json gaussiansJson(const Summary& summary, const pro_gaussians& gaussians) {
    Json bytes = Json::object();
    for (const SectionSummary& section : summary.gaussians.sections) bytes[section.kind] = section.bytes;
    return {{"count", summary.info.splat_count},
            {"degree", gaussians.degree},
            {"bytes", bytes},
            {"bytes_per_gaussian", perSplat(summary.gaussians.bytes, summary)},
            {"nodes", gaussians.node_count},
            {"nodes_per_gaussian", perSplat(gaussians.node_count, summary)},
            {"list_entries", gaussians.list_count},
            {"list_entries_per_gaussian", perSplat(gaussians.list_count, summary)}};
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

/// Null if the file has none.
Json indexJson(const Summary& summary, const pro_index* index) {
    if (!index) return nullptr;
    return {{"bytes", summary.index_bytes},     {"grid", {index->size[0], index->size[1], index->size[2]}},
            {"bricks", index->brick_count},     {"groups", index->group_count},
            {"cells", index->cell_count},       {"near_splats", index->near_count},
            {"blending", index->blending_count}};
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

Json histogramJson(const Histogram& histogram) {
    Json json;
    if (!histogram.values.empty()) {
        json["values"] = Json::object();
        for (const auto& [value, count] : histogram.values) json["values"][fmt::format("{:.17g}", value)] = count;
    } else {
        json["bins"] = histogram.bins;
    }
    json["not_finite"] = histogram.not_finite;
    return json;
}

Json attributesJson(const ProFile& file) {
    Json attributes = Json::array();
    for (const pro_attribute& each : file.attributes())
        attributes.push_back({{"name", each.name},
                              {"type", typeName(each.type)},
                              {"components", each.components},
                              {"low", each.low},
                              {"high", each.high},
                              {"histogram", histogramJson(histogramOf(each, file.info().splat_count))}});
    return attributes;
}

/// Null if the scan has none.
Json sensorsJson(const pro_world& world) {
    Json sensors = Json::array();
    for (std::uint32_t i = 0; i < world.sensor_count; ++i) {
        const double* sensor = world.sensors + std::size_t{i} * PRO_SENSOR_DOUBLES;
        sensors.push_back(sensor[3] == 0 ? Json() : vectorJson(sensor));
    }
    return sensors;
}

/// Null for a clean scan.
Json noiseJson(const Summary& summary, const ProFile& file) {
    if (file.noise().empty()) return nullptr;
    const NoiseSummary& noise = summary.noise;
    return {{"low", noise.low},
            {"median", file.sampling().noise_median},
            {"high", noise.high},
            {"low_radii", noise.low_radii},
            {"median_radii", noise.median_radii},
            {"high_radii", noise.high_radii}};
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
    if (info.flags & PRO_FLAG_BALLS) line("balls", fmt::format("{} of the splats", s.balls));
    if (const pro_gaussians* const gaussians = file.gaussians()) {
        line("Gaussians", gaussiansText(s));
        line("harmonics", fmt::format("degree {}", gaussians->degree));
        line("Gaussian tree", gaussianTreeText(s, *gaussians));
    }
    line("up", upText(file.world()));
    line("input unit", unitText(file.world()));
    line("noise", noiseText(s, file));
    if (file.sampling().filled_count > 0) line("filled", filledText(file));
    if (file.world().sensor_count > 0) line("sensors", sensorsText(file.world()));
    text += attributesText(file) + levelsText(s) + sectionsText(s) + materialsText(file);
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
    const pro_world& world = file.world();
    json["up"] = {world.up[0], world.up[1], world.up[2]};
    json["metres_per_unit"] = world.metres_per_unit;
    json["sensors"] = sensorsJson(world);
    json["input_points"] = file.sampling().input_count > 0 ? Json(file.sampling().input_count) : Json();
    json["filled"] = file.sampling().filled_count;
    if (info.flags & PRO_FLAG_BALLS) json["balls"] = s.balls;
    if (file.gaussians()) json["gaussians"] = gaussiansJson(s, *file.gaussians());
    json["noise"] = noiseJson(s, file);
    json["attributes"] = attributesJson(file);
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
