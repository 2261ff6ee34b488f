// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/gltf_file.h"

#include <filesystem>

#include "format/pointio/base64.h"
#include "preprocess/ingest/named_file.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

constexpr std::string_view kGlbMark = "glTF", kJsonChunk = "JSON";
constexpr std::string_view kBinaryChunk("BIN\0", 4);
constexpr std::size_t kGlbHeader = 12, kChunkHeader = 8;

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
    return static_cast<std::uint32_t>(loadScalar(bytes.data() + at, Scalar::kU32, false));
}

/// Takes the next chunk from the front of rest; nullopt if it is not of this type, or if the file ends.
std::optional<std::string_view> takeChunk(const InputFile& input, std::string_view& rest, std::string_view type) {
    if (rest.size() < kChunkHeader || rest.substr(4, 4) != type) return std::nullopt;
    const std::uint32_t size = wordAt(rest, 0);
    rest.remove_prefix(kChunkHeader);
    if (size > rest.size())
        refuse(input, fmt::format("truncated: a chunk of the GLB has {} bytes, {} are there", size, rest.size()));
    const std::string_view chunk = rest.substr(0, size);
    rest.remove_prefix(size);
    return chunk;
}

/// The bytes of "data:TYPE;base64,...".
std::string decodeDataUri(const JsonValue& uri) {
    const std::string_view text = uri.text();
    constexpr std::string_view kBase64 = ";base64";
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos || !text.substr(0, comma).ends_with(kBase64))
        uri.refuse("must be a data URI in base64");
    std::optional<std::string> bytes = fromBase64(text.substr(comma + 1));
    if (!bytes) uri.refuse("is not valid base64, or is truncated");
    return std::move(*bytes);
}

int hexDigit(char letter) {
    if (letter >= '0' && letter <= '9') return letter - '0';
    if (letter >= 'a' && letter <= 'f') return letter - 'a' + 10;
    if (letter >= 'A' && letter <= 'F') return letter - 'A' + 10;
    return -1;
}

/// Replaces "%20" and the like.
std::string percentDecoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escaped =
            text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0;
        decoded += escaped ? static_cast<char>(16 * hexDigit(text[i + 1]) + hexDigit(text[i + 2])) : text[i];
        if (escaped) i += 2;
    }
    return decoded;
}

} // namespace

bool isGltf(std::string_view bytes) {
    if (bytes.starts_with(kGlbMark)) return true;
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || bytes[start] != '{') return false;
    const auto has = [&](std::string_view key) { return bytes.find(key) != std::string_view::npos; };
    return has("\"asset\"") && (has("\"bufferViews\"") || has("\"meshes\""));
}

GltfFile::GltfFile(const InputFile& input) : input_(input), text_(input.bytes) {
    if (input.bytes.starts_with(kGlbMark)) splitGlb();
    json_ = parseJson(input, text_);
    const std::string& version = root().member("asset").member("version").text();
    if (!version.starts_with("2."))
        refuse(input, fmt::format("has version {}; this build reads glTF 2.0", inQuotes(version)));
}

void GltfFile::splitGlb() {
    std::string_view rest = input_.bytes;
    if (rest.size() < kGlbHeader) refuse(input_, "the GLB header is truncated");
    if (wordAt(rest, 4) != 2) refuse(input_, fmt::format("has version {}; this build reads glTF 2.0", wordAt(rest, 4)));
    rest.remove_prefix(kGlbHeader);
    const auto text = takeChunk(input_, rest, kJsonChunk);
    if (!text) refuse(input_, "the GLB has no JSON chunk");
    text_ = *text;
    binary_ = takeChunk(input_, rest, kBinaryChunk);
}

JsonValue GltfFile::item(const char* array, const JsonValue& index) const {
    const JsonValue items = root().member(array);
    const std::uint64_t number = index.integer();
    if (number >= items.size())
        index.refuse(fmt::format("index {} is out of range (there are {} {})", number, items.size(), array));
    return items.at(number);
}

InputFile GltfFile::openNamed(const JsonValue& uri) const {
    const std::string name = percentDecoded(uri.text());
    if (hasControls(name) || name.find("://") != std::string::npos)
        uri.refuse(inQuotes(name) + " is not the name of a file beside this one");
    const auto path = pathInFolder(std::filesystem::path(input_.name).parent_path(), name);
    if (!path) uri.refuse(inQuotes(name) + " lies outside the folder of the glTF file");
    return openInputFile(path->string(), NamedBy::kFile);
}

InputFile GltfFile::openBuffer(const JsonValue& buffer, std::uint64_t index) const {
    InputFile opened;
    opened.name = input_.name;
    const auto uri = buffer.optionalMember("uri");
    if (!uri) {
        if (index != 0 || !binary_) buffer.refuse("has no data: there is no uri, and no binary chunk of a GLB");
        opened.bytes = *binary_;
    } else if (uri->text().starts_with("data:")) {
        auto bytes = std::make_shared<std::string>(decodeDataUri(*uri));
        opened.bytes = *bytes;
        opened.owner = std::move(bytes);
    } else {
        opened = openNamed(*uri);
    }
    const std::uint64_t size = buffer.member("byteLength").integer();
    if (size > opened.bytes.size())
        refuse(opened,
               fmt::format("truncated: {} promises {} bytes, {} are there", buffer.place(), size, opened.bytes.size()));
    return opened;
}

std::string_view GltfFile::buffer(const JsonValue& index) const {
    const JsonValue buffer = item("buffers", index);
    const std::uint64_t number = index.integer();
    auto found = buffers_.find(number);
    if (found == buffers_.end()) found = buffers_.emplace(number, openBuffer(buffer, number)).first;
    return found->second.bytes;
}

GltfView GltfFile::view(const JsonValue& index) const {
    const JsonValue view = item("bufferViews", index);
    if (const auto extensions = view.optionalMember("extensions"))
        for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
            if (extensions->has(name))
                view.refuse(fmt::format("is compressed with {}, which this build does not read", name));
    const std::string_view bytes = buffer(view.member("buffer"));
    const auto offset = view.optionalMember("byteOffset");
    const std::uint64_t start = offset ? offset->integer() : 0, length = view.member("byteLength").integer();
    if (start > bytes.size() || length > bytes.size() - start) view.refuse("lies outside its buffer");
    const auto stride = view.optionalMember("byteStride");
    constexpr std::uint64_t kLargestStride = 1 << 16; // the specification allows 252
    return {bytes.substr(start, length), stride ? stride->integer(kLargestStride) : 0};
}

std::optional<InputFile> GltfFile::picture(const JsonValue& texture) const {
    const JsonValue its = item("textures", texture);
    auto source = its.optionalMember("source");
    if (const auto extensions = its.optionalMember("extensions"); extensions && extensions->has("EXT_texture_webp"))
        source = extensions->member("EXT_texture_webp").member("source");
    if (!source) return std::nullopt;
    const JsonValue image = item("images", *source);
    InputFile file;
    file.name = fmt::format("{}: {}", input_.name, image.place());
    if (const auto in_view = image.optionalMember("bufferView")) {
        file.bytes = view(*in_view).bytes;
        return file;
    }
    const JsonValue uri = image.member("uri");
    if (!uri.text().starts_with("data:")) return openNamed(uri);
    auto bytes = std::make_shared<std::string>(decodeDataUri(uri));
    file.bytes = *bytes;
    file.owner = std::move(bytes);
    return file;
}

std::uint64_t GltfFile::size() const {
    std::uint64_t size = input_.bytes.size();
    for (const auto& [index, buffer] : buffers_) size += buffer.bytes.size();
    return size;
}

} // namespace pointrt
