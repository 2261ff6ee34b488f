// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/e57_points.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>

#include "format/base/number_type.h"
#include "format/pointio/column_names.h"
#include "format/pointio/e57_pages.h"

namespace pointrt {
namespace {

constexpr std::size_t kE57HeaderBytes = 48, kE57SectionBytes = 32;
/// Target size of a packet in bytes: the limit is 65535, for each stream and for all of them together.
constexpr std::size_t kPacketBytes = 60000;

/// One number per point: a stream of its own in each packet.
struct E57Stream {
    std::string tag, type;
    std::uint32_t from = PRO_TYPE_F64; ///< the type in blocks
    std::size_t column = 0;            ///< of the outline
    std::size_t component = 0;
    bool is_position = false;

    std::size_t bytes() const { return pro_type_bytes(from); }
};

template <typename Number>
std::string bytesOf(Number value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

std::string typeOf(std::uint32_t type) {
    if (type == PRO_TYPE_F32) return "type=\"Float\" precision=\"single\"";
    return withType(type, [](auto number) -> std::string {
        using Number = decltype(number);
        if constexpr (std::is_floating_point_v<Number> || sizeof(Number) == sizeof(std::int64_t))
            return "type=\"Float\"";
        else
            return fmt::format("type=\"Integer\" minimum=\"{}\" maximum=\"{}\"",
                               std::int64_t{std::numeric_limits<Number>::lowest()},
                               std::int64_t{std::numeric_limits<Number>::max()});
    });
}

/// The standard's name, or one of an extension: letters, digits and underscores.
std::string tagOf(const PointColumn& column, const std::string& name) {
    if (column.role == PointRole::kNormal)
        return std::string("nor:normal") + static_cast<char>(name.back() - 'x' + 'X');
    if (column.role == PointRole::kColor)
        return "color" + std::string(1, static_cast<char>(name[0] - 'a' + 'A')) + name.substr(1);
    constexpr std::pair<std::string_view, std::string_view> kTags[] = {
        {"intensity", "intensity"}, {"row", "rowIndex"}, {"column", "columnIndex"}};
    for (const auto& [own, tag] : kTags)
        if (own == name) return std::string(tag);
    std::string tag = "pointrt:";
    for (const char letter : name) {
        const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                           (letter >= '0' && letter <= '9') || letter == '_';
        tag += plain ? letter : '_';
    }
    return tag;
}

std::vector<E57Stream> streamsOf(const PointOutline& outline) {
    std::vector<E57Stream> streams;
    std::size_t axis = 0;
    for (const char* const tag : {"cartesianX", "cartesianY", "cartesianZ"})
        streams.push_back({tag, typeOf(PRO_TYPE_F64), PRO_TYPE_F64, 0, axis++, true});
    for (std::size_t k = 0; k < outline.columns.size(); ++k) {
        const PointColumn& column = outline.columns[k];
        const std::vector<std::string> names = componentNames(column, "");
        for (std::size_t c = 0; c < names.size(); ++c) {
            streams.push_back({tagOf(column, names[c]), typeOf(column.type), column.type, k, c, false});
        }
    }
    return streams;
}

/// A GUID computed from the scan's content, so that the same scan gives the same file.
std::string guidOf(const PointOutline& outline, std::uint64_t count, std::uint32_t part) {
    std::vector<std::uint32_t> seeds{static_cast<std::uint32_t>(count), part};
    for (const char letter : outline.metadata) seeds.push_back(static_cast<unsigned char>(letter));
    std::seed_seq sequence(seeds.begin(), seeds.end());
    std::array<std::uint32_t, 4> words{};
    sequence.generate(words.begin(), words.end());
    return fmt::format("{{{:08X}-{:04X}-{:04X}-{:04X}-{:04X}{:08X}}}", words[0], words[1] >> 16, words[1] & 0xffff,
                       words[2] >> 16, words[2] & 0xffff, words[3]);
}

/// Limits of colours and intensities, by which readers scale them.
std::string limitsOf(const PointOutline& outline) {
    std::string xml;
    for (const PointColumn& column : outline.columns) {
        if (column.role == PointRole::kColor) {
            xml += "<colorLimits type=\"Structure\">";
            for (const char* const color : {"Red", "Green", "Blue"})
                xml += fmt::format("<color{0}Minimum type=\"Integer\">0</color{0}Minimum>"
                                   "<color{0}Maximum type=\"Integer\">255</color{0}Maximum>",
                                   color);
            xml += "</colorLimits>";
        } else if (column.name == "intensity" && column.range && column.components == 1) {
            const bool real = column.type >= PRO_TYPE_F32;
            xml +=
                fmt::format("<intensityLimits type=\"Structure\"><intensityMinimum type=\"{0}\">{1}</intensityMinimum>"
                            "<intensityMaximum type=\"{0}\">{2}</intensityMaximum></intensityLimits>",
                            real ? "Float" : "Integer", (*column.range)[0], (*column.range)[1]);
        }
    }
    return xml;
}

class E57PointSink final : public PointSink {
public:
    E57PointSink(PointFile file, const PointOutline& outline)
        : pages_(std::move(file)), outline_(outline), streams_(streamsOf(outline)) {
        pages_.append(std::string(kE57HeaderBytes + kE57SectionBytes, '\0'));
        std::size_t bytes = 0;
        for (const E57Stream& stream : streams_) bytes += stream.bytes();
        points_at_once_ = kPacketBytes / (bytes + streams_.size() * sizeof(std::uint16_t));
        if (outline_.metres_per_unit > 0) scale_ = outline_.metres_per_unit;
    }

    void add(const PointBlock& block) override {
        for (std::size_t first = 0; first < block.count(); first += points_at_once_)
            addPacket(block, first, std::min(points_at_once_, block.count() - first));
        count_ += block.count();
    }

    void finish() override {
        const std::uint64_t section_end = pages_.size();
        pages_.overwriteFirst(kE57HeaderBytes, bytesOf(std::uint64_t{1}) + bytesOf(section_end - kE57HeaderBytes) +
                                                   bytesOf(E57Pages::placeOf(kE57HeaderBytes + kE57SectionBytes)) +
                                                   bytesOf(std::uint64_t{0}));
        const std::string xml = xmlText();
        pages_.append(xml);
        pages_.overwriteFirst(0, "ASTM-E57" + bytesOf(std::uint32_t{1}) + bytesOf(std::uint32_t{0}) +
                                     bytesOf(pages_.fileSize()) + bytesOf(E57Pages::placeOf(section_end)) +
                                     bytesOf(std::uint64_t{xml.size()}) + bytesOf(E57Pages::kPage));
        pages_.commit();
    }

private:
    /// Kind, length, number of streams, the length of each, the streams, padding.
    void addPacket(const PointBlock& block, std::size_t first, std::size_t count) {
        std::string lengths, data;
        for (const E57Stream& stream : streams_) {
            lengths += bytesOf(static_cast<std::uint16_t>(stream.bytes() * count));
            for (std::size_t i = first; i < first + count; ++i) addNumber(block, stream, i, data);
        }
        std::string rest = bytesOf(static_cast<std::uint16_t>(streams_.size())) + lengths + data;
        rest.resize((rest.size() + 3) / 4 * 4, '\0');
        constexpr char kDataPacket = 1;
        pages_.append(std::string{kDataPacket, '\0'} + bytesOf(static_cast<std::uint16_t>(rest.size() + 3)) + rest);
    }

    void addNumber(const PointBlock& block, const E57Stream& stream, std::size_t i, std::string& data) const {
        if (stream.is_position) {
            data += bytesOf(scale_ * block.positions[3 * i + stream.component]);
            return;
        }
        const std::byte* const from =
            block.columns[stream.column].data() +
            (i * outline_.columns[stream.column].components + stream.component) * stream.bytes();
        withType(stream.from, [&](auto number) {
            std::memcpy(&number, from, sizeof number);
            addAs(number, data);
        });
    }

    /// Integers are stored as their distance from the smallest value of the type.
    template <typename Number>
    static void addAs(Number number, std::string& data) {
        if constexpr (std::is_floating_point_v<Number>) {
            data += bytesOf(number);
        } else if constexpr (sizeof(Number) == sizeof(std::int64_t)) { // becomes a real
            data += bytesOf(static_cast<double>(number));
        } else {
            using Unsigned = std::make_unsigned_t<Number>;
            data += bytesOf(static_cast<Unsigned>(static_cast<Unsigned>(number) -
                                                  static_cast<Unsigned>(std::numeric_limits<Number>::lowest())));
        }
    }

    std::string xmlText() const {
        std::string prototype;
        for (const E57Stream& stream : streams_) prototype += fmt::format("<{} {}/>", stream.tag, stream.type);
        return fmt::format(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
            "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\" "
            "xmlns:nor=\"http://www.libe57.org/E57_NOR_surface_normals.txt\" xmlns:pointrt=\"urn:pointrt:attributes\">"
            "<formatName type=\"String\">ASTM E57 3D Imaging Data File</formatName><guid type=\"String\">{}</guid>"
            "<versionMajor type=\"Integer\">1</versionMajor><versionMinor type=\"Integer\">0</versionMinor>"
            "<e57LibraryVersion type=\"String\">{}</e57LibraryVersion><coordinateMetadata "
            "type=\"String\"></coordinateMetadata>"
            "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\"><vectorChild type=\"Structure\">"
            "<guid type=\"String\">{}</guid><name type=\"String\">points</name>{}"
            "<points type=\"CompressedVector\" fileOffset=\"{}\" recordCount=\"{}\"><prototype type=\"Structure\">{}"
            "</prototype><codecs type=\"Vector\" "
            "allowHeterogeneousChildren=\"1\"></codecs></points></vectorChild></data3D>"
            "<images2D type=\"Vector\" allowHeterogeneousChildren=\"1\"></images2D></e57Root>\n",
            guidOf(outline_, count_, 0), outline_.program, guidOf(outline_, count_, 1), limitsOf(outline_),
            E57Pages::placeOf(kE57HeaderBytes), count_, prototype);
    }

    E57Pages pages_;
    PointOutline outline_;
    std::vector<E57Stream> streams_;
    std::size_t points_at_once_ = 1;
    std::uint64_t count_ = 0;
    double scale_ = 1; ///< metres per unit
};

} // namespace

std::unique_ptr<PointSink> e57PointSink(PointFile file, const PointOutline& outline) {
    return std::make_unique<E57PointSink>(std::move(file), outline);
}

} // namespace pointrt
