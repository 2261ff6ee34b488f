// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "pointrt/pro.h"

namespace pointrt::format {
namespace {

constexpr const char* kAdvice = "; bake it to a .pro with pointrt-bake, which is accepted, too";

std::uint32_t typeNamed(std::string_view word) {
    constexpr std::pair<std::string_view, std::uint32_t> kTypes[] = {
        {"char", PRO_TYPE_I8},   {"int8", PRO_TYPE_I8},     {"uchar", PRO_TYPE_U8},   {"uint8", PRO_TYPE_U8},
        {"short", PRO_TYPE_I16}, {"int16", PRO_TYPE_I16},   {"ushort", PRO_TYPE_U16}, {"uint16", PRO_TYPE_U16},
        {"int", PRO_TYPE_I32},   {"int32", PRO_TYPE_I32},   {"uint", PRO_TYPE_U32},   {"uint32", PRO_TYPE_U32},
        {"float", PRO_TYPE_F32}, {"float32", PRO_TYPE_F32}, {"double", PRO_TYPE_F64}, {"float64", PRO_TYPE_F64}};
    for (const auto& [name, type] : kTypes)
        if (name == word) return type;
    return 0;
}

std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == line.npos) return words;
        const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        line.remove_prefix(end);
    }
}

class HeaderReader {
public:
    HeaderReader(const std::string& path, std::string_view file) : path_(path), file_(file) {}

    PlyHeader read() {
        nextLine(); // "ply", which is already checked
        while (true) {
            const std::vector<std::string_view> words = wordsOf(nextLine());
            if (words.empty()) continue;
            if (words[0] == "end_header") break;
            if (words[0] == "format") takeFormat(words);
            if (words[0] == "element") takeElement(words);
            if (words[0] == "property" && in_vertices_) takeProperty(words);
        }
        finish();
        return header_;
    }

private:
    [[noreturn]] void refuse(const std::string& reason) const {
        throw Error(ExitCode::kBadInput, path_ + ": " + reason);
    }
    [[noreturn]] void refuseLine(const std::string& reason) const {
        throw Error(ExitCode::kBadInput, path_ + ":" + std::to_string(header_.lines) + ": " + reason);
    }

    std::string_view nextLine() {
        const std::size_t end = file_.find('\n', header_.bytes);
        if (end == file_.npos) refuse("ends within the header");
        const std::string_view line = file_.substr(header_.bytes, end - header_.bytes);
        header_.bytes = end + 1;
        ++header_.lines;
        return line;
    }

    void takeFormat(const std::vector<std::string_view>& words) {
        const std::string_view word = words.size() > 1 ? words[1] : "";
        if (word == "ascii")
            header_.encoding = PlyEncoding::kText;
        else if (word == "binary_little_endian")
            header_.encoding = PlyEncoding::kLittleEndian;
        else if (word == "binary_big_endian")
            header_.encoding = PlyEncoding::kBigEndian;
        else
            refuseLine("unknown PLY format");
        has_format_ = true;
    }

    void takeElement(const std::vector<std::string_view>& words) {
        std::uint64_t count = 0;
        const bool counts =
            words.size() == 3 && std::from_chars(words[2].data(), words[2].data() + words[2].size(), count).ptr ==
                                     words[2].data() + words[2].size();
        if (!counts) refuseLine("not an element with a count");
        in_vertices_ = words[1] == "vertex" && !has_vertices_;
        if (!in_vertices_) {
            if (!has_vertices_ && count > 0) refuseLine("has elements before its vertices" + std::string(kAdvice));
            return;
        }
        has_vertices_ = true;
        header_.vertices = count;
    }

    void takeProperty(const std::vector<std::string_view>& words) {
        if (words.size() > 1 && words[1] == "list") refuseLine("its vertices have lists" + std::string(kAdvice));
        const std::uint32_t type = words.size() == 3 ? typeNamed(words[1]) : 0;
        if (type == 0) refuseLine("not a property with a PLY type");
        if (has(words[2])) refuseLine("duplicate property " + printable(std::string(words[2])));
        header_.properties.push_back({std::string(words[2]), type});
    }

    bool has(std::string_view name) const {
        return std::any_of(header_.properties.begin(), header_.properties.end(),
                           [&](const PlyProperty& each) { return each.name == name; });
    }

    void finish() const {
        if (!has_format_) refuse("the header lacks its format line");
        for (const char* name : {"x", "y", "z"})
            if (!has(name)) refuse(std::string("its vertices lack ") + name);
        // text needs a digit and a separator for each number
        const bool is_text = header_.encoding == PlyEncoding::kText;
        const std::uint64_t row = is_text ? 2 * header_.properties.size() : header_.rowBytes();
        const std::uint64_t room = (file_.size() - header_.bytes + (is_text ? 1 : 0)) / row;
        if (header_.vertices > room)
            refuse("promises " + std::to_string(header_.vertices) + " vertices, but has room for at most " +
                   std::to_string(room));
    }

    const std::string& path_;
    std::string_view file_;
    PlyHeader header_;
    bool has_format_ = false, has_vertices_ = false, in_vertices_ = false;
};

} // namespace

std::size_t PlyHeader::rowBytes() const {
    std::size_t bytes_of_row = 0;
    for (const PlyProperty& property : properties) bytes_of_row += pro_type_bytes(property.type);
    return bytes_of_row;
}

PlyHeader readPlyHeader(const std::string& path, std::string_view file) { return HeaderReader(path, file).read(); }

} // namespace pointrt::format
