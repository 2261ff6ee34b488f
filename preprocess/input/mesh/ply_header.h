// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a PLY file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/ingest/columns.h"
#include "preprocess/ingest/dimensions.h"
#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/scalar.h"

namespace pointrt {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
    std::string name;
    Scalar type = Scalar::kF32;
    bool is_list = false;
    Scalar count_type = Scalar::kU8;  ///< of a list
    Dimension dimension = kIgnored;   ///< of a scalar of the vertex element
    std::optional<std::size_t> place; ///< of a scalar of the vertex element: offset in its packed values
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0, promised = 0; ///< differ only in files that are salvaged
    std::vector<PlyProperty> properties;
};

/// Whether the vertices are Gaussians: plain, with one property per parameter, or packed into four by SuperSplat.
enum class PlyGaussians { kNone, kPlain, kPacked };

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::kAscii;
    std::vector<PlyElement> elements;
    const char* body = nullptr;   ///< the first byte after the header
    bool harmonic_colors = false; ///< the colours are Gaussian-splat f_dc coefficients
    PlyGaussians gaussians = PlyGaussians::kNone;
    std::vector<ColumnTraits> columns;             ///< of a vertex's packed values
    std::size_t packed_size = 0;                   ///< size of the packed values in bytes
    std::vector<std::string> textures;             ///< "comment TextureFile NAME"
    std::uint64_t grid_rows = 0, grid_columns = 0; ///< of a range_grid, from obj_info lines
};

/// Reads the header and assigns dimensions to the vertex properties. Skips lines with unknown keywords, which scans of
/// the Stanford repository have. Throws Error if there is no vertex element with x, y and z or packed Gaussians, or if
/// the promised elements cannot fit in the bytes that follow.
/// @param salvages accept promises that do not fit: elements then have the count that the bytes allow for, and
/// PlyElement::promised
PlyHeader readPlyHeader(const InputFile& input, bool salvages = false);

/// Whether an element has a property of this name.
bool hasProperty(const PlyElement& element, std::string_view name);

/// The vertex element.
const PlyElement& vertexElement(const PlyHeader& header);

/// Whether there are faces or triangle strips.
bool hasFaces(const PlyHeader& header);

/// "vertices", "faces" or "'NAME' elements", for messages.
std::string pluralOf(const PlyElement& element);

} // namespace pointrt
