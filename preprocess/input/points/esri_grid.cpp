// SPDX-License-Identifier: GPL-3.0-or-later
// ESRI ASCII grids: heights of square cells, row by row from the north.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/number_style.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/points/height_grid.h"

namespace pointrt {
namespace {

struct GridHeader {
    std::uint64_t columns = 0, rows = 0;
    double x = 0, y = 0;          ///< centre of the lower left cell
    double width = 0, height = 0; ///< of a cell
    double no_data = -9999;       ///< the value that ESRI specifies if the header does not
    std::string_view body;

    double cells() const { return static_cast<double>(columns) * static_cast<double>(rows); }
};

/// Parses numbers with a decimal point, or with a comma, as programs write it in some languages.
bool gridNumber(std::string_view word, double& value) {
    return wholeNumber(word, value) || styledNumber(word, {.decimal = ','}, value);
}

/// Takes one line of the header; false if it is not one.
bool takeEntry(const InputFile& input, std::string_view line, GridHeader& header, bool& corner_x, bool& corner_y) {
    const char* const place = line.data();
    const std::string key = lowerCase(nextWord(line));
    if (key.empty() || !std::isalpha(static_cast<unsigned char>(key[0]))) return false;
    const std::string_view word = nextWord(line);
    double value = 0;
    const bool counts = key == "ncols" || key == "nrows";
    const bool good = counts ? wholeInteger(word, key == "ncols" ? header.columns : header.rows)
                             : gridNumber(word, value) && (std::isfinite(value) || key == "nodata_value");
    if (!good) refuseLine(input, place, fmt::format("{} takes a number, not {}", inQuotes(key), inQuotes(word)));
    if (key == "xllcorner" || key == "xllcenter") header.x = value, corner_x = key == "xllcorner";
    if (key == "yllcorner" || key == "yllcenter") header.y = value, corner_y = key == "yllcorner";
    if (key == "cellsize") header.width = header.height = value;
    if (key == "dx") header.width = value;
    if (key == "dy") header.height = value;
    if (key == "nodata_value") header.no_data = value;
    return true;
}

GridHeader readGridHeader(const InputFile& input, bool salvages) {
    GridHeader header;
    bool corner_x = false, corner_y = false;
    std::string_view rest = input.bytes, line;
    for (header.body = rest; nextLine(rest, line); header.body = rest) {
        std::string_view words = line;
        if (nextWord(words).empty()) continue;
        if (!takeEntry(input, line, header, corner_x, corner_y)) break;
    }
    if (!(header.width > 0 && header.height > 0)) refuse(input, "the header of the grid has no cellsize above 0");
    // A cell takes two bytes, a digit and a blank; the last needs no blank.
    if (header.cells() < 1 || header.cells() > 1e18 ||
        (!salvages && header.cells() > static_cast<double>(header.body.size() + 1) / 2))
        refuse(
            input,
            fmt::format("the header promises {} x {} cells, but only {} bytes follow; --salvage reads the intact part",
                        header.columns, header.rows, header.body.size()));
    if (corner_x) header.x += header.width / 2;
    if (corner_y) header.y += header.height / 2;
    return header;
}

bool isGridLine(std::string_view line, bool first) {
    const std::string key = lowerCase(nextWord(line));
    std::uint64_t count = 0;
    return first && (key == "ncols" || key == "nrows") && wholeInteger(nextWord(line), count);
}

/// Adds the centres of the cells with a height. Returns the number of the others.
std::uint64_t addCells(const InputFile& input, const GridHeader& header, Sink& sink) {
    std::string_view rest = header.body;
    std::uint64_t missing = 0;
    const std::uint64_t cells = header.columns * header.rows;
    Row row{};
    for (std::uint64_t i = 0; i < cells; ++i) {
        const std::string_view word = nextWord(rest);
        const bool is_cut = sink.salvages && rest.empty() && i + 1 < cells;
        if (word.empty() || is_cut) {
            sink.acceptShort(input, i, cells);
            break;
        }
        if (!gridNumber(word, row[kZ]))
            refuseLine(input, word.data(), fmt::format("{} is not a number", inQuotes(word)));
        if (row[kZ] == header.no_data || !std::isfinite(row[kZ])) {
            ++missing;
            continue;
        }
        row[kX] = header.x + header.width * static_cast<double>(i % header.columns);
        row[kY] = header.y + header.height * static_cast<double>(header.rows - 1 - i / header.columns);
        sink.addVertex(row);
    }
    return missing;
}

void readEsriGrid(const InputFile& input, Sink& sink) {
    const GridHeader header = readGridHeader(input, sink.salvages);
    ScanTraits traits;
    traits.faces = false;
    traits.vertices = std::min<std::uint64_t>(header.columns * header.rows, header.body.size());
    sink.beginScan(input, traits);
    const std::uint64_t missing = addCells(input, header, sink);
    finishHeights(input, missing, header.columns * header.rows, {}, sink);
}

} // namespace

const FormatReader readers::kEsriGrid{.isLine = isGridLine, .read = readEsriGrid, .readsInBatches = alwaysInBatches};

} // namespace pointrt
