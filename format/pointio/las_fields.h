// SPDX-License-Identifier: Apache-2.0
// The attributes of LAS points: their names, and their places in point records.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/pointio/las.h"

namespace pointrt {

/// An attribute of a point, as laspy names it. Types are PRO_TYPE_* (pro_layout.h).
struct LasField {
    std::string name;
    std::uint32_t type = 0, components = 1; ///< of the attribute
    std::size_t at = 0;                     ///< byte offset in the record
    std::uint8_t shift = 0, mask = 0;       ///< of bit fields; mask 0: whole bytes
    /// Usually 0 for all points, and then dropped.
    bool minor = false;
    bool extra = false;         ///< from the extra bytes
    std::uint32_t raw_type = 0; ///< in the record
    /// Extra bytes with a scale: value = add + multiply * raw number, as a double.
    bool scaled = false;
    std::string descriptor; ///< the 192 bytes that describe extra bytes in the file
    bool continues = false; ///< undescribed bytes that continue those of the previous field
    double multiply[3] = {1, 1, 1}, add[3] = {0, 0, 0};
};

/// All fields in the order of the record: those of the point format, then the extra bytes. Undescribed extra bytes
/// become attributes "ExtraBytes" of four bytes each. Duplicate and empty names get a number; names are cut to 31
/// bytes. Adds a note to the file for omitted fields.
std::vector<LasField> lasFields(LasFile& file);

/// The fields of the point format only.
std::vector<LasField> lasFields(std::uint8_t point_format);

/// Bytes of the value of a point.
std::size_t fieldBytes(const LasField& field);

/// The byte at which a point format has its wave packet of 29 bytes; 0 if it has none.
std::size_t wavePacketAt(std::uint8_t point_format);

/// Reads one field of many points. The value of record i goes to values + i * fieldBytes(field).
void unpackField(const LasField& field, const char* records, std::size_t record_bytes, std::size_t count, char* values);

/// Writes one field into records, whose bits of this field must be 0, and keeps all others. Rounds a scaled value to
/// the nearest raw number.
void packField(const LasField& field, const char* values, std::size_t record_bytes, std::size_t count, char* records);

} // namespace pointrt
