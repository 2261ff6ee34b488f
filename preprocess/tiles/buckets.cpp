// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/buckets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>

#include "format/base/error.h"
#include "format/os/mapped_file.h"
#include "preprocess/tiles/bucket_layout.h"
#include "preprocess/tiles/checksum.h"

namespace pointrt {
namespace {

struct Bucket {
    std::unique_ptr<format::MappedFile> file;
    const char* records = nullptr;
    std::uint64_t count = 0;
    Vec3d corner; ///< of the tile's core
};

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
    throw Error(ExitCode::kBadInput, path + ": " + reason);
}

void verify(const std::string& path, const Bucket& bucket, const BucketTrailer& trailer) {
    if (XXH3_64bits(bucket.records, bucket.count * trailer.record_bytes) != trailer.xxh3)
        refuse(path, "is damaged: its checksum does not match");
}

/// @param whole whether to verify the checksum of all records
Bucket openBucket(const SetPlan& plan, const PlanTile& tile, const BucketLayout& layout, bool whole) {
    const std::string path = bucketFile(plan, tile);
    Bucket bucket{std::make_unique<format::MappedFile>(), nullptr, 0, coreOf(plan, tile).min()};
    if (!bucket.file->map(path.c_str())) refuse(path, bucket.file->error());
    const std::span<const std::byte> bytes = bucket.file->bytes();
    BucketTrailer trailer;
    if (bytes.size() < sizeof trailer) refuse(path, "is truncated");
    const std::size_t body = bytes.size() - sizeof trailer;
    std::memcpy(&trailer, bytes.data() + body, sizeof trailer);
    const bool is_trailer = trailer.magic == BucketTrailer::kMagic && trailer.record_bytes == layout.record_bytes;
    if (!is_trailer || trailer.records != tile.points || body != tile.points * layout.record_bytes)
        refuse(path, fmt::format("does not match the plan, which has {} points for it", tile.points));
    bucket.records = reinterpret_cast<const char*>(bytes.data());
    bucket.count = trailer.records;
    if (whole) verify(path, bucket, trailer);
    return bucket;
}

Vec3d positionAt(const char* record, const Bucket& bucket) {
    Vec3f local;
    std::memcpy(local.data(), record, sizeof local);
    return bucket.corner + local.cast<double>();
}

/// A selected record.
struct Pick {
    const char* record;
    std::uint32_t bucket; ///< index of the bucket
    std::uint32_t scan;
};

std::uint32_t scanAt(const char* record, const BucketLayout& layout, std::size_t scan_bytes) {
    std::uint32_t scan = 0; // little-endian, as everything in the file
    std::memcpy(&scan, record + layout.scan, scan_bytes);
    return scan;
}

/// Selects the records of a box and converts them to a cloud.
struct Picking {
    const SetPlan& plan;
    const BucketLayout layout;
    Vec3d origin;
    std::vector<Bucket> buckets;
    std::vector<Pick> picks;

    Picking(const SetPlan& of_plan, const Vec3d& at) : plan(of_plan), layout(of_plan.schema), origin(at) {}

    void add(const PlanTile& tile, const PlanBox* box) {
        const Bucket& bucket = buckets.emplace_back(openBucket(plan, tile, layout, box == nullptr));
        const auto number = static_cast<std::uint32_t>(buckets.size() - 1);
        const std::size_t scan_bytes = plan.schema.scan_bytes;
        for (std::uint64_t i = 0; i < bucket.count; ++i) {
            const char* const record = bucket.records + i * layout.record_bytes;
            if (!box || box->contains(positionAt(record, bucket)))
                picks.push_back({record, number, scanAt(record, layout, scan_bytes)});
        }
    }

    /// Sorts by scan, since scans are consecutive ranges of points.
    void sort() {
        const auto by_scan = [](const Pick& a, const Pick& b) { return a.scan < b.scan; };
        if (!std::is_sorted(picks.begin(), picks.end(), by_scan)) std::stable_sort(picks.begin(), picks.end(), by_scan);
    }

    void takePositions(Cloud& cloud) const {
        cloud.origin = origin;
        cloud.positions.resize(picks.size());
        for (std::size_t i = 0; i < picks.size(); ++i) {
            const Bucket& bucket = buckets[picks[i].bucket];
            std::memcpy(cloud.positions[i].data(), picks[i].record, sizeof(Vec3f));
            if (bucket.corner == origin) continue; // the core's own positions keep every bit
            cloud.positions[i] = (positionAt(picks[i].record, bucket) - origin).cast<float>();
        }
    }

    template <typename Value>
    void take(std::size_t at, std::vector<Value>& values) const {
        values.resize(picks.size());
        for (std::size_t i = 0; i < picks.size(); ++i)
            std::memcpy(static_cast<void*>(&values[i]), picks[i].record + at, sizeof(Value));
    }

    void takeAttributes(Cloud& cloud) const {
        for (std::size_t k = 0; k < layout.attributes.size(); ++k) {
            const PlanAttribute& kind = plan.schema.attributes[k];
            Attribute& attribute = cloud.attributes.emplace_back(Attribute{kind.name, kind.type, kind.components, {}});
            const std::size_t size = attribute.bytesEach();
            attribute.values.resize(picks.size() * size);
            for (std::size_t i = 0; i < picks.size(); ++i)
                std::memcpy(attribute.values.data() + i * size, picks[i].record + layout.attributes[k], size);
        }
        if (!plan.schema.scan_attribute) return;
        const PlanAttribute& kind = plan.schema.attributes.back();
        Attribute& numbers = cloud.attributes.emplace_back(Attribute{kind.name, kind.type, 1, {}});
        const std::size_t size = numbers.bytesEach();
        numbers.values.resize(picks.size() * size);
        for (std::size_t i = 0; i < picks.size(); ++i)
            std::memcpy(numbers.values.data() + i * size, &picks[i].scan, size);
    }

    void takeScans(Cloud& cloud) const {
        std::vector<std::uint32_t> sensor_of_scan(plan.scans.size(), kNoSensor);
        std::size_t first = 0;
        for (std::uint32_t scan = 0; scan < plan.scans.size(); ++scan) {
            const PlanScan& each = plan.scans[scan];
            while (first < picks.size() && picks[first].scan < scan) ++first;
            cloud.scans.push_back({each.name, each.sensor, first});
            if (!each.sensor) continue;
            sensor_of_scan[scan] = static_cast<std::uint32_t>(cloud.sensors.size());
            cloud.sensors.push_back((*each.sensor - origin).cast<float>());
        }
        if (cloud.sensors.empty()) return;
        for (const Pick& pick : picks) {
            if (pick.scan >= plan.scans.size()) refuse(plan.work, "a bucket has a scan that is missing from the plan");
            cloud.sensor_of_point.push_back(sensor_of_scan[pick.scan]);
        }
    }

    Cloud cloud() {
        sort();
        Cloud cloud;
        const PlanSchema& schema = plan.schema;
        takePositions(cloud);
        if (schema.normals) take(layout.normal, cloud.normals);
        cloud.normal_sides = schema.normal_sides;
        if (schema.colors) take(layout.color, cloud.colors);
        if (schema.radii) take(layout.radius, cloud.radii);
        if (schema.noise) take(layout.noise, cloud.noise);
        takeAttributes(cloud);
        takeScans(cloud);
        cloud.world = plan.world;
        cloud.source_header = plan.source_header;
        cloud.points_read = cloud.positions.size();
        return cloud;
    }
};

void addSides(const SetPlan& plan, const PlanBox& box, BoxPoints& points) {
    for (std::size_t i = 0; i < plan.sides.positions.size(); ++i) {
        if (!box.contains(plan.sides.positions[i])) continue;
        points.side_positions.push_back((plan.sides.positions[i] - points.cloud.origin).cast<float>());
        points.side_normals.push_back(plan.sides.normals[i]);
    }
}

constexpr std::uint32_t kNoTile = std::numeric_limits<std::uint32_t>::max();

/// @param tile whose points are all flagged as core
BoxPoints readBox(const SetPlan& plan, std::uint32_t tile, const PlanBox& box, const Vec3d& origin) {
    Picking picking(plan, origin);
    std::uint32_t core_bucket = kNoTile;
    for (const std::uint32_t each : tilesIn(plan, box)) {
        if (each == tile) core_bucket = static_cast<std::uint32_t>(picking.buckets.size());
        picking.add(plan.tiles[each], each == tile ? nullptr : &box);
    }
    BoxPoints points;
    points.cloud = picking.cloud();
    for (const Pick& pick : picking.picks) points.core.push_back(pick.bucket == core_bucket);
    if (plan.schema.silhouettes) picking.take(picking.layout.silhouette, points.silhouettes);
    addSides(plan, box, points);
    return points;
}

} // namespace

Cloud readBucket(const SetPlan& plan, std::uint32_t tile) {
    Picking picking(plan, coreOf(plan, plan.tiles[tile]).min());
    picking.add(plan.tiles[tile], nullptr);
    return picking.cloud();
}

PlanBox boxAround(const SetPlan& plan, const PlanTile& tile, double halo) {
    const PlanBox core = coreOf(plan, tile);
    const Vec3d room = Vec3d::Constant(halo);
    return PlanBox(core.min() - room, core.max() + room);
}

std::uint64_t countPoints(const SetPlan& plan, std::uint32_t tile, double halo, std::uint64_t most) {
    const BucketLayout layout(plan.schema);
    const PlanBox box = boxAround(plan, plan.tiles[tile], halo);
    std::uint64_t count = 0;
    for (const std::uint32_t each : tilesIn(plan, box)) {
        if (count > most) break;
        if (box.contains(coreOf(plan, plan.tiles[each]))) {
            count += plan.tiles[each].points;
            continue;
        }
        const Bucket bucket = openBucket(plan, plan.tiles[each], layout, false);
        for (std::uint64_t i = 0; i < bucket.count; ++i)
            count += box.contains(positionAt(bucket.records + i * layout.record_bytes, bucket));
    }
    return count;
}

BoxPoints readPoints(const SetPlan& plan, std::uint32_t tile, double halo) {
    const PlanTile& of = plan.tiles[tile];
    return readBox(plan, tile, boxAround(plan, of, halo), coreOf(plan, of).min());
}

BoxPoints readPoints(const SetPlan& plan, const PlanBox& box) { return readBox(plan, kNoTile, box, box.min()); }

} // namespace pointrt
