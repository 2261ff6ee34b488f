// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/file_list.h"

#include <algorithm>
#include <compare>
#include <filesystem>
#include <system_error>

#include "format/os/folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Removes the leading digits from text and returns them without leading zeros.
std::string_view takeNumber(std::string_view& text) {
    const auto length = std::find_if_not(text.begin(), text.end(), isDigit) - text.begin();
    std::string_view digits = text.substr(0, static_cast<std::size_t>(length));
    text.remove_prefix(digits.size());
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

/// Compares digit strings of any length by value.
std::strong_ordering compareNumbers(std::string_view a, std::string_view b) {
    return a.size() != b.size() ? a.size() <=> b.size() : a.compare(b) <=> 0;
}

bool isScene(const fs::path& path) {
    const std::string suffix = path.extension().string();
    std::error_code ignored;
    return !path.filename().string().starts_with('.') && (suffix == ".pro" || suffix == ".toml") &&
           fs::is_regular_file(path, ignored);
}

} // namespace

bool naturallyLess(std::string_view a, std::string_view b) {
    std::string_view left = a, right = b;
    while (!left.empty() && !right.empty()) {
        if (isDigit(left.front()) && isDigit(right.front())) {
            const auto order = compareNumbers(takeNumber(left), takeNumber(right));
            if (order != 0) return order < 0;
            continue;
        }
        if (left.front() != right.front())
            return static_cast<unsigned char>(left.front()) < static_cast<unsigned char>(right.front());
        left.remove_prefix(1);
        right.remove_prefix(1);
    }
    if (left.empty() != right.empty()) return left.empty();
    return a < b; // equal numbers, such as 01 and 1
}

std::vector<std::string> sceneFiles(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const fs::path path : listFolder(folder.empty() ? "." : folder, error))
        if (isScene(path)) names.push_back(path.filename().string());
    std::sort(names.begin(), names.end(), naturallyLess);
    for (std::string& name : names) name = (fs::path(folder) / name).string();
    return names;
}

std::string neighbourFile(const std::string& path, int step) {
    const fs::path full_path(path);
    const std::vector<std::string> files = sceneFiles(full_path.parent_path().string());
    // in the form that sceneFiles uses
    const std::string name = (full_path.parent_path() / full_path.filename()).string();
    const auto at = std::lower_bound(files.begin(), files.end(), name, naturallyLess);
    const bool found = at != files.end() && *at == name;
    const auto count = static_cast<std::ptrdiff_t>(files.size());
    if (count == 0) return {};
    // a deleted file's place is between two others
    const std::ptrdiff_t from = at - files.begin() - (!found && step > 0 ? 1 : 0);
    const std::string& next = files[static_cast<std::size_t>(((from + step) % count + count) % count)];
    return next == name ? std::string() : next;
}

} // namespace pointrt
