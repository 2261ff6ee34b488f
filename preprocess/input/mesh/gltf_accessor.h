// SPDX-License-Identifier: GPL-3.0-or-later
// Accessors of glTF files: typed elements in a buffer view.
#pragma once

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/input/mesh/gltf_file.h"

namespace pointrt {

class GltfAccessor {
public:
    /// The accessor that a value names by its index; valid as long as the file. Throws Error if it is sparse, has no
    /// data, has neither of the two wanted numbers of components, or reaches beyond its buffer view.
    GltfAccessor(const GltfFile& file, const JsonValue& index, int components, int or_components = 0);

    std::uint64_t count() const { return count_; }
    int components() const { return components_; }
    bool isReal() const { return type_ == Scalar::kF32; }

    /// A component, with normalised integers converted to fractions of their range. element: below count()
    double value(std::uint64_t element, int component) const;
    Vec3d three(std::uint64_t element) const { return {value(element, 0), value(element, 1), value(element, 2)}; }

private:
    void checkExtent(const JsonValue& accessor, std::uint64_t offset) const;

    std::string_view bytes_;
    std::uint64_t count_ = 0, stride_ = 0;
    int components_ = 1;
    Scalar type_ = Scalar::kF32;
    bool normalized_ = false;
};

} // namespace pointrt
