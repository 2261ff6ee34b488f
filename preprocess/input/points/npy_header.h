// SPDX-License-Identifier: GPL-3.0-or-later
// Headers of NumPy's arrays: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <string_view>
#include <vector>

#include "preprocess/ingest/field_arrays.h"
#include "preprocess/ingest/input_file.h"

namespace pointrt {

struct NpyArray {
    /// The fields of an element, with `first` and `stride` of the elements in memory order; a single one without a name
    /// if the elements are plain numbers.
    std::vector<FieldArray> fields;
    std::vector<std::uint64_t> shape;
    bool fortran_order = false; ///< the first index varies fastest
    std::uint64_t elements = 0; ///< of the shape
    std::uint64_t present = 0;  ///< number of them that the file holds

    bool isPlain() const { return fields.size() == 1 && fields.front().name.empty(); }
};

bool isNpy(std::string_view bytes);

/// Throws Error if the header is malformed, or the elements are objects, texts or other things than numbers.
NpyArray readNpyHeader(const InputFile& input);

} // namespace pointrt
