// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a JSON file with their places, for readers that trust none of the values.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

/// Parses the text, which is the input's or a part of it. Throws Error if it is not JSON.
nlohmann::json parseJson(const InputFile& input, std::string_view text);

/// A value that must have the type that its reader asks for: otherwise functions throw Error with the file and the
/// place, such as "meshes[0].primitives[2].mode". Valid as long as the input and the parsed JSON.
class JsonValue {
public:
    JsonValue(const InputFile& input, const nlohmann::json& root) : input_(&input), value_(&root) {}

    /// Whether this is an object with a member of this name that is not null.
    bool has(const char* key) const;
    JsonValue member(const char* key) const;
    std::optional<JsonValue> optionalMember(const char* key) const;

    /// The length of an array.
    std::size_t size() const;
    JsonValue at(std::size_t index) const;

    double number() const; ///< finite
    std::uint64_t integer(std::uint64_t most = UINT64_MAX) const;
    const std::string& text() const;
    bool boolean() const;
    bool isNull() const;

    /// The value itself, for what the functions above do not cover.
    const nlohmann::json& json() const { return *value_; }
    const std::string& place() const { return place_; }
    [[noreturn]] void refuse(const std::string& reason) const;

private:
    JsonValue(const InputFile& input, const nlohmann::json& value, std::string place)
        : input_(&input), value_(&value), place_(std::move(place)) {}

    const InputFile* input_;
    const nlohmann::json* value_;
    std::string place_;
};

} // namespace pointrt
