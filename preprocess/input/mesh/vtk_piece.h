// SPDX-License-Identifier: GPL-3.0-or-later
// A piece of a VTK data set: points, their arrays, and polygons.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "preprocess/ingest/field_arrays.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/sink.h"

namespace pointrt {

struct VtkPiece {
    std::uint64_t points = 0;
    FieldArray positions;
    std::vector<FieldArray> fields;     ///< other arrays with a value for each point
    std::vector<std::uint32_t> corners; ///< of all polygons, one after the other
    std::vector<std::size_t> ends;      ///< of each polygon in `corners`
    std::deque<std::string> owned;      ///< values of arrays that the file stores in another form
};

/// Appends a corner of a polygon. Throws Error if one is not the index of a point.
void addCorner(const InputFile& input, double index, VtkPiece& piece);

/// A value of an array with one component.
inline double valueAt(const FieldArray& array, std::uint64_t index) {
    return loadScalar(array.first + index * array.stride, array.type, array.swapped);
}

/// Parses numbers at the start of a text and removes them from it. Throws Error if one is malformed.
std::string takeNumbers(const InputFile& input, std::string_view& text, Scalar type, std::uint64_t count);

/// Adds the piece as a scan. Throws Error if it has no positions.
void addVtkPiece(const InputFile& input, VtkPiece& piece, Emptiness emptiness, Sink& sink);

} // namespace pointrt
