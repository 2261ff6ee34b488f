// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes of Entwine Point Tiles whose points are bare records that the schema describes.
#pragma once

#include <deque>
#include <vector>

#include "preprocess/ingest/field_arrays.h"
#include "preprocess/ingest/json_value.h"

namespace pointrt {

class EptRecords {
public:
    /// Throws Error if the schema has no X, Y and Z or unknown types.
    EptRecords(const InputFile& input, const JsonValue& schema);

    /// Adds the points of a node to the current scan, which the first node begins.
    /// @param bytes the records of the node
    void add(const InputFile& part, std::string_view bytes, Sink& sink);

    std::size_t recordBytes() const { return record_bytes_; }
    bool hasBegun() const { return begun_; }

private:
    struct Field {
        FieldArray array; ///< `first` is null
        std::size_t at = 0;
        double scale = 1, offset = 0;
        bool isScaled() const { return scale != 1 || offset != 0; }
    };

    const InputFile& input_;
    std::vector<Field> fields_;
    std::size_t record_bytes_ = 0;
    bool begun_ = false;
};

} // namespace pointrt
