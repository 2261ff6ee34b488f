// SPDX-License-Identifier: Apache-2.0
// Host and shaders share the names of shaders/shared/bindings.h and spec_constants.h. The declarations of all programs,
// read from their SPIR-V, match those headers exactly, and no number has two names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "runtime/gpu/device_choice.h"
#include "runtime/gpu/spirv.h"
#include "shaders/shared/bindings.h"

namespace pointrt {
namespace {

std::string textOf(const std::string& header) {
    std::ifstream file(std::string(POINTRT_SHARED_HEADERS) + "/" + header);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The names that a header defines as macro(number), by number. Fails if a number has two.
std::map<std::uint32_t, std::string> namesIn(const std::string& header, const std::string& name) {
    const std::string text = textOf(header);
    const std::regex line("#define (" + name + ") POINTRT_\\w+\\((\\d+)\\)\n");
    std::map<std::uint32_t, std::string> names;
    for (std::sregex_iterator found(text.begin(), text.end(), line), end; found != end; ++found) {
        const auto [place, is_new] = names.emplace(std::stoul((*found)[2]), (*found)[1]);
        EXPECT_TRUE(is_new) << (*found)[1] << " is " << place->second << " too";
    }
    EXPECT_FALSE(names.empty()) << header;
    return names;
}

std::vector<std::uint32_t> wordsOf(const std::filesystem::path& path) {
    std::vector<std::uint32_t> words(std::filesystem::file_size(path) / sizeof(std::uint32_t));
    std::ifstream(path, std::ios::binary)
        .read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof words[0]));
    return words;
}

/// The declarations of all compute programs, each with the name of one that has it.
struct Declared {
    std::map<std::uint32_t, std::string> bindings[2], constants;
};

Declared declaredByAll() {
    Declared declared;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(POINTRT_PROGRAMS)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".spv" || name.starts_with("ui_")) continue; // graphics shaders
        const ShaderInterface shader = reflectShader(wordsOf(entry.path()));
        for (const ShaderBinding& each : shader.bindings)
            declared.bindings[each.set].emplace(static_cast<std::uint32_t>(each.slot), name);
        for (const gpu::SpecId id : shader.constants) declared.constants.emplace(static_cast<std::uint32_t>(id), name);
    }
    return declared;
}

void expectSame(const std::map<std::uint32_t, std::string>& names,
                const std::map<std::uint32_t, std::string>& programs) {
    for (const auto& [number, name] : names)
        EXPECT_TRUE(programs.contains(number)) << name << ": no program declares it";
    for (const auto& [number, program] : programs)
        EXPECT_TRUE(names.contains(number)) << program << " declares " << number << ", which has no name";
}

TEST(ShaderInterface, Bindings_MatchTheirNames) {
    const Declared declared = declaredByAll();
    expectSame(namesIn("bindings.h", "BINDING_(?!\\w*_PAGES|POOLED_|CELL_TREE|CELL_BOXES)\\w+"), declared.bindings[0]);
    expectSame(namesIn("bindings.h", "BINDING_\\w+_PAGES|BINDING_POOLED_\\w+|BINDING_CELL_TREE|BINDING_CELL_BOXES"),
               declared.bindings[1]);
}

TEST(ShaderInterface, SpecializationConstants_MatchTheirNames) {
    expectSame(namesIn("spec_constants.h", "SPEC_\\w+"), declaredByAll().constants);
}

/// The largest number of descriptors of this type that a program for rendering declares.
std::uint32_t mostDeclared(VkDescriptorType type) {
    std::uint32_t most = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(POINTRT_PROGRAMS)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".spv" || name.starts_with("ui_")) continue;
        const ShaderInterface shader = reflectShader(wordsOf(entry.path()));
        const bool casts = std::any_of(shader.bindings.begin(), shader.bindings.end(),
                                       [](const ShaderBinding& each) { return each.slot == BINDING_CAST_RAYS; });
        std::uint32_t count = 0;
        for (const ShaderBinding& each : shader.bindings) count += each.set == 0 && each.type == type;
        if (!casts) most = std::max(most, count);
    }
    return most;
}

// A device with fewer is rejected before anything is built for it; one with exactly as many is accepted.
TEST(ShaderInterface, Descriptors_AreAsManyAsDevicesMustHave) {
    EXPECT_EQ(mostDeclared(VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER), kRenderDescriptors.storage_texel_buffers);
    EXPECT_EQ(mostDeclared(VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER), kRenderDescriptors.uniform_texel_buffers);
    EXPECT_EQ(mostDeclared(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER), kRenderDescriptors.storage_buffers);
    EXPECT_EQ(mostDeclared(VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER), kRenderDescriptors.uniform_buffers);
}

} // namespace
} // namespace pointrt
