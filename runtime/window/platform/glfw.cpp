// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/glfw.h"

#include <string>

#include "format/base/error.h"
#include "format/os/library.h"

namespace pointrt {
namespace {

constexpr LibraryName kGlfw{"libglfw.so.3", "glfw3.dll"};
constexpr SystemWords kAdvice{"install it (Debian, Ubuntu: libglfw3)", "it belongs beside pointrt-view.exe"};

template <typename Function>
void loadFunction(void* library, const char* name, Function& function) {
    if (!findFunction(library, name, function))
        throw Error{ExitCode::kCannotRun,
                    std::string("GLFW (") + kGlfw.here() + ") is older than 3.3: " + name + " is missing"};
}

Glfw openGlfw() {
    void* library = openLibrary(kGlfw);
    if (!library)
        throw Error{ExitCode::kCannotRun, std::string("a window needs GLFW (") + kGlfw.here() + "): " + kAdvice.here() +
                                              ", or render without one with -o FILE"};
    Glfw functions;
#define POINTRT_LOAD_GLFW(name) loadFunction(library, #name, functions.name);
    POINTRT_GLFW_FUNCTIONS(POINTRT_LOAD_GLFW)
#undef POINTRT_LOAD_GLFW
    return functions;
}

} // namespace

const Glfw& glfw() {
    static const Glfw functions = openGlfw();
    return functions;
}

} // namespace pointrt
