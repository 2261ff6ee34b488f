// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/bucket_writer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "format/base/error.h"
#include "format/os/descriptor.h"
#include "preprocess/ingest/columns.h"
#include "preprocess/tiles/checksum.h"

namespace pointrt {

struct BucketWriter::Bucket {
    std::vector<char> buffer;
    std::uint64_t written = 0; ///< bytes in the file
    XXH3_state_t* hash = XXH3_createState();

    Bucket() { XXH3_64bits_reset(hash); }
    ~Bucket() { XXH3_freeState(hash); }
    Bucket(const Bucket&) = delete;
    Bucket& operator=(const Bucket&) = delete;
};

namespace {

[[noreturn]] void cannotWrite(const std::string& path, int error) {
    throw Error(ExitCode::kCannotWrite, path + ": " + std::strerror(error));
}

/// An open file, closed on destruction.
class File {
public:
    File(std::string path, Opening opening) : path_(std::move(path)), descriptor_(openFile(path_, opening)) {
        if (!descriptor_.isOpen()) cannotWrite(path_, errno);
    }

    void write(const char* data, std::size_t bytes) const {
        while (bytes > 0) {
            const std::ptrdiff_t done = writeSome(descriptor_.number(), data, bytes);
            if (done < 0) cannotWrite(path_, errno);
            data += done;
            bytes -= static_cast<std::size_t>(done);
        }
    }

    /// Returns false if there are fewer bytes.
    bool read(char* data, std::size_t bytes) const {
        while (bytes > 0) {
            const std::ptrdiff_t done = readSome(descriptor_.number(), data, bytes);
            if (done <= 0) return false;
            data += done;
            bytes -= static_cast<std::size_t>(done);
        }
        return true;
    }

private:
    std::string path_;
    Descriptor descriptor_;
};

/// Hashes the first bytes of a file.
bool hashFile(const std::string& path, std::uint64_t bytes, XXH3_state_t* hash) {
    const File file(path, Opening::kRead);
    std::vector<char> piece(std::size_t{1} << 20);
    while (bytes > 0) {
        const std::size_t now = std::min<std::uint64_t>(bytes, piece.size());
        if (!file.read(piece.data(), now)) return false;
        XXH3_64bits_update(hash, piece.data(), now);
        bytes -= now;
    }
    return true;
}

/// Largest float below a core's edge: clamps positions that rounding would move into the next core.
float belowEdge(double edge) { return std::nextafter(static_cast<float>(edge), 0.0f); }

} // namespace

BucketWriter::BucketWriter(const SetPlan& plan, std::uint64_t most_buffered)
    : plan_(plan), layout_(plan.schema), finder_(plan), most_buffered_(most_buffered) {
    for (const PlanTile& tile : plan.tiles) {
        buckets_.push_back(std::make_unique<Bucket>());
        corners_.push_back(coreOf(plan, tile).min());
    }
    makeFolder(bucketsFolder(plan));
}

BucketWriter::~BucketWriter() = default;

std::string BucketWriter::partOf(std::size_t tile) const { return bucketFile(plan_, plan_.tiles[tile]) + ".part"; }

void BucketWriter::findTiles(const std::vector<Vec3d>& positions) {
    tile_of_point_.resize(positions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) tile_of_point_[i] = finder_.find(positions[i]);
    });
}

/// A stable counting sort of points by tile; also reserves space for their records.
void BucketWriter::sortByTile() {
    std::vector<std::uint32_t> counts(buckets_.size() + 1);
    for (const std::uint32_t tile : tile_of_point_)
        if (tile != TileFinder::kNone) ++counts[tile + 1];
    std::vector<char*> next(buckets_.size());
    for (std::size_t tile = 0; tile < buckets_.size(); ++tile) {
        if (counts[tile + 1] > 0) {
            std::vector<char>& buffer = buckets_[tile]->buffer;
            const std::size_t before = buffer.size(), capacity = buffer.capacity();
            buffer.resize(before + counts[tile + 1] * layout_.record_bytes);
            buffered_ += buffer.capacity() - capacity;
            next[tile] = buffer.data() + before;
        }
        counts[tile + 1] += counts[tile];
    }
    order_.resize(counts.back());
    place_.resize(counts.back());
    for (std::uint32_t i = 0; i < tile_of_point_.size(); ++i) {
        const std::uint32_t tile = tile_of_point_[i];
        if (tile == TileFinder::kNone) continue;
        order_[counts[tile]] = i;
        place_[counts[tile]++] = next[tile];
        next[tile] += layout_.record_bytes;
    }
}

void BucketWriter::writeRecord(const PointBatch& batch, const GridPriors& priors,
                               const std::vector<const char*>& attributes, std::size_t point, char* to) const {
    const Cloud& cloud = batch.cloud;
    const PlanSchema& schema = plan_.schema;
    const std::uint32_t tile = tile_of_point_[point];
    const float most = belowEdge(edgeOf(plan_, plan_.tiles[tile].level));
    const Vec3f local = (batch.positions[point] - corners_[tile]).cast<float>().cwiseMin(most).cwiseMax(0.0f);
    std::memcpy(to, local.data(), sizeof local);
    if (schema.normals) {
        const Vec3f normal = cloud.normals.empty() ? Vec3f(Vec3f::Zero()) : cloud.normals[point];
        std::memcpy(to + layout_.normal, normal.data(), sizeof normal);
    }
    if (schema.colors) {
        const Rgb8 color = cloud.colors.empty() ? kGreyColor : cloud.colors[point];
        std::memcpy(to + layout_.color, color.data(), sizeof color);
    }
    if (schema.radii) {
        const float radius = cloud.radii.empty() ? 0.0f : cloud.radii[point];
        std::memcpy(to + layout_.radius, &radius, sizeof radius);
    }
    if (schema.noise) {
        const float noise = priors.noise.empty() ? 0.0f : priors.noise[point];
        std::memcpy(to + layout_.noise, &noise, sizeof noise);
    }
    if (schema.silhouettes)
        to[layout_.silhouette] = static_cast<char>(priors.silhouettes.empty() ? 0 : priors.silhouettes[point]);
    const auto scan = static_cast<std::uint32_t>(batch.scan); // little-endian, as everything in the file
    std::memcpy(to + layout_.scan, &scan, schema.scan_bytes);
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const std::size_t size = schema.attributes[i].bytesEach();
        if (attributes[i])
            std::memcpy(to + layout_.attributes[i], attributes[i] + point * size, size);
        else
            std::memset(to + layout_.attributes[i], 0, size);
    }
}

void BucketWriter::add(const PointBatch& batch, const GridPriors& priors) {
    findTiles(batch.positions);
    sortByTile();
    std::vector<Attribute> converted; // attributes read as another type
    converted.reserve(layout_.attributes.size());
    std::vector<const char*> attributes;
    for (std::size_t i = 0; i < layout_.attributes.size(); ++i) {
        const Attribute* attribute = &batch.cloud.attributes[i];
        const Scalar type = plan_.schema.attributes[i].type;
        if (attribute->type != type && !attribute->values.empty()) {
            converted.push_back(*attribute);
            changeType(converted.back(), type);
            attribute = &converted.back();
        }
        attributes.push_back(attribute->values.empty() ? nullptr : attribute->values.data());
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order_.size(), 4096), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k)
            writeRecord(batch, priors, attributes, order_[k], place_[k]);
    });
    if (buffered_ > most_buffered_) flushLargest();
}

/// Appends a tile's buffered records to its file.
void BucketWriter::append(std::size_t tile) {
    Bucket& bucket = *buckets_[tile];
    if (bucket.buffer.empty()) return;
    File(partOf(tile), Opening::kAppend).write(bucket.buffer.data(), bucket.buffer.size());
    XXH3_64bits_update(bucket.hash, bucket.buffer.data(), bucket.buffer.size());
    bucket.written += bucket.buffer.size();
    buffered_ -= bucket.buffer.capacity();
    std::vector<char>().swap(bucket.buffer);
}

/// Flushes the largest buffers, half of the buffered bytes or more, so that few calls write much.
void BucketWriter::flushLargest() {
    const std::uint64_t share = most_buffered_ / (2 * buckets_.size());
    for (std::size_t tile = 0; tile < buckets_.size(); ++tile)
        if (buckets_[tile]->buffer.capacity() > share) append(tile);
}

std::vector<std::uint64_t> BucketWriter::flush() {
    std::vector<std::uint64_t> bytes;
    for (std::size_t tile = 0; tile < buckets_.size(); ++tile) {
        append(tile);
        bytes.push_back(buckets_[tile]->written);
    }
    return bytes;
}

std::vector<std::uint64_t> BucketWriter::counts() const {
    std::vector<std::uint64_t> counts;
    for (const auto& bucket : buckets_)
        counts.push_back((bucket->written + bucket->buffer.size()) / layout_.record_bytes);
    return counts;
}

bool BucketWriter::resume(const std::vector<std::uint64_t>& bytes) {
    if (bytes.size() != buckets_.size()) return false;
    for (std::size_t tile = 0; tile < buckets_.size(); ++tile) {
        const std::string part = partOf(tile), whole = bucketFile(plan_, plan_.tiles[tile]);
        std::error_code failure;
        const bool is_whole = std::filesystem::exists(whole, failure); // the run was killed just after renaming it
        if (is_whole) std::filesystem::rename(whole, part, failure);
        const std::uint64_t there = std::filesystem::file_size(part, failure);
        if (bytes[tile] == 0) {
            std::filesystem::remove(part, failure);
            continue;
        }
        if (failure || there < bytes[tile]) return false;
        std::filesystem::resize_file(part, bytes[tile], failure);
        if (failure || !hashFile(part, bytes[tile], buckets_[tile]->hash)) return false;
        buckets_[tile]->written = bytes[tile];
    }
    return true;
}

void BucketWriter::restart() {
    removeTree(bucketsFolder(plan_));
    makeFolder(bucketsFolder(plan_));
    for (const auto& bucket : buckets_) {
        bucket->written = 0;
        XXH3_64bits_reset(bucket->hash);
    }
}

void BucketWriter::finish() {
    for (std::size_t tile = 0; tile < buckets_.size(); ++tile) {
        append(tile);
        const Bucket& bucket = *buckets_[tile];
        BucketTrailer trailer;
        trailer.record_bytes = layout_.record_bytes;
        trailer.records = bucket.written / layout_.record_bytes;
        trailer.xxh3 = XXH3_64bits_digest(bucket.hash);
        const std::string part = partOf(tile), whole = bucketFile(plan_, plan_.tiles[tile]);
        File(part, Opening::kAppend).write(reinterpret_cast<const char*>(&trailer), sizeof trailer);
        std::error_code failure;
        std::filesystem::rename(part, whole, failure);
        if (failure) cannotWrite(whole, failure.value());
    }
}

} // namespace pointrt
