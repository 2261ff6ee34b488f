// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/vtp.h"

#include <optional>

#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/mesh/vtk_piece.h"
#include "preprocess/input/mesh/vtp_data.h"

namespace pointrt {
namespace {

/// An opening, closing or empty tag.
struct Tag {
    std::string_view name;  ///< with its slash, if it closes an element
    std::string_view words; ///< the attributes

    /// The value of an attribute, in quotes of either kind; "" if absent.
    std::string_view value(std::string_view key) const {
        std::string_view rest = words;
        while (!rest.empty()) {
            const std::size_t equals = rest.find('=');
            if (equals == std::string_view::npos || equals + 1 >= rest.size()) return {};
            std::string_view left = rest.substr(0, equals);
            const char quote = rest[equals + 1];
            const std::size_t end = rest.find(quote, equals + 2);
            if (end == std::string_view::npos) return {};
            if (nextWord(left) == key) return rest.substr(equals + 2, end - equals - 2);
            rest.remove_prefix(end + 1);
        }
        return {};
    }
};

/// Takes the text up to the next tag, and the tag; skips comments and declarations.
std::optional<Tag> nextTag(std::string_view& rest, std::string_view& text) {
    for (;;) {
        const std::size_t open = rest.find('<');
        if (open == std::string_view::npos) return std::nullopt;
        text = rest.substr(0, open);
        rest.remove_prefix(open);
        const bool is_comment = rest.starts_with("<!--");
        const std::string_view mark = is_comment ? "-->" : ">";
        const std::size_t close = rest.find(mark);
        if (close == std::string_view::npos) return std::nullopt;
        std::string_view inner = rest.substr(1, close - 1);
        rest.remove_prefix(close + mark.size());
        if (is_comment || inner.starts_with('?') || inner.starts_with('!')) continue;
        Tag tag;
        tag.name = nextWord(inner);
        tag.words = inner;
        return tag;
    }
}

struct XmlType {
    std::string_view name;
    Scalar scalar;
};
constexpr XmlType kXmlTypes[] = {{"Int8", Scalar::kI8},    {"UInt8", Scalar::kU8},   {"Int16", Scalar::kI16},
                                 {"UInt16", Scalar::kU16}, {"Int32", Scalar::kI32},  {"UInt32", Scalar::kU32},
                                 {"Int64", Scalar::kI64},  {"UInt64", Scalar::kU64}, {"Float32", Scalar::kF32},
                                 {"Float64", Scalar::kF64}};

/// Elements whose arrays are read.
enum class Section { kOther, kPoints, kPointData, kPolygons };

class VtpReader {
public:
    VtpReader(const InputFile& input, Sink& sink) : input_(input), sink_(sink), rest_(input.bytes) { findAppended(); }

    void read() {
        const std::size_t before = sink_.scans.size(), points_before = sink_.pointCount();
        std::string_view text;
        while (const auto tag = nextTag(rest_, text)) {
            if (tag->name == "AppendedData") break;
            readTag(*tag);
        }
        if (sink_.scans.size() == before) refuse(input_, "holds no piece with points");
        if (sink_.pointCount() == points_before) refuse(input_, "none of its points is finite and passes the filters");
    }

private:
    void findAppended() {
        const std::size_t at = input_.bytes.find("<AppendedData");
        if (at == std::string_view::npos) return;
        const std::size_t end = input_.bytes.find('>', at), mark = input_.bytes.find('_', end);
        if (end == std::string_view::npos || mark == std::string_view::npos)
            refuse(input_, "truncated before its appended data");
        const Tag tag{"AppendedData", input_.bytes.substr(at + 13, end - at - 13)};
        appended_base64_ = tag.value("encoding") == "base64";
        appended_ = input_.bytes.substr(mark + 1);
    }

    void readTag(const Tag& tag) {
        if (tag.name == "VTKFile") return readFileTag(tag);
        if (tag.name == "Piece") return beginPiece(tag);
        if (tag.name == "/Piece") return endPiece();
        if (tag.name == "Points") section_ = Section::kPoints;
        if (tag.name == "PointData") section_ = Section::kPointData;
        if (tag.name == "Polys") section_ = Section::kPolygons;
        if (tag.name == "CellData" || tag.name == "Verts" || tag.name == "Lines" || tag.name == "Strips" ||
            tag.name == "Cells" || tag.name == "FieldData" || tag.name == "/FieldData")
            section_ = Section::kOther;
        if (tag.name == "DataArray" && section_ != Section::kOther) readArray(tag);
    }

    void readFileTag(const Tag& tag) {
        const std::string_view kind = tag.value("type");
        if (kind != "PolyData" && kind != "UnstructuredGrid")
            refuse(input_, fmt::format("is a VTK file of type {}; this build reads PolyData and UnstructuredGrid",
                                       inQuotes(kind)));
        swapped_ = tag.value("byte_order") == "BigEndian";
        if (swapped_) refuse(input_, "is big-endian, which this build does not read; save it as ASCII");
        encoding_.compressor = tag.value("compressor");
        encoding_.long_lengths = tag.value("header_type") == "UInt64";
    }

    void beginPiece(const Tag& tag) {
        piece_ = {};
        connectivity_.reset();
        offsets_.reset();
        section_ = Section::kOther;
        if (!wholeInteger(tag.value("NumberOfPoints"), piece_.points))
            refuse(input_, "a piece has no number of points");
        polygons_ = 0;
        wholeInteger(tag.value("NumberOfPolys"), polygons_);
    }

    void endPiece() {
        if (connectivity_ && offsets_) addPolygons();
        if (piece_.points > 0) addVtkPiece(input_, piece_, Emptiness::kAllowed, sink_);
        piece_ = {};
    }

    void addPolygons() {
        for (std::uint64_t i = 0, at = 0; i < polygons_; ++i) {
            const double end = valueAt(*offsets_, i);
            if (!(end >= static_cast<double>(at) && end <= static_cast<double>(indices_)))
                refuse(input_, "the offsets of its polygons do not ascend within their list");
            for (; at < static_cast<std::uint64_t>(end); ++at) addCorner(input_, valueAt(*connectivity_, at), piece_);
            piece_.ends.push_back(piece_.corners.size());
        }
    }

    void readArray(const Tag& tag) {
        std::uint64_t components = 1;
        const std::string_view written = tag.value("NumberOfComponents");
        constexpr std::uint64_t kMostComponents = 1 << 16;
        if (!written.empty() && (!wholeInteger(written, components) || components == 0 || components > kMostComponents))
            refuse(input_, fmt::format("an array has {} components", inQuotes(written)));
        const std::string_view name = tag.value("Name");
        if (section_ != Section::kPolygons) {
            const auto array = arrayOf(tag, piece_.points, components);
            if (array && section_ == Section::kPoints) piece_.positions = *array;
            if (array && section_ == Section::kPointData) piece_.fields.push_back(*array);
        } else if (name == "offsets") {
            offsets_ = arrayOf(tag, polygons_, 1);
            indices_ = lastOffset();
            if (pending_) connectivity_ = arrayOf(*pending_, indices_, 1);
            pending_.reset();
        } else if (name == "connectivity") {
            readConnectivity(tag);
        }
    }

    /// Limit for the number of indices: an index takes at least two bytes of text, or compresses to a hundredth of its
    /// size.
    std::uint64_t lastOffset() const {
        if (!offsets_ || polygons_ == 0) return 0;
        const double last = valueAt(*offsets_, polygons_ - 1);
        if (!(last >= 0 && last <= 1e2 * static_cast<double>(input_.bytes.size())))
            refuse(input_, fmt::format("its polygons promise {} corners", last));
        return static_cast<std::uint64_t>(last);
    }

    /// The number of indices follows from the offsets, which come later in most files.
    void readConnectivity(const Tag& tag) {
        if (offsets_) {
            connectivity_ = arrayOf(tag, indices_, 1);
            return;
        }
        pending_ = tag;
        pending_text_ = rest_;
    }

    /// The values of an array; none if its type is not numeric.
    std::optional<FieldArray> arrayOf(const Tag& tag, std::uint64_t tuples, std::uint64_t components) {
        std::optional<Scalar> type;
        for (const XmlType& each : kXmlTypes)
            if (each.name == tag.value("type")) type = each.scalar;
        if (!type) return std::nullopt;
        std::uint64_t values = 0, size = 0;
        if (__builtin_mul_overflow(tuples, components, &values) ||
            __builtin_mul_overflow(values, scalarSize(*type), &size))
            refuse(input_, "an array has an impossible size");
        std::string& bytes = piece_.owned.emplace_back();
        const std::string_view text = pending_ && &tag == &*pending_ ? pending_text_ : rest_;
        const std::string_view format = tag.value("format");
        std::uint64_t offset = 0;
        if (format == "appended") {
            if (!wholeInteger(tag.value("offset"), offset) || offset > appended_.size())
                refuse(input_, fmt::format("array {} lies outside the appended data", inQuotes(tag.value("Name"))));
            bytes = decodeVtpData(input_, encoding_, appended_.substr(offset), appended_base64_, size);
        } else if (format == "binary") {
            bytes = decodeVtpData(input_, encoding_, text.substr(0, text.find('<')), true, size);
        } else {
            bytes = parseWords(text.substr(0, text.find('<')), *type, values);
        }
        return denseField(std::string(tag.value("Name")), *type, static_cast<std::uint32_t>(components), bytes.data());
    }

    std::string parseWords(std::string_view text, Scalar type, std::uint64_t values) const {
        if (values > (text.size() + 1) / 2) // a digit and a blank each
            refuse(input_, fmt::format("an array promises {} numbers in {} bytes of text", values, text.size()));
        return takeNumbers(input_, text, type, values);
    }

    const InputFile& input_;
    Sink& sink_;
    std::string_view rest_, appended_;
    bool appended_base64_ = false, swapped_ = false;
    VtpEncoding encoding_;
    Section section_ = Section::kOther;
    VtkPiece piece_;
    std::uint64_t polygons_ = 0, indices_ = 0;
    std::optional<FieldArray> connectivity_, offsets_;
    std::optional<Tag> pending_;    ///< the connectivity, until its length is known
    std::string_view pending_text_; ///< the text that follows its tag
};

} // namespace

bool isVtp(std::string_view bytes) {
    constexpr std::size_t kPrologue = 1024; // an XML declaration and comments
    const std::string_view start = bytes.substr(0, kPrologue);
    return start.starts_with('<') && start.find("<VTKFile") != std::string_view::npos;
}

void readVtp(const InputFile& input, Sink& sink) { VtpReader(input, sink).read(); }

} // namespace pointrt
