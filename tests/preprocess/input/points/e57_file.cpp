// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/points/e57_file.h"

#include <bit>
#include <fmt/format.h>

#include "tests/preprocess/input/input_fixture.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kPage = 1024, kPayload = 1020;

std::uint64_t physical(std::uint64_t logical) { return logical / kPayload * kPage + logical % kPayload; }

/// CRC-32C, bit by bit.
std::uint32_t checksum(std::string_view bytes) {
    std::uint32_t sum = ~0u;
    for (const char byte : bytes) {
        sum ^= static_cast<std::uint8_t>(byte);
        for (int i = 0; i < 8; ++i) sum = sum >> 1 ^ (sum & 1 ? 0x82F63B78u : 0); // the polynomial, reversed
    }
    return ~sum;
}

/// Packs the lowest bits first.
std::string packed(const E57TestColumn& column) {
    std::string bytes((column.values.size() * static_cast<std::size_t>(column.bits) + 7) / 8, '\0');
    std::size_t at = 0;
    for (const std::uint64_t value : column.values)
        for (int i = 0; i < column.bits; ++i, ++at)
            if (value >> i & 1) bytes[at / 8] = static_cast<char>(bytes[at / 8] | 1 << at % 8);
    return bytes;
}

/// A header of 4 bytes, then the rest, padded to a multiple of 4.
std::string packet(std::uint8_t kind, std::string rest) {
    rest.resize((rest.size() + 3) / 4 * 4);
    return bytesOf(kind) + '\0' + bytesOf(static_cast<std::uint16_t>(rest.size() + 3)) + rest;
}

std::string dataPacket(const E57TestScan& scan, std::size_t number) {
    std::string sizes, pieces;
    for (const E57TestColumn& column : scan.columns) {
        const std::string bytes = packed(column);
        const std::size_t first = bytes.size() * number / scan.packets,
                          last = bytes.size() * (number + 1) / scan.packets;
        sizes += bytesOf(static_cast<std::uint16_t>(last - first));
        pieces += bytes.substr(first, last - first);
    }
    return packet(1, bytesOf(static_cast<std::uint16_t>(scan.columns.size())) + sizes + pieces);
}

std::string packetsOf(const E57TestScan& scan) {
    std::string packets;
    for (std::size_t i = 0; i < scan.packets; ++i) {
        if (scan.other_packets) packets += packet(0, std::string(28, '\0')) + packet(2, std::string(8, '\x5a'));
        packets += dataPacket(scan, i);
    }
    return packets;
}

std::string prototypeOf(const E57TestScan& scan) {
    std::string xml = "<prototype type=\"Structure\">";
    for (const E57TestColumn& column : scan.columns) xml += fmt::format("<{} {}/>", column.tag, column.type);
    return xml + "</prototype>";
}

/// Appends the scan's section, and returns its XML element.
std::string addScan(std::string& logical, const E57TestScan& scan) {
    const std::size_t start = logical.size();
    const std::string packets = packetsOf(scan);
    logical += bytesOf(std::uint64_t{1}) + bytesOf(std::uint64_t{32 + packets.size()}) + bytesOf(physical(start + 32)) +
               bytesOf(std::uint64_t{0}) + packets;
    const std::string offset = scan.file_offset.empty() ? std::to_string(physical(start)) : scan.file_offset;
    const std::string points =
        scan.points.empty() ? std::to_string(scan.columns.empty() ? 0 : scan.columns[0].values.size()) : scan.points;
    return fmt::format("<vectorChild type=\"Structure\">{}<points type=\"CompressedVector\" fileOffset=\"{}\" "
                       "recordCount=\"{}\">{}<codecs type=\"Vector\"/></points></vectorChild>\n",
                       e57Text("guid", "{scan}") + scan.xml, offset, points, prototypeOf(scan));
}

constexpr const char* kRoot =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
    "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\" xmlns:nor=\"http://www.libe57.org/E57_NOR.txt\" "
    "xmlns:las=\"http://www.libe57.org/E57_LAS.txt\">"
    "<formatName type=\"String\">ASTM E57 3D Imaging Data File</formatName><guid type=\"String\">{file}</guid>"
    "<versionMajor type=\"Integer\">1</versionMajor><versionMinor type=\"Integer\"/>";

E57TestColumn wholes(const std::string& tag, const std::string& type, std::int64_t least, std::int64_t most,
                     const std::vector<std::int64_t>& values) {
    const std::uint64_t range = static_cast<std::uint64_t>(most) - static_cast<std::uint64_t>(least);
    E57TestColumn column{tag, type, static_cast<int>(std::bit_width(range)), {}};
    for (const std::int64_t value : values)
        column.values.push_back(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(least));
    return column;
}

} // namespace

E57TestColumn e57Doubles(const std::string& tag, const std::vector<double>& values) {
    E57TestColumn column{tag, "type=\"Float\"", 64, {}};
    for (const double value : values) column.values.push_back(std::bit_cast<std::uint64_t>(value));
    return column;
}

E57TestColumn e57Floats(const std::string& tag, const std::vector<float>& values) {
    E57TestColumn column{tag, "type=\"Float\" precision=\"single\"", 32, {}};
    for (const float value : values) column.values.push_back(std::bit_cast<std::uint32_t>(value));
    return column;
}

E57TestColumn e57Whole(const std::string& tag, std::int64_t least, std::int64_t most,
                       const std::vector<std::int64_t>& values) {
    return wholes(tag, fmt::format("type=\"Integer\" minimum=\"{}\" maximum=\"{}\"", least, most), least, most, values);
}

E57TestColumn e57Scaled(const std::string& tag, std::int64_t least, std::int64_t most, double scale, double offset,
                        const std::vector<std::int64_t>& values) {
    const std::string type = fmt::format(
        "type=\"ScaledInteger\" minimum=\"{}\" maximum=\"{}\" scale=\"{}\" offset=\"{}\"", least, most, scale, offset);
    return wholes(tag, type, least, most, values);
}

std::string e57Logical(const std::vector<E57TestScan>& scans, const std::string& root_xml) {
    constexpr std::size_t kHeader = 48;
    std::string logical(kHeader, '\0'), xml = kRoot + root_xml + "<data3D type=\"Vector\">\n";
    for (const E57TestScan& scan : scans) xml += addScan(logical, scan);
    xml += "</data3D></e57Root>\n";
    const std::size_t xml_at = logical.size();
    logical += xml;
    const std::size_t pages = (logical.size() + kPayload - 1) / kPayload;
    const std::string header = "ASTM-E57" + bytesOf(std::uint32_t{1}) + bytesOf(std::uint32_t{0}) +
                               bytesOf(std::uint64_t{pages * kPage}) + bytesOf(physical(xml_at)) +
                               bytesOf(std::uint64_t{xml.size()}) + bytesOf(std::uint64_t{kPage});
    return logical.replace(0, kHeader, header);
}

std::string e57Pages(std::string logical) {
    logical.resize((logical.size() + kPayload - 1) / kPayload * kPayload);
    std::string file;
    for (std::size_t at = 0; at < logical.size(); at += kPayload) {
        const std::string page = logical.substr(at, kPayload);
        file += page + bytesOf(checksum(page), true); // most significant byte first
    }
    return file;
}

std::string e57File(const std::vector<E57TestScan>& scans, const std::string& root_xml) {
    return e57Pages(e57Logical(scans, root_xml));
}

std::string e57Text(const std::string& name, const std::string& text) {
    return fmt::format("<{} type=\"String\">{}</{}>", name, text, name);
}

std::string e57Number(const std::string& name, double value) {
    return fmt::format("<{} type=\"Float\">{}</{}>", name, value, name);
}

} // namespace pointrt::test
