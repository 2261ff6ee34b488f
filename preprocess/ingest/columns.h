// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes of the cloud, filled from the packed values of a file's vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Selection of attributes by name.
struct AttributeChoice {
    bool all = true;
    std::vector<std::string> names; ///< if not all

    bool selects(std::string_view name) const;
};

/// A value of each vertex besides position, normal, colour and radius.
struct ColumnTraits {
    std::string name;
    Scalar type = Scalar::kF32;
    std::uint32_t components = 1;
    /// The file declares no type, so the reader chose one. Once all files are read, values are converted to the
    /// smallest type that holds all of them exactly (narrowAttributes).
    bool untyped = false;
    /// Dropped if all values of all files are 0, unless attributes are selected by name (dropMinorAttributes).
    bool minor = false;
    /// Part of the geometry, such as those of Gaussians: kept whatever attributes are selected.
    bool required = false;
};

/// The columns of the current file.
struct Columns {
    struct Column {
        std::size_t offset;    ///< in a vertex's packed values
        std::size_t trait;     ///< index into the traits
        Scalar type;           ///< of the packed values
        std::size_t attribute; ///< index into Cloud::attributes
    };
    std::vector<Column> selected;
    /// Names of attributes that are untyped in all files so far.
    std::vector<std::string> untyped;
    /// All names in the files so far, selected or not, each once.
    std::vector<std::string> available;
    /// Names of attributes that are minor in all files so far.
    std::vector<std::string> minor;
};

/// Prepares the cloud's attributes for a file's vertices: new ones are filled for the points before, and a type that
/// cannot hold the file's values is widened, exactly if possible. Throws Error (kBadInput, "NAME: reason") if the
/// number of components differs from that in the files before.
void beginColumns(Columns& columns, Cloud& cloud, const std::vector<ColumnTraits>& traits,
                  const AttributeChoice& choice, std::size_t room);

/// Appends one vertex's values, packed in the order and types of the traits, to the cloud.
void addValues(const Columns& columns, Cloud& cloud, const char* values);

/// Appends the values of many vertices. arrays[k] holds those of trait k for `count` vertices; kept: indices of the
/// vertices to append, in this order.
void addColumns(const Columns& columns, Cloud& cloud, std::span<const char* const> arrays,
                std::span<const std::uint32_t> kept, std::size_t count);

/// Fills all attributes up to the cloud's number of positions: with 0, but reals with NaN, except harmonics of
/// Gaussians, of which a file may have fewer. Minor ones stay empty until one of their values is not 0.
void fillAttributes(Cloud& cloud, const Columns& columns);

/// Throws Error (kBadInput) if a selected attribute is in no file; the message lists the available ones.
void requireAvailable(const Columns& columns, const AttributeChoice& choice);

/// Converts attributes that are untyped in all files to the smallest type that holds their values exactly.
void narrowAttributes(Cloud& cloud, const Columns& columns);

/// Statistics of an attribute whose values come in batches: what narrowAttributes and dropMinorAttributes need to
/// decide about all of them.
struct ValueSurvey {
    std::uint32_t held_by = ~0u; ///< bit t: Scalar t holds all values so far exactly
    bool any = false;            ///< some value is not 0
    std::uint64_t values = 0;    ///< points with a value

    /// @param untyped whether its type may change; testing the types takes time
    void add(const Attribute& attribute, bool untyped);
    /// The type that narrowAttributes would choose. all_have: every point has a value
    Scalar smallestType(Scalar type, bool all_have) const;
};

/// Converts the values to another type, which must hold them.
void changeType(Attribute& attribute, Scalar type);

/// Drops attributes that are minor in all files and 0 throughout.
void dropMinorAttributes(Cloud& cloud, const Columns& columns);

} // namespace pointrt
