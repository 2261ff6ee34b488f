// SPDX-License-Identifier: Apache-2.0
// Compares pictures in memory with the OpenEXR files of pointrt-view.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "pointrt/render.hpp"
#include "runtime/image/exr_read.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {

inline std::vector<std::string> allLayers() {
    std::vector<std::string> names;
    for (const PictureLayerKind& kind : pictureLayers()) names.push_back(kind.name);
    return names;
}

/// The number of values of channel c whose bits differ from those of plane.
template <typename Value>
std::size_t differences(const std::vector<Value>& values, std::size_t channels, std::size_t c,
                        std::span<const Value> plane) {
    std::size_t others = 0;
    for (std::size_t i = 0; i < plane.size(); ++i)
        others += std::memcmp(&values[channels * i + c], &plane[i], sizeof(Value)) != 0;
    return others;
}

inline void expectSame(const Picture& picture, const ExrPicture& file) {
    ASSERT_EQ(picture.width, file.width);
    ASSERT_EQ(picture.height, file.height);
    const std::size_t pixels = std::size_t{file.width} * file.height;
    std::size_t planes = 0;
    for (const PictureLayer& layer : picture.layers)
        for (std::size_t c = 0; c < layer.kind.channels.size(); ++c, ++planes) {
            const std::string& name = layer.kind.channels[c];
            const std::size_t channels = layer.kind.channels.size();
            ASSERT_EQ(layer.floats.size() + layer.words.size(), channels * pixels) << name;
            if (layer.kind.is_words)
                EXPECT_EQ(differences(layer.words, channels, c, file.words.at(name)), 0u) << name;
            else
                EXPECT_EQ(differences(layer.floats, channels, c, file.floats.at(name)), 0u) << name;
        }
    EXPECT_EQ(planes, file.floats.size() + file.words.size());
}

class PictureFolder : public testing::Test {
protected:
    /// The picture by pointrt-view with these command-line arguments.
    ExrPicture viewed(const std::string& words) const {
        const std::string command = "cd '" + folder.path.string() + "' && '" POINTRT_VIEW "' -q -o out.exr " + words;
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
        return readExr(folder.file("out.exr"), ExrKind::kFilm);
    }
    Picture rendered(const std::vector<std::string>& files, const PictureSettings& settings,
                     const PictureCamera& camera, std::uint32_t width, std::uint32_t height) const {
        std::vector<std::string> paths;
        for (const std::string& file : files) paths.push_back(folder.file(file));
        return PictureRenderer(device, paths, settings).render(camera, width, height, allLayers());
    }

    TemporaryFolder folder;
    TraceDevice device;
};

} // namespace pointrt::test
