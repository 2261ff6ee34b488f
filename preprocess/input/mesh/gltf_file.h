// SPDX-License-Identifier: GPL-3.0-or-later
// A glTF 2.0 file, as text or GLB, with the buffers that it names:
// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "preprocess/ingest/json_value.h"

namespace pointrt {

/// Whether the bytes are a GLB, or JSON with the members of a glTF file.
bool isGltf(std::string_view bytes);

/// The bytes of a buffer view, which hold elements every `stride` bytes; 0: one after the other.
struct GltfView {
    std::string_view bytes;
    std::uint64_t stride = 0;
};

class GltfFile {
public:
    /// Parses the JSON. Throws Error if it or the GLB is invalid or truncated.
    explicit GltfFile(const InputFile& input);
    GltfFile(const GltfFile&) = delete;
    GltfFile& operator=(const GltfFile&) = delete;

    const InputFile& input() const { return input_; }
    JsonValue root() const { return {input_, json_}; }

    /// The item of a top-level array that a value names by its index.
    JsonValue item(const char* array, const JsonValue& index) const;

    /// A buffer view that a value names by its index; valid as long as the file. Opens the buffer. Throws Error if that
    /// is missing or outside the file's folder, or if the view lies outside it or is compressed.
    GltfView view(const JsonValue& index) const;

    /// The picture of a texture that a value names by its index: a file, a data URI or a buffer view; nothing if an
    /// extension has it. Throws Error as view does.
    std::optional<InputFile> picture(const JsonValue& texture) const;

    /// Bytes of the file and of the buffers opened so far.
    std::uint64_t size() const;

private:
    void splitGlb();
    std::string_view buffer(const JsonValue& index) const;
    InputFile openBuffer(const JsonValue& buffer, std::uint64_t index) const;
    InputFile openNamed(const JsonValue& uri) const;

    const InputFile& input_;
    std::string_view text_;                  ///< the JSON
    std::optional<std::string_view> binary_; ///< the second chunk of a GLB
    nlohmann::json json_;
    mutable std::map<std::uint64_t, InputFile> buffers_; ///< those opened, by index
};

} // namespace pointrt
