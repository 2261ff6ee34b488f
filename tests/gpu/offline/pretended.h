// SPDX-License-Identifier: Apache-2.0
// The layer of layer.cpp in the environment of a test, and what it has counted.
#pragma once

#include <dlfcn.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

namespace pointrt::test {

/// Variables of the environment while it lives.
class Environment {
public:
    explicit Environment(std::map<std::string, std::string> variables) : variables_(std::move(variables)) {
        for (const auto& [name, value] : variables_) setenv(name.c_str(), value.c_str(), 1);
    }
    ~Environment() {
        for (const auto& [name, value] : variables_) unsetenv(name.c_str());
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::map<std::string, std::string> variables_;
};

/// The environment with the layer added to others that are installed.
inline std::map<std::string, std::string> layered(std::map<std::string, std::string> more = {}) {
    more["VK_ADD_LAYER_PATH"] = POINTRT_LAYER_FOLDER;
    more["VK_INSTANCE_LAYERS"] = "VK_LAYER_POINTRT_pretend";
    return more;
}

/// The layer's count of that name.
inline std::uint64_t counted(const char* name) {
    static const auto count = reinterpret_cast<std::uint64_t (*)(const char*)>(
        dlsym(dlopen(POINTRT_LAYER_FOLDER "/libpointrt_pretend.so", RTLD_NOW), "pointrtLayerCount"));
    return count ? count(name) : 0;
}

/// Counts of Vulkan calls since construction.
class Counts {
public:
    std::uint64_t of(const char* name) const { return counted(name) - before_.at(name); }

private:
    std::map<std::string, std::uint64_t> before_{{"submits", counted("submits")},
                                                 {"waits", counted("waits")},
                                                 {"allocations", counted("allocations")},
                                                 {"dispatches", counted("dispatches")},
                                                 {"pipelines", counted("pipelines")},
                                                 {"kept_pipelines", counted("kept_pipelines")},
                                                 {"pipelines_of_32", counted("pipelines_of_32")},
                                                 {"labels", counted("labels")},
                                                 {"ended_labels", counted("ended_labels")},
                                                 {"barriers", counted("barriers")}};
};

} // namespace pointrt::test
