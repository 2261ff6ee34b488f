// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_points_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "format/base/error.h"
#include "format/pointio/las_crs.h"
#include "format/pointio/las_fields.h"
#include "format/pointio/las_source_header.h"
#include "format/pointio/laz.h"
#include "format/pointio/metadata.h"

namespace pointrt {
namespace {

/// Calls act and returns its result. Prefixes errors with the file's name.
template <typename Act>
auto named(const std::string& path, const Act& act) {
    try {
        return act();
    } catch (const Error& error) {
        throw Error(error.code, path + ": " + error.what());
    }
}

/// The metadata that a LAS writer uses.
std::string metadataOf(LasFile& file) {
    nlohmann::ordered_json metadata;
    metadata["source_header"] = parseMetadata(lasSourceHeader(file, false));
    if (const LasCrs crs = lasCrs(file); !crs.name.empty()) metadata["world"] = {{"crs", crs.name}};
    return dumpJson(metadata, false);
}

/// Bit fields have a known range without reading the points.
PointColumn columnOf(const LasField& field) {
    PointColumn column{field.name, field.type, field.components};
    if (field.mask != 0) column.range = {{0, static_cast<double>(field.mask)}};
    return column;
}

class LasPointsReader final : public PointReader {
public:
    LasPointsReader(std::string path, std::unique_ptr<format::MappedFile> mapped)
        : path_(std::move(path)), mapped_(std::move(mapped)) {
        named(path_, [&] {
            file_ = openLas({reinterpret_cast<const char*>(mapped_->bytes().data()), mapped_->bytes().size()});
            fields_ = lasFields(file_);
            if (file_.header.packed) layout_ = lazLayout(file_);
        });
        describe();
    }

    const PointOutline& outline() const override { return outline_; }

    bool next(PointBlock& block, std::size_t most) override {
        const LasHeader& header = file_.header;
        const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(most, header.point_count - done_));
        const char* const records = named(path_, [&] { return recordsOf(count); });
        block.positions.resize(3 * count);
        for (std::size_t i = 0; i < count; ++i)
            takePosition(records + i * header.record_bytes, &block.positions[3 * i]);
        block.columns.resize(fields_.size());
        for (std::size_t k = 0; k < fields_.size(); ++k) {
            block.columns[k].resize(count * fieldBytes(fields_[k]));
            unpackField(fields_[k], records, header.record_bytes, count,
                        reinterpret_cast<char*>(block.columns[k].data()));
        }
        done_ += count;
        mapped_->dropPages();
        return count > 0;
    }

private:
    void describe() {
        const LasHeader& header = file_.header;
        for (const LasField& field : fields_) outline_.columns.push_back(columnOf(field));
        outline_.count = header.point_count;
        // a writer keeps the source's scale and offset, so the bounds do not matter
        outline_.bounds_min = outline_.bounds_max = header.offset;
        outline_.position_step = std::abs(*std::min_element(
            header.scale.begin(), header.scale.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
        outline_.metres_per_unit = lasCrs(file_).metres_per_unit;
        outline_.metadata = metadataOf(file_);
    }

    void takePosition(const char* record, double* position) const {
        std::int32_t integer[3];
        std::memcpy(integer, record, sizeof integer);
        for (std::size_t axis = 0; axis < 3; ++axis)
            position[axis] = file_.header.scale[axis] * integer[axis] + file_.header.offset[axis];
    }

    /// Records of the next points.
    const char* recordsOf(std::size_t count) {
        const std::size_t bytes = file_.header.record_bytes;
        if (!file_.header.packed) return file_.bytes.data() + file_.header.point_offset + done_ * bytes;
        unpacked_.resize(count * bytes);
        for (std::size_t there = 0; there < count;) {
            if (left_in_chunk_ == 0) openChunk();
            const auto some = static_cast<std::size_t>(std::min<std::uint64_t>(count - there, left_in_chunk_));
            stream_->read(unpacked_.data() + there * bytes, some);
            there += some;
            left_in_chunk_ -= some;
        }
        return unpacked_.data();
    }

    void openChunk() {
        const LazChunk& chunk = layout_.chunks[chunk_++];
        stream_.emplace(layout_, file_.bytes, chunk);
        left_in_chunk_ = chunk.points;
    }

    std::string path_;
    std::unique_ptr<format::MappedFile> mapped_;
    LasFile file_;
    std::vector<LasField> fields_;
    LazLayout layout_;
    PointOutline outline_;
    std::optional<LazStream> stream_;
    std::size_t chunk_ = 0; ///< index of the next chunk
    std::uint64_t left_in_chunk_ = 0, done_ = 0;
    std::vector<char> unpacked_;
};

} // namespace

std::unique_ptr<PointReader> readLasPoints(const std::string& path, std::unique_ptr<format::MappedFile> file) {
    return std::make_unique<LasPointsReader>(path, std::move(file));
}

} // namespace pointrt
