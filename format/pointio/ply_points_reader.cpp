// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/ply_points_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "format/base/error.h"
#include "format/base/number_type.h"
#include "format/pointio/ply_body.h"

namespace pointrt {
namespace {

/// Properties that form a column, if all exist with a suitable type.
struct Group {
    std::vector<std::string> names;
    PointColumn column;
    bool bytes_only; ///< else any type
};

const std::vector<Group>& groups() {
    static const std::vector<Group> all{
        {{"nx", "ny", "nz"}, {"normals", PRO_TYPE_F32, 3, PointRole::kNormal}, false},
        {{"radius"}, {"radius", PRO_TYPE_F32, 1, PointRole::kRadius}, false},
        {{"red", "green", "blue"}, {"colors", PRO_TYPE_U8, 3, PointRole::kColor}, true}};
    return all;
}

/// The destination of a property.
struct Place {
    static constexpr std::size_t kPosition = static_cast<std::size_t>(-1);
    std::size_t column = kPosition, component = 0;
};

void storeNumber(double value, std::uint32_t type, std::byte* to) {
    withType(type, [&](auto number) {
        number = static_cast<decltype(number)>(value);
        std::memcpy(to, &number, sizeof number);
    });
}

class PlyPointsReader final : public PointReader {
public:
    PlyPointsReader(std::string path, std::unique_ptr<format::MappedFile> mapped)
        : path_(std::move(path)), mapped_(std::move(mapped)),
          file_(reinterpret_cast<const char*>(mapped_->bytes().data()), mapped_->bytes().size()),
          header_(format::readPlyHeader(path_, file_)), body_(path_, file_, header_),
          numbers_(header_.properties.size()) {
        outline_.count = header_.vertices;
        placeProperties();
        findBounds();
    }

    const PointOutline& outline() const override { return outline_; }

    bool next(PointBlock& block, std::size_t most) override {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, header_.vertices - done_));
        block.positions.resize(3 * count);
        block.columns.resize(outline_.columns.size());
        for (std::size_t k = 0; k < block.columns.size(); ++k)
            block.columns[k].resize(count * outline_.columns[k].rowBytes());
        for (std::size_t i = 0; i < count; ++i) takeVertex(i, block);
        mapped_->dropPages();
        return count > 0;
    }

private:
    std::size_t numberOf(const std::string& name) const {
        const auto found = std::find_if(header_.properties.begin(), header_.properties.end(),
                                        [&](const format::PlyProperty& each) { return each.name == name; });
        return static_cast<std::size_t>(found - header_.properties.begin());
    }

    bool isThere(const Group& group) const {
        return std::all_of(group.names.begin(), group.names.end(), [&](const std::string& name) {
            const std::size_t number = numberOf(name);
            return number < header_.properties.size() &&
                   (!group.bytes_only || header_.properties[number].type == PRO_TYPE_U8);
        });
    }

    void placeProperties() {
        places_.resize(header_.properties.size());
        std::vector<bool> taken(places_.size());
        const auto place = [&](const std::string& name, Place where) {
            places_[numberOf(name)] = where;
            taken[numberOf(name)] = true;
        };
        const std::vector<std::string> axes{"x", "y", "z"};
        for (std::size_t axis = 0; axis < 3; ++axis) place(axes[axis], {Place::kPosition, axis});
        for (const Group& group : groups()) {
            if (!isThere(group)) continue;
            for (std::size_t c = 0; c < group.names.size(); ++c) place(group.names[c], {outline_.columns.size(), c});
            outline_.columns.push_back(group.column);
        }
        for (std::size_t k = 0; k < places_.size(); ++k) {
            if (taken[k]) continue;
            places_[k] = {outline_.columns.size(), 0};
            outline_.columns.push_back({header_.properties[k].name, header_.properties[k].type});
        }
    }

    void takeVertex(std::size_t row, PointBlock& block) {
        body_.next(numbers_);
        ++done_;
        for (std::size_t k = 0; k < numbers_.size(); ++k) {
            const Place place = places_[k];
            if (place.column == Place::kPosition) {
                block.positions[3 * row + place.component] = numbers_[k];
                continue;
            }
            const PointColumn& column = outline_.columns[place.column];
            storeNumber(numbers_[k], column.type,
                        block.columns[place.column].data() + row * column.rowBytes() +
                            place.component * pro_type_bytes(column.type));
        }
    }

    /// Bounds of all finite positions.
    void findBounds() {
        constexpr std::size_t kAtOnce = 65536;
        bool is_first = true;
        for (PointBlock block; next(block, kAtOnce);)
            for (std::size_t i = 0; i < block.positions.size(); i += 3) {
                const double* const at = &block.positions[i];
                if (!std::isfinite(at[0] + at[1] + at[2])) continue;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    double& low = outline_.bounds_min[axis];
                    double& high = outline_.bounds_max[axis];
                    low = is_first ? at[axis] : std::min(low, at[axis]);
                    high = is_first ? at[axis] : std::max(high, at[axis]);
                }
                is_first = false;
            }
        done_ = 0;
        body_ = format::PlyBody(path_, file_, header_);
    }

    std::string path_;
    std::unique_ptr<format::MappedFile> mapped_;
    std::string_view file_;
    format::PlyHeader header_;
    format::PlyBody body_;
    std::vector<double> numbers_; ///< of a vertex
    std::vector<Place> places_;   ///< of the properties
    PointOutline outline_;
    std::uint64_t done_ = 0;
};

} // namespace

std::unique_ptr<PointReader> readPlyPoints(const std::string& path, std::unique_ptr<format::MappedFile> file) {
    return std::make_unique<PlyPointsReader>(path, std::move(file));
}

} // namespace pointrt
