// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes while they are read: the packed values of a file's vertices into the arrays of the cloud.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Which attributes are asked for, by name.
struct AttributeChoice {
    bool all = true;
    std::vector<std::string> names; ///< where not all are

    bool wants(std::string_view name) const;
};

/// What a file has of each vertex besides position, normal, colour and radius.
struct ColumnTraits {
    std::string name;
    Scalar type = Scalar::kF32;
    std::uint32_t components = 1;
    /// The type is but the reader's: once everything is read, values move to the smallest that holds all of them
    /// exactly (narrowAttributes).
    bool loose = false;
    /// Left out where all values of all files are 0 and attributes were not asked for by name (dropMinorAttributes).
    bool minor = false;
};

/// The columns of the file that is being read.
struct Columns {
    struct Column {
        std::size_t offset;    ///< in a vertex's packed values
        std::size_t trait;     ///< its number
        Scalar type;           ///< there
        std::size_t attribute; ///< of the cloud
    };
    std::vector<Column> wanted;
    /// Names of attributes that no file gave a type of its own.
    std::vector<std::string> loose;
    /// All names that files had, asked for or not, each once.
    std::vector<std::string> offered;
    /// Names of attributes that every file before thought minor.
    std::vector<std::string> minor;
};

/// Makes the cloud's attributes ready for a file's vertices: new ones get their fill for the points before, a type
/// that cannot hold the file's values becomes one that can, at best exactly. Throws Error (kBadInput, "NAME: reason")
/// when an attribute's number of components differs from that of the files before.
void beginColumns(Columns& columns, Cloud& cloud, const std::vector<ColumnTraits>& traits,
                  const AttributeChoice& choice, std::size_t room);

/// Appends one vertex's values, packed in the order and types of the traits, to the cloud.
void addValues(const Columns& columns, Cloud& cloud, const char* values);

/// The same of many vertices: array k of the values has those of trait k. kept: numbers of the vertices whose values
/// are wanted, in this order, of so many.
void addColumns(const Columns& columns, Cloud& cloud, std::span<const char* const> arrays,
                std::span<const std::uint32_t> kept, std::size_t count);

/// Fills all attributes up to the cloud's number of positions: 0, or NaN in reals. Minor ones that are empty, as they
/// are until one of their values is not 0, stay so.
void fillAttributes(Cloud& cloud, const Columns& columns);

/// Throws Error (kBadInput) naming an attribute that is asked for and that no file has, and those that there are.
void requireOffered(const Columns& columns, const AttributeChoice& choice);

/// Gives attributes that only loose columns went into the smallest type that holds their values exactly.
void narrowAttributes(Cloud& cloud, const Columns& columns);

/// What is known of an attribute whose values come in batches: as much as narrowAttributes and dropMinorAttributes ask
/// of all of them.
struct ValueSurvey {
    std::uint32_t held_by = ~0u; ///< bit t: Scalar t holds all values so far exactly
    bool any = false;            ///< some value is not 0
    std::uint64_t values = 0;    ///< of so many points

    /// @param loose whether its type may become another one, which takes time to know
    void add(const Attribute& attribute, bool loose);
    /// The type that narrowAttributes chooses where all points have a value, and where some have not.
    Scalar smallestType(Scalar type, bool all_have) const;
};

/// Moves the values to another type, which holds them.
void changeType(Attribute& attribute, Scalar type);

/// Drops attributes that only minor columns went into, none of whose values is anything but 0.
void dropMinorAttributes(Cloud& cloud, const Columns& columns);

} // namespace pointrt
