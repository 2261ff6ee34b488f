// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/scan_traits.h"

#include "preprocess/ingest/scalar.h"

namespace pointrt {

std::optional<ColumnPlace> findColumn(const ScanTraits& traits, std::string_view name) {
    std::size_t offset = 0;
    for (std::size_t i = 0; i < traits.columns.size(); ++i) {
        const ColumnTraits& column = traits.columns[i];
        if (column.name == name) return ColumnPlace{i, offset, column.type};
        offset += scalarSize(column.type) * column.components;
    }
    return std::nullopt;
}

} // namespace pointrt
