// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/make_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "format/base/error.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/surface/find_up.h"
#include "preprocess/tiles/choose_tiles.h"
#include "preprocess/tiles/gaussian_tiles.h"
#include "preprocess/tiles/grid_priors.h"
#include "preprocess/tiles/input_state.h"
#include "preprocess/tiles/sample.h"

namespace pointrt {
namespace {

/// Sample size, enough for the shape of a country; doubling the cells leaves at least a quarter.
constexpr std::size_t kSamplePoints = 400'000;

/// Cells of the counting grid: at most 96 bytes each, a tenth of the memory.
std::size_t mostCells(std::uint64_t max_memory) {
    constexpr std::uint64_t kBytesPerCell = 1024, kFewest = 1 << 16, kMost = 1 << 20;
    return std::clamp(max_memory / kBytesPerCell, kFewest, kMost);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Data collected in the first pass.
struct Survey {
    CountGrid counts;
    Sample sample{kSamplePoints};
    GaussianSample gaussians;
    Eigen::AlignedBox3d bounds;
    std::vector<ValueSurvey> values; ///< [attributes of the cloud]
    bool normals = false, radii = false;
    bool noise = false, grids = false;
    std::uint64_t kept = 0;          ///< points
    std::uint64_t normals_given = 0; ///< points with a normal

    explicit Survey(std::uint64_t max_memory) : counts(mostCells(max_memory)) {}

    void add(const PointBatch& batch) {
        const Cloud& cloud = batch.cloud;
        gaussians.add(cloud, batch.positions);
        for (const Vec3d& position : batch.positions) bounds.extend(position);
        values.resize(std::max(values.size(), cloud.attributes.size()));
        for (std::size_t i = 0; i < cloud.attributes.size(); ++i)
            values[i].add(cloud.attributes[i], contains(batch.untyped, cloud.attributes[i].name));
        for (const Vec3f& normal : cloud.normals) normals_given += !normal.isZero(0);
        radii |= std::any_of(cloud.radii.begin(), cloud.radii.end(), [](float radius) { return radius > 0; });
        counts.add(batch.positions, [&](std::size_t i) {
            SamplePoint point{batch.positions[i]};
            if (!cloud.normals.empty()) point.normal = cloud.normals[i];
            point.scan = static_cast<std::uint32_t>(batch.scan);
            sample.add(point, counts.edge());
        });
        normals = normals_given > 0;
    }
};

Scalar scanNumberType(std::size_t bytes) { return bytes == 1 ? Scalar::kU8 : bytes == 2 ? Scalar::kU16 : Scalar::kU32; }

PlanSchema schemaOf(const StreamFindings& found, const Survey& survey, const AttributeChoice& choice) {
    PlanSchema schema;
    schema.normals = survey.normals;
    schema.normal_sides = found.cloud.normal_sides;
    schema.colors = found.colors;
    schema.radii = survey.radii;
    schema.noise = survey.noise;
    schema.silhouettes = survey.grids;
    const std::size_t scans = found.scan_points.size();
    if (scans > 1) schema.scan_bytes = scans <= 0x100 ? 1 : scans <= 0x10000 ? 2 : 4;
    const std::uint64_t points = std::accumulate(found.scan_points.begin(), found.scan_points.end(), std::uint64_t{0});
    bool scan_taken = false;
    for (std::size_t i = 0; i < found.cloud.attributes.size(); ++i) {
        const Attribute& each = found.cloud.attributes[i];
        const ValueSurvey values = i < survey.values.size() ? survey.values[i] : ValueSurvey{};
        if (contains(found.minor, each.name) && !values.any) continue;
        const bool untyped = contains(found.untyped, each.name);
        const Scalar type = untyped ? values.smallestType(each.type, values.values == points) : each.type;
        schema.attributes.push_back({each.name, type, each.components, each.type});
        scan_taken |= each.name == kScanNumber;
    }
    schema.scan_attribute = scans > 1 && !scan_taken && choice.selects(kScanNumber);
    const Scalar type = scanNumberType(schema.scan_bytes);
    if (schema.scan_attribute) schema.attributes.push_back({kScanNumber, type, 1, type});
    return schema;
}

std::vector<PlanScan> scansOf(const StreamFindings& found) {
    std::vector<PlanScan> scans;
    for (std::size_t i = 0; i < found.cloud.scans.size(); ++i)
        scans.push_back(
            {found.cloud.scans[i].name, found.cloud.scans[i].sensor, found.scan_points[i], found.largest_color[i], {}});
    for (const StreamNoData& each : found.no_data) scans[each.scan].no_data.push_back(each.points);
    return scans;
}

/// The sample as a cloud, sorted by scan, as readers deliver it.
Cloud cloudOf(const std::vector<SamplePoint>& points, const SetPlan& plan) {
    Cloud cloud;
    cloud.world = plan.world;
    cloud.normal_sides = plan.schema.normal_sides;
    cloud.origin = plan.lattice_origin;
    std::vector<std::uint32_t> sensor_of_scan(plan.scans.size(), kNoSensor);
    for (std::size_t i = 0; i < plan.scans.size(); ++i) {
        if (!plan.scans[i].sensor) continue;
        sensor_of_scan[i] = static_cast<std::uint32_t>(cloud.sensors.size());
        cloud.sensors.push_back((*plan.scans[i].sensor - cloud.origin).cast<float>());
    }
    for (const SamplePoint& point : points) {
        if (!plan.bounds.contains(point.position)) continue; // skips strays
        cloud.positions.push_back((point.position - cloud.origin).cast<float>());
        if (plan.schema.normals) cloud.normals.push_back(point.normal);
        if (!cloud.sensors.empty()) cloud.sensor_of_point.push_back(sensor_of_scan[point.scan]);
    }
    return cloud;
}

/// Whether each tile's normals can be oriented without its neighbours.
bool sidesAreKnown(const SetPlan& plan, const Survey& survey, OrientMode mode) {
    if (mode == OrientMode::kNone || mode == OrientMode::kSensor || mode == OrientMode::kUp) return true;
    if (mode == OrientMode::kMst) return false;
    const bool all_sensors = std::all_of(plan.scans.begin(), plan.scans.end(),
                                         [](const PlanScan& scan) { return scan.sensor || scan.points == 0; });
    const bool no_sensors = std::none_of(plan.scans.begin(), plan.scans.end(),
                                         [](const PlanScan& scan) { return scan.sensor.has_value(); });
    const bool given = survey.normals_given == plan.points && plan.schema.normal_sides;
    return given || all_sensors || (no_sensors && plan.world.from_above);
}

std::vector<Scan> scansWithSensors(const SetPlan& plan) {
    std::vector<Scan> scans;
    for (const PlanScan& each : plan.scans) scans.push_back({each.name, each.sensor, 0});
    return scans;
}

/// Determines up, if neither the command line nor a file gives it, and sides, if nothing else decides them.
void orient(const SetRequest& request, const Survey& survey, bool is_mesh, SetPlan& plan) {
    plan.orient = request.bake.surface.orient;
    const bool up_is_given = plan.up_from == "option" || plan.up_from == "file";
    const bool sides_known = sidesAreKnown(plan, survey, plan.orient);
    if (up_is_given && sides_known) return;
    SurfaceOptions options = request.bake.surface;
    options.clean = 0;                 // noise is small compared with the spacing of the sample
    options.splat = SplatShape::kDisc; // balls have no sides
    SurfaceReport report;
    const Splats splats = estimateSplats(cloudOf(survey.sample.points(), plan), options, report, {});
    if (!up_is_given) {
        const FoundUp found = findUp(splats, scansWithSensors(plan), {plan.world.up, is_mesh});
        if (!found.up.isZero()) {
            plan.world.up = found.up;
            plan.up_from = nameOf(found.basis);
            plan.up_reason = found.reason;
        }
    }
    if (sides_known) return;
    plan.sides.normals = splats.normals;
    for (const Vec3f& position : splats.positions)
        plan.sides.positions.emplace_back(splats.origin + position.cast<double>());
}

/// Finds up from the opaque parts of the Gaussians; the convention of their formats is only a guess. Gaussians have no
/// sides.
void orientGaussians(const Survey& survey, SetPlan& plan) {
    plan.orient = OrientMode::kNone;
    if (plan.up_from == "option" || plan.up_from == "file") return;
    const FoundUp found =
        findUp(survey.gaussians.surface(plan.lattice_origin), scansWithSensors(plan), {plan.world.up, false});
    if (found.up.isZero()) return;
    plan.world.up = found.up;
    plan.up_from = nameOf(found.basis == UpBasis::kCustom ? UpBasis::kGuess : found.basis);
    plan.up_reason = found.reason;
}

void requireOneKind(const Survey& survey) {
    const std::uint64_t gaussians = survey.gaussians.gaussians();
    if (gaussians > 0 && gaussians < survey.kept)
        throw Error(ExitCode::kBadInput, "some inputs hold Gaussians and some points: bake them separately and show "
                                         "them together, or bake the Gaussians as discs with --splat disc");
}

void takeFindings(const SetRequest& request, StreamFindings& found, SetPlan& plan) {
    plan.points_read = found.cloud.points_read;
    plan.points_non_finite = found.cloud.points_non_finite;
    plan.points_filtered = found.cloud.points_filtered + found.cloud.points_unused + found.cloud.points_no_data +
                           found.cloud.points_withheld;
    plan.scans = scansOf(found);
    plan.world = found.cloud.world;
    plan.source_header = found.cloud.source_header;
    plan.notes = found.cloud.notes;
    if (!plan.world.up.isZero()) plan.up_from = plan.world.up_by_custom ? "format" : "file";
    if (request.up.isZero()) return;
    plan.world.up = request.up;
    plan.up_from = "option";
}

/// Exact bounds of the points without strays.
void takeBounds(const Survey& survey, SetPlan& plan) {
    const double root = edgeOf(plan, plan.levels - 1);
    const PlanBox lattice(plan.lattice_origin, plan.lattice_origin + Vec3d::Constant(root));
    plan.bounds = survey.bounds.intersection(lattice);
}

std::string joinedNames(const std::vector<std::string>& inputs) {
    return inputs.size() == 1 ? inputs.front() : fmt::format("{} and {} more", inputs.front(), inputs.size() - 1);
}

template <typename Work>
void named(const SetRequest& request, const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        throw Error(error.code, joinedNames(request.inputs) + ": " + error.what());
    }
}

/// Thinning stores each occupied cell, in up to a quarter of the memory.
void checkThinning(const SetRequest& request, std::uint64_t kept) {
    // bytes per cell of a table that is a quarter full, as it is just after growing
    constexpr std::uint64_t kBytesPerCell = 64;
    if (request.read.filter.thin_spacing > 0 && kept > request.bake.max_memory / 4 / kBytesPerCell)
        throw Error(ExitCode::kCannotRun, fmt::format("{}: --thin keeps more points than fit in --max-memory; "
                                                      "raise it, or use --every",
                                                      joinedNames(request.inputs)));
}

StreamFindings surveyInputs(const SetRequest& request, const StreamOptions& options, Survey& survey,
                            const ReadProgress& progress) {
    return readInBatches(
        request.inputs, options,
        [&](const PointBatch& batch) {
            const GridPriors priors = gridPriorsOf(batch, request.bake.surface, PriorKinds::kDepths);
            survey.noise |= !priors.noise.empty();
            survey.grids |= usesGrids(request.bake.surface) && !batch.cloud.grids.empty();
            survey.add(movedBatch(batch, priors));
            checkThinning(request, survey.kept += batch.positions.size());
        },
        progress);
}

/// Values that mark missing data are known only after a file has been read: if there are any, another pass leaves those
/// points out. Colours are scaled as in single files, by the largest value of all points.
StreamFindings surveyPointsWithData(const SetRequest& request, Survey& survey, const ReadProgress& progress) {
    StreamOptions options = streamOptionsOf(request);
    StreamFindings all = surveyInputs(request, options, survey, progress);
    if (all.no_data.empty()) return all;
    options.no_data = std::move(all.no_data);
    survey = Survey(request.bake.max_memory);
    StreamFindings found = surveyInputs(request, options, survey, progress);
    found.largest_color = std::move(all.largest_color);
    return found;
}

} // namespace

StreamOptions streamOptionsOf(const SetRequest& request) {
    StreamOptions options;
    options.read = request.read;
    constexpr std::uint64_t kBytesPerPoint = 1024; // a batch with its attributes, in three copies
    constexpr std::uint64_t kFewest = 1 << 14, kMost = 1 << 20;
    options.batch_points = std::clamp(request.bake.max_memory / 8 / kBytesPerPoint, kFewest, kMost);
    // Memory per cell of a grid: two copies of the point with its values, the cell, and the record.
    constexpr std::uint64_t kBytesPerCell = 128;
    options.most_in_grid = request.bake.max_memory / 4 / kBytesPerCell;
    options.largest_whole_file =
        request.bake.max_memory / 8; // a mesh's few bytes per corner become eight times as many
    return options;
}

SetPlan makePlan(const SetRequest& request, const ReadProgress& progress) {
    requirePossible(request);
    SetPlan plan;
    plan.output = request.output;
    plan.work = workFolderOf(request.output);
    plan.settings = request.settings;
    plan.bake = request.bake;
    plan.inputs = statesOf(request.inputs); // before reading them
    Survey survey(request.bake.max_memory);
    StreamFindings found = surveyPointsWithData(request, survey, progress);
    takeFindings(request, found, plan);
    plan.schema = schemaOf(found, survey, request.read.attributes);
    for (std::size_t i = 0; i < found.files.size(); ++i) {
        PlanInput& input = plan.inputs[i];
        const FileReport& file = found.files[i];
        input.format = file.format;
        input.points = file.points;
        input.kept = file.kept;
        input.scans = file.scans;
        input.seconds = file.seconds;
    }
    TileChoice choice;
    choice.points_per_tile = request.points_per_tile;
    choice.most_points = mostPointsAtOnce(request.bake.max_memory) / 2; // leaves as much for the halo
    choice.leaves_out_strays = request.bake.surface.remove_outliers && !holdsGaussians(plan);
    if (survey.kept > choice.most_points && choice.points_per_tile > choice.most_points)
        plan.notes.push_back(
            {"--tile-splats", fmt::format("{} points do not fit in a tile with this --max-memory; at most {} do",
                                          choice.points_per_tile, choice.most_points)});
    named(request, [&] {
        requireOneKind(survey);
        chooseTiles(survey.counts.cells(), survey.counts.edge(), choice, plan);
        takeBounds(survey, plan);
        if (holdsGaussians(plan))
            orientGaussians(survey, plan);
        else
            orient(request, survey, areMeshes(found.files), plan);
    });
    return plan;
}

} // namespace pointrt
