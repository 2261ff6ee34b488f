// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/glfw.h"

#include <dlfcn.h>

#include <string>

#include "format/base/error.h"

namespace pointrt {
namespace {

template <typename Function>
void loadFunction(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (!function)
        throw Error{ExitCode::kCannotRun,
                    std::string("GLFW (libglfw.so.3) is older than 3.3: ") + name + " is missing"};
}

Glfw openGlfw() {
    void* library = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        throw Error{ExitCode::kCannotRun, "a window needs GLFW (libglfw.so.3): install it (Debian, Ubuntu: libglfw3), "
                                          "or render without one with -o FILE"};
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
