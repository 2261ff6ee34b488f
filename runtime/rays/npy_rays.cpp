// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/npy_rays.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/rays/npy_header.h"

namespace pointrt {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read without conversion");

std::string shapeText(const std::vector<std::uint64_t>& shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i) text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

/// Why the array does not hold rays; empty if it does.
std::string refusalOf(const NpyHeader& header, const RowKind& kind) {
    const std::string& type = header.fields.front().type;
    if (!header.isPlain() || (type != "<f4" && type != "<f8"))
        return "the type is " + (header.isPlain() ? "'" + printable(type) + "'" : "structured") + ", but " + kind.rows +
               " are float32 ('<f4') or float64 ('<f8')";
    if (header.shape.size() != 2 ||
        std::find(kind.widths.begin(), kind.widths.end(), header.shape[1]) == kind.widths.end())
        return "the shape is " + shapeText(header.shape) + ", but " + kind.rows + " are " + kind.shape;
    if (header.fortran_order) return "the array is in Fortran order; save numpy.ascontiguousarray(array)";
    return {};
}

class NpyRays final : public RaySource {
public:
    NpyRays(std::unique_ptr<ByteInput> input, const RowKind& kind)
        : input_(std::move(input)), kind_(kind), header_(readNpyHeader(*input_)) {
        const std::string refusal = refusalOf(header_, kind_);
        if (!refusal.empty()) throw Error(ExitCode::kBadInput, input_->name() + ": " + refusal);
    }

    bool next(RayBlock& block) override {
        const auto rays = static_cast<std::size_t>(std::min<std::uint64_t>(RayBlock::kRays, header_.shape[0] - done_));
        block.first = done_;
        if (header_.fields.front().type == "<f4")
            read(block.floats, rays);
        else
            read(block.doubles, rays);
        done_ += rays;
        if (rays == 0) requireEnd();
        return rays > 0;
    }

    std::size_t width() const override { return header_.shape[1]; }
    std::optional<std::uint64_t> count() const override { return header_.shape[0]; }

    std::string placeOf(const RayBlock& block, std::size_t ray) const override {
        return input_->name() + ": " + kind_.row + " " + std::to_string(block.first + ray);
    }

private:
    template <typename Number>
    void read(std::vector<Number>& numbers, std::size_t rays) {
        numbers.resize(width() * rays);
        const std::size_t bytes = numbers.size() * sizeof(Number), got = input_->read(numbers.data(), bytes);
        if (got < bytes)
            throw Error(ExitCode::kBadInput, input_->name() + ": truncated in " + kind_.row + " " +
                                                 std::to_string(done_ + got / (width() * sizeof(Number))) + " of " +
                                                 std::to_string(header_.shape[0]));
    }

    void requireEnd() {
        std::uint8_t more = 0;
        if (input_->read(&more, 1) > 0)
            throw Error(ExitCode::kBadInput,
                        input_->name() + ": more data after " + std::to_string(header_.shape[0]) + " " + kind_.rows);
    }

    std::unique_ptr<ByteInput> input_;
    const RowKind& kind_;
    NpyHeader header_;
    std::uint64_t done_ = 0;
};

} // namespace

std::unique_ptr<RaySource> npyRays(std::unique_ptr<ByteInput> input, const RowKind& kind) {
    return std::make_unique<NpyRays>(std::move(input), kind);
}

} // namespace pointrt
