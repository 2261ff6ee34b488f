// SPDX-License-Identifier: Apache-2.0
// The attributes of LAS points: where each lies in a point's record, under which name it is known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/pointio/las.h"

namespace pointrt {

/// An attribute of a point, as laspy names it. Types are PRO_TYPE_* (pro_layout.h).
struct LasField {
    std::string name;
    std::uint32_t type = 0, components = 1; ///< as handed on
    std::size_t at = 0;                     ///< byte of the record
    std::uint8_t shift = 0, mask = 0;       ///< of a byte that has several; mask 0: it has not
    /// Nearly always 0 in all points: not worth keeping then.
    bool minor = false;
    bool extra = false;         ///< one of the extra bytes
    std::uint32_t raw_type = 0; ///< in the record
    /// Of extra bytes with a scale: value = add + multiply * raw number, as a double.
    bool scaled = false;
    std::string descriptor; ///< of described extra bytes, as in the file: 192 bytes
    bool continues = false; ///< bytes without a meaning that belong to those of the field before
    double multiply[3] = {1, 1, 1}, add[3] = {0, 0, 0};
};

/// In the order of the record: those of the point format, then those of the extra bytes. Extra bytes that nothing
/// describes are "ExtraBytes", four to an attribute; names that are taken or empty get a number, those of more than 31
/// bytes are cut. What is left out is added to the file's notes.
std::vector<LasField> lasFields(LasFile& file);

/// Of the point format alone.
std::vector<LasField> lasFields(std::uint8_t point_format);

/// Bytes of a point's value.
std::size_t fieldBytes(const LasField& field);

/// Where a point format has wave packets, 29 bytes; 0 where it has none.
std::size_t wavePacketAt(std::uint8_t point_format);

/// The values of one field of many points: those of record i go to values + i * fieldBytes(field).
void unpackField(const LasField& field, const char* records, std::size_t record_bytes, std::size_t count, char* values);

/// The way back into records whose other bits stay; bits start as 0. A scaled value is rounded to the nearest raw
/// number.
void packField(const LasField& field, const char* values, std::size_t record_bytes, std::size_t count, char* records);

} // namespace pointrt
