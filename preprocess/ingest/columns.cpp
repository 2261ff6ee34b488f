// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "format/base/error.h"
#include "format/base/near_name.h"
#include "format/base/printable.h"
#include "preprocess/cloud/gather.h"
#include "preprocess/cloud/gaussians.h"
#include "preprocess/ingest/scalar.h"

namespace pointrt {
namespace {

std::size_t countOf(const Attribute& attribute) { return attribute.values.size() / attribute.bytesEach(); }

bool isSigned(Scalar type) {
    return type == Scalar::kI8 || type == Scalar::kI16 || type == Scalar::kI32 || type == Scalar::kI64;
}

/// The smallest type that holds every value of both; double for 64-bit integers with any other type.
Scalar commonType(Scalar a, Scalar b) {
    if (a == b) return a;
    if (isReal(a) || isReal(b)) {
        const auto fits = [](Scalar type) { return type == Scalar::kF32 || scalarSize(type) <= 2; };
        return fits(a) && fits(b) ? Scalar::kF32 : Scalar::kF64;
    }
    if (isSigned(a) == isSigned(b)) return scalarSize(a) > scalarSize(b) ? a : b;
    const std::size_t plain = scalarSize(isSigned(a) ? b : a), with_sign = scalarSize(isSigned(a) ? a : b);
    const std::size_t size = std::max(with_sign, 2 * plain);
    return size <= 2 ? Scalar::kI16 : size == 4 ? Scalar::kI32 : size == 8 ? Scalar::kI64 : Scalar::kF64;
}

/// Converts a number to another type, which must hold it.
void convert(const char* from, Scalar from_type, char* to, Scalar to_type) {
    if (isReal(to_type) || isReal(from_type))
        storeScalar(to, to_type, loadScalar(from, from_type, false));
    else
        storeWhole(to, to_type, loadWhole(from, from_type));
}

void fillTo(Attribute& attribute, std::size_t count) {
    const std::size_t bytes = count * attribute.bytesEach(), from = attribute.values.size();
    attribute.values.resize(bytes);
    if (!isReal(attribute.type) || isGaussianHarmonic(attribute.name)) return;
    for (std::size_t at = from; at < bytes; at += scalarSize(attribute.type))
        storeScalar(attribute.values.data() + at, attribute.type, std::numeric_limits<double>::quiet_NaN());
}

void remove(std::vector<std::string>& names, const std::string& name) {
    names.erase(std::remove(names.begin(), names.end(), name), names.end());
}

/// The attribute that stores a column, widened if needed.
std::size_t attributeFor(Cloud& cloud, Columns& columns, const ColumnTraits& column) {
    auto& all = cloud.attributes;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Attribute& each) { return each.name == column.name; });
    if (found == all.end()) {
        all.push_back({column.name, column.type, column.components, {}});
        if (column.untyped) columns.untyped.push_back(column.name);
        return all.size() - 1;
    }
    if (found->components != column.components)
        throw Error(ExitCode::kBadInput, fmt::format("{}: has {} components, but {} in an earlier file", column.name,
                                                     column.components, found->components));
    changeType(*found, commonType(found->type, column.type));
    if (!column.untyped) remove(columns.untyped, column.name);
    return static_cast<std::size_t>(found - all.begin());
}

/// An attribute stays minor as long as its columns are minor in all files.
void updateMinor(Columns& columns, const ColumnTraits& column, bool is_new, bool all_wanted) {
    if (!column.minor || !all_wanted) return remove(columns.minor, column.name);
    if (is_new) columns.minor.push_back(column.name);
}

void gatherConverted(const char* from, Scalar type, std::span<const std::uint32_t> kept, Attribute& attribute,
                     char* to) {
    for (const std::uint32_t vertex : kept)
        for (std::uint32_t c = 0; c < attribute.components; ++c) {
            convert(from + (vertex * attribute.components + c) * scalarSize(type), type, to, attribute.type);
            to += scalarSize(attribute.type);
        }
}

bool isMinor(const Attribute& attribute, const Columns& columns) {
    return std::find(columns.minor.begin(), columns.minor.end(), attribute.name) != columns.minor.end();
}

/// Whether all values so far are 0, which takes no memory.
bool isAbsent(const Attribute& attribute, const Columns& columns) {
    return attribute.values.empty() && isMinor(attribute, columns);
}

bool isZero(const char* values, std::size_t bytes) {
    return std::all_of(values, values + bytes, [](char byte) { return byte == 0; });
}

/// Whether a type holds all of the values exactly.
template <typename Value>
bool holdsAll(const Attribute& attribute) {
    const std::size_t size = scalarSize(attribute.type);
    for (std::size_t at = 0; at < attribute.values.size(); at += size) {
        const double value = loadScalar(attribute.values.data() + at, attribute.type, false);
        if constexpr (std::is_integral_v<Value>) {
            const bool in_range = value >= static_cast<double>(std::numeric_limits<Value>::lowest()) &&
                                  value <= static_cast<double>(std::numeric_limits<Value>::max());
            if (!in_range || value != std::trunc(value) || (value == 0 && std::signbit(value))) return false;
        } else if (!std::isnan(value) && static_cast<double>(static_cast<Value>(value)) != value) {
            return false;
        }
    }
    return true;
}

/// Types to convert untyped values to, the smallest first. Values are compared as doubles, which do not distinguish
/// large integers: hence no 64-bit types.
constexpr Scalar kNarrowTypes[] = {Scalar::kU8,  Scalar::kI8,  Scalar::kU16, Scalar::kI16,
                                   Scalar::kU32, Scalar::kI32, Scalar::kF32};

bool holdsAllAs(Scalar type, const Attribute& attribute) {
    switch (type) {
    case Scalar::kU8:
        return holdsAll<std::uint8_t>(attribute);
    case Scalar::kI8:
        return holdsAll<std::int8_t>(attribute);
    case Scalar::kU16:
        return holdsAll<std::uint16_t>(attribute);
    case Scalar::kI16:
        return holdsAll<std::int16_t>(attribute);
    case Scalar::kU32:
        return holdsAll<std::uint32_t>(attribute);
    case Scalar::kI32:
        return holdsAll<std::int32_t>(attribute);
    default:
        return isReal(attribute.type) && holdsAll<float>(attribute);
    }
}

Scalar smallestType(const Attribute& attribute) {
    for (const Scalar type : kNarrowTypes)
        if (holdsAllAs(type, attribute)) return type;
    return attribute.type;
}

std::uint32_t bitOf(Scalar type) { return 1u << static_cast<int>(type); }

} // namespace

bool AttributeChoice::selects(std::string_view name) const {
    return all || std::find(names.begin(), names.end(), name) != names.end();
}

void beginColumns(Columns& columns, Cloud& cloud, const std::vector<ColumnTraits>& traits,
                  const AttributeChoice& choice, std::size_t room) {
    columns.selected.clear();
    std::size_t offset = 0;
    for (std::size_t trait = 0; trait < traits.size(); ++trait) {
        const ColumnTraits& column = traits[trait];
        if (std::find(columns.available.begin(), columns.available.end(), column.name) == columns.available.end())
            columns.available.push_back(column.name);
        if (column.required || choice.selects(column.name)) {
            const std::size_t before = cloud.attributes.size();
            columns.selected.push_back({offset, trait, column.type, attributeFor(cloud, columns, column)});
            updateMinor(columns, column, cloud.attributes.size() > before, choice.all);
        }
        offset += scalarSize(column.type) * column.components;
    }
    fillAttributes(cloud, columns);
    for (const Columns::Column& column : columns.selected) {
        Attribute& attribute = cloud.attributes[column.attribute];
        const std::size_t bytes = room * attribute.bytesEach();
        if (bytes > attribute.values.capacity())
            attribute.values.reserve(std::max(bytes, attribute.values.capacity() + attribute.values.capacity() / 2));
    }
}

void addValues(const Columns& columns, Cloud& cloud, const char* values) {
    for (const Columns::Column& column : columns.selected) {
        Attribute& attribute = cloud.attributes[column.attribute];
        const char* const from = values + column.offset;
        const std::size_t at = attribute.values.size();
        if (attribute.type == column.type) {
            attribute.values.insert(attribute.values.end(), from, from + attribute.bytesEach());
            continue;
        }
        attribute.values.resize(at + attribute.bytesEach());
        for (std::uint32_t c = 0; c < attribute.components; ++c)
            convert(from + c * scalarSize(column.type), column.type,
                    attribute.values.data() + at + c * scalarSize(attribute.type), attribute.type);
    }
}

void addColumns(const Columns& columns, Cloud& cloud, std::span<const char* const> arrays,
                std::span<const std::uint32_t> kept, std::size_t count) {
    for (const Columns::Column& column : columns.selected) {
        Attribute& attribute = cloud.attributes[column.attribute];
        const char* const from = arrays[column.trait];
        const std::size_t size = attribute.bytesEach();
        if (isAbsent(attribute, columns)) {
            if (isZero(from, count * scalarSize(column.type) * attribute.components)) continue;
            fillTo(attribute, cloud.positions.size() - kept.size());
        }
        const std::size_t at = attribute.values.size();
        if (attribute.type == column.type && kept.size() == count) {
            attribute.values.insert(attribute.values.end(), from, from + count * size);
            continue;
        }
        attribute.values.resize(at + kept.size() * size);
        if (attribute.type == column.type)
            gatherValues(from, size, kept, attribute.values.data() + at);
        else
            gatherConverted(from, column.type, kept, attribute, attribute.values.data() + at);
    }
}

void fillAttributes(Cloud& cloud, const Columns& columns) {
    for (Attribute& attribute : cloud.attributes)
        if (countOf(attribute) < cloud.positions.size() && !isAbsent(attribute, columns))
            fillTo(attribute, cloud.positions.size());
}

void requireAvailable(const Columns& columns, const AttributeChoice& choice) {
    const std::vector<std::string_view> available(columns.available.begin(), columns.available.end());
    for (const std::string& name : choice.names) {
        if (std::find(available.begin(), available.end(), name) != available.end()) continue;
        const std::string_view near = nearestName(name, available);
        std::string list;
        for (const std::string_view each : available) list += (list.empty() ? "" : ", ") + printable(each);
        throw Error(ExitCode::kBadInput,
                    fmt::format("--attributes: no scan has '{}'{}; {}", printable(name),
                                near.empty() ? "" : fmt::format(", did you mean '{}'?", printable(near)),
                                list.empty() ? "the scans have no attributes" : "available: " + list));
    }
}

void narrowAttributes(Cloud& cloud, const Columns& columns) {
    for (Attribute& attribute : cloud.attributes)
        if (std::find(columns.untyped.begin(), columns.untyped.end(), attribute.name) != columns.untyped.end())
            changeType(attribute, smallestType(attribute));
}

void changeType(Attribute& attribute, Scalar type) {
    if (attribute.type == type) return;
    const std::size_t count = attribute.values.size() / scalarSize(attribute.type);
    std::vector<char> values(count * scalarSize(type));
    for (std::size_t i = 0; i < count; ++i)
        convert(attribute.values.data() + i * scalarSize(attribute.type), attribute.type,
                values.data() + i * scalarSize(type), type);
    attribute.values = std::move(values);
    attribute.type = type;
}

void ValueSurvey::add(const Attribute& attribute, bool untyped) {
    values += countOf(attribute);
    any = any || !isZero(attribute.values.data(), attribute.values.size());
    for (const Scalar type : kNarrowTypes)
        if (untyped && (held_by & bitOf(type)) != 0 && !holdsAllAs(type, attribute)) held_by &= ~bitOf(type);
}

Scalar ValueSurvey::smallestType(Scalar type, bool all_have) const {
    const bool has_nan = isReal(type) && !all_have; // NaN marks missing values
    for (const Scalar each : kNarrowTypes)
        if ((held_by & bitOf(each)) != 0 && (isReal(each) || !has_nan)) return each;
    return type;
}

void dropMinorAttributes(Cloud& cloud, const Columns& columns) {
    std::erase_if(cloud.attributes, [&](const Attribute& attribute) {
        return isMinor(attribute, columns) && isZero(attribute.values.data(), attribute.values.size());
    });
}

} // namespace pointrt
