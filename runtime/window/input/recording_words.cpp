// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/recording_words.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>

namespace pointrt {
namespace {

struct NamedKey {
    const char* name;
    Key key;
};
constexpr NamedKey kNamedKeys[] = {
    {"Unknown", Key::kUnknown}, {"Space", Key::kSpace},     {"Escape", Key::kEscape},
    {"Enter", Key::kEnter},     {"Tab", Key::kTab},         {"Backspace", Key::kBackspace},
    {"Delete", Key::kDelete},   {"Left", Key::kLeft},       {"Right", Key::kRight},
    {"Up", Key::kUp},           {"Down", Key::kDown},       {"Home", Key::kHome},
    {"End", Key::kEnd},         {"PageUp", Key::kPageUp},   {"PageDown", Key::kPageDown},
    {"Shift", Key::kShift},     {"Control", Key::kControl}, {"Alt", Key::kAlt},
    {"Quote", keyOf('"')},      {"Hash", keyOf('#')}, // not allowed in words
};
constexpr const char* kButtonNames[] = {"left", "right", "middle"}; // in MouseButton's order

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

bool isSame(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

/// Printable ASCII except lower-case letters, quotes and hashes.
bool isKey(char c) { return c > ' ' && c <= '~' && !(c >= 'a' && c <= 'z') && c != '"' && c != '#'; }

bool isCharacter(std::uint32_t code_point) {
    return code_point <= 0x10FFFF && !(code_point >= 0xD800 && code_point <= 0xDFFF); // UTF-16 surrogates
}

std::string escapedByte(unsigned char byte) {
    constexpr char kDigits[] = "0123456789abcdef";
    return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

/// No line break, and no control character that affects terminals.
bool isPrintable(std::uint32_t code_point) {
    const bool breaks_lines = code_point == 0x2028 || code_point == 0x2029;
    return code_point >= 0x20 && !(code_point >= 0x7F && code_point < 0xA0) && !breaks_lines;
}

/// The byte of the escape at text[at]; moves at past the escape.
char unescaped(std::string_view text, std::size_t& at) {
    const char kind = at + 1 < text.size() ? text[at + 1] : '\0';
    at += 2;
    if (kind == '\\' || kind == '"') return kind;
    if (kind == 'n') return '\n';
    if (kind == 'r') return '\r';
    if (kind == 't') return '\t';
    unsigned value = 0;
    if (kind == 'x' && at + 2 <= text.size()) {
        const char* end = text.data() + at + 2;
        if (std::from_chars(text.data() + at, end, value, 16).ptr == end) {
            at += 2;
            return static_cast<char>(value);
        }
    }
    throw std::invalid_argument(R"(invalid escape; strings have \\ \" \n \r \t \xHH)");
}

/// The quoted string at text[at]; moves at past the string.
std::string takeString(std::string_view text, std::size_t& at) {
    std::string bytes;
    ++at;
    while (at < text.size() && text[at] != '"') {
        if (text[at] == '\\')
            bytes += unescaped(text, at);
        else
            bytes += text[at++];
    }
    if (at == text.size()) throw std::invalid_argument("a string has no closing quote");
    ++at;
    return bytes;
}

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r'; }

} // namespace

std::string keyName(Key key) {
    for (const NamedKey& each : kNamedKeys)
        if (each.key == key) return each.name;
    const auto value = static_cast<unsigned>(key), f1 = static_cast<unsigned>(Key::kF1);
    if (value < 128 && isKey(static_cast<char>(value))) return {static_cast<char>(value)};
    return key >= Key::kF1 && key <= Key::kF12 ? "F" + std::to_string(value - f1 + 1) : "Unknown";
}

std::optional<Key> keyNamed(std::string_view name) {
    if (name.size() == 1 && isKey(upper(name[0]))) return keyOf(upper(name[0]));
    for (const NamedKey& each : kNamedKeys)
        if (isSame(each.name, name)) return each.key;
    for (int number = 0; number < 12; ++number) {
        const Key key = static_cast<Key>(static_cast<int>(Key::kF1) + number);
        if (isSame(keyName(key), name)) return key;
    }
    return {};
}

const char* buttonName(MouseButton button) {
    const auto index = static_cast<std::size_t>(button);
    return kButtonNames[index < std::size(kButtonNames) ? index : 0];
}

std::optional<MouseButton> buttonNamed(std::string_view name) {
    for (std::size_t i = 0; i < std::size(kButtonNames); ++i)
        if (isSame(kButtonNames[i], name)) return static_cast<MouseButton>(i);
    return {};
}

std::optional<std::uint32_t> takeCodePoint(std::string_view& bytes) {
    const auto first = static_cast<unsigned char>(bytes[0]);
    const std::size_t count = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
    if (count == 0 || count > bytes.size()) return {};
    std::uint32_t code_point = count == 1 ? first : first & (0x7Fu >> count);
    for (std::size_t i = 1; i < count; ++i) {
        const auto byte = static_cast<unsigned char>(bytes[i]);
        if (byte >> 6 != 2) return {};
        code_point = code_point << 6 | (byte & 0x3Fu);
    }
    constexpr std::uint32_t kMin[] = {0, 0, 0x80, 0x800, 0x10000}; // smallest code point of each length
    if (!isCharacter(code_point) || code_point < kMin[count]) return {};
    bytes.remove_prefix(count);
    return code_point;
}

std::string utf8Of(std::uint32_t code_point) {
    const std::uint32_t c = isCharacter(code_point) ? code_point : 0xFFFD;
    const auto tail = [c](int shift) { return static_cast<char>(0x80 | (c >> shift & 0x3F)); };
    if (c < 0x80) return {static_cast<char>(c)};
    if (c < 0x800) return {static_cast<char>(0xC0 | c >> 6), tail(0)};
    if (c < 0x10000) return {static_cast<char>(0xE0 | c >> 12), tail(6), tail(0)};
    return {static_cast<char>(0xF0 | c >> 18), tail(12), tail(6), tail(0)};
}

std::string quotedText(std::string_view bytes) {
    std::string text = "\"";
    while (!bytes.empty()) {
        std::string_view rest = bytes;
        const std::optional<std::uint32_t> code_point = takeCodePoint(rest);
        const std::size_t taken = code_point ? bytes.size() - rest.size() : 1;
        if (bytes[0] == '"' || bytes[0] == '\\')
            text += std::string("\\") + bytes[0];
        else if (code_point && isPrintable(*code_point))
            text += bytes.substr(0, taken);
        else
            for (char byte : bytes.substr(0, taken)) text += escapedByte(static_cast<unsigned char>(byte));
        bytes.remove_prefix(taken);
    }
    return text + "\"";
}

std::vector<RecordingWord> recordingWords(std::string_view line) {
    std::vector<RecordingWord> words;
    std::size_t at = 0;
    while (true) {
        while (at < line.size() && isSpace(line[at])) ++at;
        if (at == line.size() || line[at] == '#') return words;
        if (line[at] == '"') {
            words.push_back({takeString(line, at), true});
            if (at < line.size() && !isSpace(line[at]))
                throw std::invalid_argument("a space is missing after a string");
            continue;
        }
        const std::size_t start = at;
        while (at < line.size() && !isSpace(line[at]) && line[at] != '"') ++at;
        if (at < line.size() && line[at] == '"') throw std::invalid_argument("a space is missing before a string");
        words.push_back({std::string(line.substr(start, at - start)), false});
    }
}

} // namespace pointrt
