// SPDX-License-Identifier: Apache-2.0
// Headers of NumPy's .npy files (NEP 1, versions 1.0 to 3.0).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

inline constexpr std::string_view kNpyMagic = "\x93NUMPY"; ///< the first six bytes

/// A field of a structured type; or, without a name, the only one of a plain array.
struct NpyField {
    std::string name;
    std::string type;                 ///< "<f8"
    std::vector<std::uint64_t> shape; ///< empty: a single value
};

struct NpyHeader {
    std::vector<NpyField> fields; ///< at least one
    bool fortran_order = false;   ///< the first index varies fastest
    std::vector<std::uint64_t> shape;

    bool isPlain() const { return fields.size() == 1 && fields.front().name.empty(); }
};

/// Parses the text of a header: the Python literal of a dict with the keys descr, fortran_order and shape. Throws
/// std::invalid_argument with the reason.
NpyHeader parseNpyHeader(std::string_view text);

} // namespace pointrt
