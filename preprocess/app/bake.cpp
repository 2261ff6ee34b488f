// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/bake.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "format/base/error.h"
#include "format/os/atomic_file.h"
#include "preprocess/app/bake_progress.h"
#include "preprocess/app/checks.h"
#include "preprocess/app/interrupt.h"
#include "preprocess/app/summary.h"
#include "preprocess/octree/file_index.h"
#include "preprocess/octree/gaussians.h"
#include "preprocess/octree/splat_attributes.h"
#include "preprocess/octree/write.h"
#include "preprocess/surface/find_up.h"
#include "preprocess/surface/gaussian_surface.h"

namespace pointrt {

namespace {

/// Throws before the work rather than after it if the output cannot be written.
void checkOutput(const BakeOptions& options) {
    format::AtomicFile output;
    if (output.open(options.output, options.force ? format::Existing::kReplaced : format::Existing::kKept)) return;
    throw Error(ExitCode::kCannotWrite,
                options.output + ": " + output.error() + (output.nameIsTaken() ? "; --force overwrites it" : ""));
}

std::string sourceName(const BakeOptions& options) {
    return options.inputs.size() == 1
               ? options.inputs.front()
               : options.inputs.front() + " and " + std::to_string(options.inputs.size() - 1) + " more";
}

/// Prefixes errors that concern all inputs together, found after reading, with their name.
Splats estimateNamed(Cloud&& cloud, const BakeOptions& options, BakeReport& report, BakeProgress& progress) {
    std::string stage;
    const std::uint64_t points = cloud.positions.size();
    const auto show = [&](const char* name, double share) {
        if (stage != name) progress.begin(stage = name, points);
        progress.update(share);
    };
    try {
        return estimateSplats(std::move(cloud), options.surface, report.surface, show);
    } catch (const Error& error) {
        throw Error(error.code, sourceName(options) + ": " + error.what());
    }
}

/// Moves all but the points from cloud to the content of the file; report gets the names of attributes.
ProContent takeMetadata(const BakeOptions& options, Cloud& cloud, BakeReport& report) {
    fitAttributes(cloud);
    ProContent content;
    content.attributes = std::exchange(cloud.attributes, {});
    content.sensors = sensorRows(cloud.scans);
    if (!cloud.world.up.isZero()) report.up_from = cloud.world.up_by_custom ? "format" : "file";
    if (!options.up.isZero()) {
        cloud.world.up = options.up;
        report.up_from = "option";
    }
    content.world = report.world = cloud.world;
    for (const Attribute& each : content.attributes)
        report.attributes.push_back({each.name, each.type, each.components, {}});
    report.scans = cloud.scans;
    report.source_header = std::move(cloud.source_header);
    report.notes = std::move(cloud.notes);
    return content;
}

bool isUpKnown(const BakeReport& report) { return report.up_from == "option" || report.up_from == "file"; }

/// Balls have no sides, so up is found from discs of some of their points.
Splats discsOf(const Cloud& cloud, const BakeOptions& options) {
    constexpr std::size_t kEnough = 100'000; // findUp samples fewer
    const std::size_t step = 1 + cloud.positions.size() / kEnough;
    Cloud some;
    some.origin = cloud.origin;
    some.normal_sides = cloud.normal_sides;
    for (std::size_t i = 0; i < cloud.positions.size(); i += step) {
        some.positions.push_back(cloud.positions[i]);
        if (!cloud.normals.empty()) some.normals.push_back(cloud.normals[i]);
    }
    SurfaceOptions surface = options.surface;
    surface.splat = SplatShape::kDisc;
    surface.normals = SurfaceOptions().normals; // balls need none
    SurfaceReport report;
    return estimateSplats(std::move(some), surface, report, {});
}

/// Finds or guesses the up direction unless the command line or a file gives it. Evidence from the surface overrides
/// the convention of a format.
void findUpInData(const Splats& splats, BakeReport& report, WorldFrame& world) {
    if (isUpKnown(report)) return;
    const FoundUp found = findUp(splats, report.scans, {world.up, areMeshes(report.files)});
    if (found.up.isZero()) return;
    world.up = report.world.up = found.up;
    report.up_from = nameOf(found.basis);
    report.up_reason = found.reason;
}

/// Without evidence in a capture, the convention of its format is only a guess: programs keep the frame that their
/// cameras had.
void findUpOfCapture(const GaussianCloud& gaussians, BakeReport& report, WorldFrame& world) {
    findUpInData(surfaceOfGaussians(gaussians.points, gaussians.columns), report, world);
    if (report.up_from == nameOf(UpBasis::kCustom)) report.up_from = nameOf(UpBasis::kGuess);
}

void store(const BakeOptions& options, ProContent content, const PackedSplats& splats, const Octree& octree,
           BakeReport& report, BakeProgress& progress) {
    content.attributes = gatherAttributes(content.attributes, sourcePoints(splats));
    report.filled = splats.filled;
    content.materials = {scanMaterial((splats.frame.flags & PRO_FLAG_COLOR) != 0, options.reflectivity)};
    content.metadata = metadataJson(options, report);
    content.pruned = options.prune;
    const ProSections sections = makeSections(splats, octree, content);
    TracingIndex index;
    pro_index index_view{};
    if (options.index) {
        progress.begin("index", report.splats);
        index = fileIndex(sections, {threadCount(options), [&](double share) { progress.update(share); }},
                          sourceName(options), "--compact omits the index, for viewers other than pointrt-view");
        index_view = indexView(index);
    }
    progress.begin("write", report.splats);
    ignoreInterrupts();
    report.octree = writePro(options.output, options.force, sections, options.index ? &index_view : nullptr);
}

/// Gaussians are kept as they are: the surface stages do not change them.
void bakeGaussians(const BakeOptions& options, Cloud& cloud, BakeReport& report, BakeProgress& progress) {
    const GaussianCloud gaussians = [&] {
        try {
            return takeGaussians(cloud);
        } catch (const Error& error) {
            throw Error(error.code, sourceName(options) + ": " + error.what());
        }
    }();
    ProContent content = takeMetadata(options, cloud, report);
    for (const Note& note : report.notes) progress.note(noteLine(note));
    findUpOfCapture(gaussians, report, content.world);
    progress.begin("quantize", gaussians.points.positions.size());
    PackedSplats packed = packGaussianSplats(gaussians);
    report.splats = report.gaussians = packed.words.size();
    progress.begin("octree", report.splats);
    const Octree octree = buildCenterOctree(packed);
    const GaussianSections sections = packGaussians(gaussians, packed);
    content.attributes = gatherAttributes(content.attributes, sourcePoints(packed));
    content.materials = {scanMaterial(true, options.reflectivity)};
    content.metadata = metadataJson(options, report);
    progress.begin("write", report.splats);
    ignoreInterrupts();
    ProSections scan = makeSections(packed, octree, content);
    report.octree = writePro(options.output, options.force, scan, nullptr, &sections.view);
}

/// Converts points to a surface of splats.
void bakeSurface(const BakeOptions& options, Cloud&& cloud, BakeReport& report, BakeProgress& progress) {
    const auto show = [&](double share) { progress.update(share); };
    ProContent content = takeMetadata(options, cloud, report);
    for (const Note& note : report.notes) progress.note(noteLine(note));

    std::optional<Splats> discs;
    if (options.surface.splat == SplatShape::kBall && !isUpKnown(report)) discs = discsOf(cloud, options);
    Splats splats = estimateNamed(std::move(cloud), options, report, progress);
    findUpInData(discs ? *discs : splats, report, content.world);
    discs.reset();
    progress.begin("quantize", splats.positions.size());
    PackedSplats packed = quantizeSplats(std::move(splats));
    report.merged = packed.merged;
    report.splats = packed.words.size();
    report.balls = static_cast<std::uint64_t>(std::count_if(
        packed.words.begin(), packed.words.end(), [](const auto& words) { return pro_splat_is_ball(words.data()); }));

    progress.begin("octree", report.splats);
    Octree octree = buildOctree(packed, options.octree, show);
    report.references_unpruned = report.splats + octree.refs.size();
    if (options.prune) {
        progress.begin("prune", report.splats);
        report.harm_allowed = options.pruning.harm;
        report.pruning = pruneOctree(packed, options.pruning, octree, show);
    }
    freeBuildData(packed);
    store(options, std::move(content), packed, octree, report, progress);
}

std::vector<std::string_view> skippedStages(const BakeOptions& options) {
    std::vector<std::string_view> stages;
    if (options.surface.splat == SplatShape::kBall) stages = {"normals", "orientation", "cleaning"};
    if (!options.prune) stages.emplace_back("prune");
    if (!options.index) stages.emplace_back("index");
    return stages;
}

} // namespace

BakeReport bake(const BakeOptions& options) {
    requireNoInput(options, options.output, "--output");
    checkOutput(options);
    checkStats(options);
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, threadCount(options));
    BakeProgress progress(options.verbosity, options.progress, skippedStages(options));
    const auto show_read = [&](const ReadStatus& status) {
        if (status.share > 0)
            progress.setPoints(static_cast<std::uint64_t>(static_cast<double>(status.points) / status.share));
        progress.update(status.share);
    };
    BakeReport report;

    progress.begin("read", 0);
    Cloud cloud = readInputs(options.inputs, options.read, show_read, &report.files);
    progress.setPoints(cloud.positions.size());
    for (const FileReport& file : report.files) report.points_sampled += file.sampled;
    report.input_points = report.points_sampled > 0 ? cloud.positions.size() : cloud.points_read;
    report.points_non_finite = cloud.points_non_finite;
    report.points_unused = cloud.points_unused;
    report.points_filtered = cloud.points_filtered;
    report.points_no_data = cloud.points_no_data;
    report.points_withheld = cloud.points_withheld;
    if (report.files.size() > 1)
        for (const FileReport& file : report.files) progress.detail(fileLine(file) + rateText(file));
    progress.note(inputLine(report));
    if (gaussianColumns(cloud))
        bakeGaussians(options, cloud, report, progress);
    else
        bakeSurface(options, std::move(cloud), report, progress);
    progress.finish();
    progress.note(changesLine(report));
    if (report.gaussians == 0) progress.detail(octreeLine(report));
    report.seconds = progress.seconds();
    report.seconds_total = progress.totalSeconds();
    return report;
}

} // namespace pointrt
