// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "format/base/error.h"
#include "runtime/scene_io/scene_file.h"

namespace pointrt {

/// A folder with the files that scenes name.
class SceneFile : public testing::Test {
protected:
    SceneFile() : folder_(std::filesystem::temp_directory_path() / ("pointrt_scene_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_ / "sub.pro");
        for (const char* name : {"statue.pro", "dragon.pro", "sky.hdr", "sky.exr"}) std::ofstream(folder_ / name);
    }
    ~SceneFile() override { std::filesystem::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    SceneDescription parse(const std::string& text) const { return parseScene(text, path("scene.toml")); }
    /// Adds an instance, as scenes need something visible.
    SceneDescription parseMore(const std::string& text) const {
        return parse(text + "\n[[instance]]\nfile='statue.pro'\n");
    }

    /// The message of the error without the folder; "" if there is no error.
    std::string refusal(const std::string& text) const {
        try {
            parse(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            const std::string message = error.what(), prefix = folder_.string() + "/";
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_TRUE(message.starts_with(prefix)) << message;
            return message.substr(prefix.size());
        }
        return "";
    }

    std::filesystem::path folder_;
};

} // namespace pointrt
