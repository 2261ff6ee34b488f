// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/vtk_piece.h"

#include <span>

#include "preprocess/ingest/text.h"
#include "preprocess/ingest/typed_word.h"

namespace pointrt {

void addCorner(const InputFile& input, double index, VtkPiece& piece) {
    if (!(index >= 0 && index < static_cast<double>(piece.points)))
        refuse(input, fmt::format("vertex index {} is out of range (the piece has {} points)", index, piece.points));
    piece.corners.push_back(static_cast<std::uint32_t>(index));
}

std::string takeNumbers(const InputFile& input, std::string_view& text, Scalar type, std::uint64_t count) {
    std::string numbers(count * scalarSize(type), '\0');
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view word = nextWord(text);
        if (storeWord(word, type, numbers.data() + i * scalarSize(type)) == Stored::kNothing)
            refuseLine(input, word.data(), fmt::format("{} is not a number", inQuotes(word)));
    }
    return numbers;
}

void addVtkPiece(const InputFile& input, VtkPiece& piece, Emptiness emptiness, Sink& sink) {
    if (!piece.positions.first || piece.positions.components != 3) refuse(input, "has no points of three coordinates");
    std::vector<FieldArray> fields{piece.positions};
    fields.front().name = "points";
    fields.insert(fields.end(), piece.fields.begin(), piece.fields.end());
    findDimensions(fields);
    addFieldPoints(input, fields, piece.points, sink, !piece.ends.empty());
    std::size_t begin = 0;
    for (const std::size_t end : piece.ends) {
        if (end - begin >= 3) sink.addPolygon(std::span(piece.corners).subspan(begin, end - begin));
        begin = end;
    }
    sink.finishScan(input, "", emptiness);
}

} // namespace pointrt
