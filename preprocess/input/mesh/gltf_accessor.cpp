// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointrt {
namespace {

/// The numbers of OpenGL.
Scalar typeOf(const JsonValue& component_type) {
    switch (component_type.integer()) {
    case 5120:
        return Scalar::kI8;
    case 5121:
        return Scalar::kU8;
    case 5122:
        return Scalar::kI16;
    case 5123:
        return Scalar::kU16;
    case 5125:
        return Scalar::kU32;
    case 5126:
        return Scalar::kF32;
    default:
        component_type.refuse(fmt::format("is {}, which is not a component type", component_type.integer()));
    }
}

int componentsOf(const JsonValue& type) {
    constexpr const char* kNames[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    for (int i = 0; i < 4; ++i)
        if (type.text() == kNames[i]) return i + 1;
    type.refuse(fmt::format("is {}, but must be a scalar or a vector", inQuotes(type.text())));
}

/// The divisor of a normalised integer.
double wholeOf(Scalar type) {
    const bool is_signed = type == Scalar::kI8 || type == Scalar::kI16;
    const double bits = 8 * static_cast<double>(scalarSize(type)) - (is_signed ? 1 : 0);
    return std::exp2(bits) - 1;
}

} // namespace

GltfAccessor::GltfAccessor(const GltfFile& file, const JsonValue& index, int components, int or_components) {
    const JsonValue accessor = file.item("accessors", index);
    if (accessor.has("sparse")) accessor.refuse("is sparse, which this build does not read");
    if (!accessor.has("bufferView"))
        accessor.refuse("has no bufferView: its data is missing, or compressed by an extension");
    const GltfView view = file.view(accessor.member("bufferView"));
    bytes_ = view.bytes;
    count_ = accessor.member("count").integer(std::numeric_limits<std::uint32_t>::max());
    type_ = typeOf(accessor.member("componentType"));
    components_ = componentsOf(accessor.member("type"));
    if (components_ != components && components_ != or_components)
        accessor.refuse(fmt::format("has {} components, but {} are needed", components_, components));
    normalized_ = accessor.has("normalized") && accessor.member("normalized").boolean();
    const std::uint64_t element = scalarSize(type_) * static_cast<std::uint64_t>(components_);
    stride_ = view.stride == 0 ? element : view.stride;
    const auto offset = accessor.optionalMember("byteOffset");
    checkExtent(accessor, offset ? offset->integer() : 0);
    if (count_ > 0) bytes_.remove_prefix(offset ? offset->integer() : 0);
}

/// The last element must lie in the view.
void GltfAccessor::checkExtent(const JsonValue& accessor, std::uint64_t offset) const {
    const std::uint64_t element = scalarSize(type_) * static_cast<std::uint64_t>(components_);
    if (stride_ < element) accessor.refuse(fmt::format("has elements of {} bytes every {} bytes", element, stride_));
    if (count_ == 0) return;
    const std::uint64_t needed = (count_ - 1) * stride_ + element; // below 2^48
    if (offset > bytes_.size() || needed > bytes_.size() - offset)
        accessor.refuse(
            fmt::format("has {} elements, which its bufferView of {} bytes cannot hold", count_, bytes_.size()));
}

double GltfAccessor::value(std::uint64_t element, int component) const {
    const std::uint64_t at = element * stride_ + static_cast<std::uint64_t>(component) * scalarSize(type_);
    const double value = loadScalar(bytes_.data() + at, type_, false);
    if (!normalized_ || type_ == Scalar::kF32) return value;
    return std::max(value / wholeOf(type_), -1.0);
}

} // namespace pointrt
