// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/table.h"

#include <algorithm>

#include "preprocess/ingest/number_style.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

/// Number of characters between the quote at the start of text and the closing quote; npos if no quote closes it.
std::size_t quotedLength(std::string_view text) {
    for (std::size_t at = text.find('"', 1); at != std::string_view::npos; at = text.find('"', at + 2))
        if (at + 1 == text.size() || text[at + 1] != '"') return at - 1;
    return std::string_view::npos;
}

/// Whether the last field of a record opens a quote without closing it.
bool leavesQuoteOpen(std::string_view record, char delimiter) {
    if (record.find('"') == std::string_view::npos) return false;
    Fields fields{record, delimiter};
    for (std::string_view field; fields.next(field);)
        if (field.starts_with('"')) return true;
    return false;
}

/// Whether the words between blanks are three or more numbers, which may contain commas.
bool hasCommasInNumbers(std::string_view line) {
    std::size_t numbers = 0, commas = 0;
    Fields words{line, ' '};
    for (std::string_view word; words.next(word); ++numbers) {
        if (!isAnyNumber(word)) break;
        commas += word.find(',') != std::string_view::npos;
    }
    return numbers >= 3 && commas > 0;
}

/// Whether tabs delimit the fields of a line: each field is one word, or all are numbers, perhaps with blanks between
/// thousands.
bool hasTabFields(std::string_view line) {
    std::size_t count = 0, fewest = 2;
    Fields fields{line, '\t'};
    for (std::string_view field; fields.next(field); ++count) {
        double value = 0;
        const std::size_t blank = field.find(' ');
        if (field.empty()) return false;
        if (blank == std::string_view::npos || !wholeNumber(field.substr(0, blank), value)) continue;
        if (!isAnyNumber(field)) return false; // "1 2<tab>3": blanks delimit numbers
        fewest = 3;                            // "1 200<tab>3" has three numbers, but so does "1 200<tab>3<tab>4"
    }
    return count >= fewest;
}

} // namespace

bool Fields::nextQuote(std::string_view& field) {
    const std::size_t quoted = quotedLength(rest);
    if (quoted == std::string_view::npos) {
        field = nextWord(rest);
        return true;
    }
    field = rest.substr(1, quoted);
    rest.remove_prefix(quoted + 2);
    return true;
}

bool Fields::nextDelimited(std::string_view& field) {
    if (!more) return false;
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    const std::size_t quoted = rest.starts_with('"') ? quotedLength(rest) : std::string_view::npos;
    const bool is_quoted = quoted != std::string_view::npos;
    const std::size_t length = rest.find(delimiter, is_quoted ? quoted + 2 : 0);
    field = is_quoted ? rest.substr(1, quoted) : rest.substr(0, length);
    skipSpace(field);
    while (!field.empty() && isSpace(field.back())) field.remove_suffix(1);
    more = length != std::string_view::npos;
    rest.remove_prefix(more ? length + 1 : rest.size());
    return true;
}

bool nextRecord(std::string_view& rest, std::string_view& record, char delimiter) {
    constexpr int kMostLines = 16; // of an address or a remark; a stray quote must not swallow the whole file
    const char* const start = rest.data();
    if (!nextLine(rest, record)) return false;
    if (delimiter == ' ' || !leavesQuoteOpen(record, delimiter)) return true;
    std::string_view after = rest, line;
    for (int lines = 1; lines < kMostLines && nextLine(after, line); ++lines) {
        const std::string_view longer(start, static_cast<std::size_t>(line.data() + line.size() - start));
        if (leavesQuoteOpen(longer, delimiter)) continue;
        record = longer;
        rest = after;
        break;
    }
    return true;
}

char delimiterOf(std::string_view line) {
    bool quoted = false, has_comma = false, has_tab = false;
    int bars = 0;
    for (const char letter : line) {
        if (letter == '"') quoted = !quoted;
        if (quoted) continue;
        if (letter == ';') return ';';
        bars += letter == '|';
        has_comma = has_comma || letter == ',';
        has_tab = has_tab || letter == '\t';
    }
    if (bars >= 2) return '|'; // a single bar may mark a remark
    if (has_comma && !hasCommasInNumbers(line)) return ',';
    return has_tab && hasTabFields(line) ? '\t' : ' ';
}

bool isMissingNumber(std::string_view field) {
    constexpr std::string_view kWords[] = {"",    "na",     "n/a", "#n/a", "null", "none",
                                           "nil", "nodata", "-",   "--",   "?",    "*"};
    constexpr std::size_t kLongest = 6;
    if (field.size() > kLongest) return false;
    return std::find(std::begin(kWords), std::end(kWords), lowerCase(field)) != std::end(kWords);
}

} // namespace pointrt
