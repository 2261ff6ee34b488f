// SPDX-License-Identifier: Apache-2.0
#include "format/crs/proj_library.h"

#include <dlfcn.h>

#include <optional>

namespace pointrt {
namespace {

template <typename Function>
bool loadFunction(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    return function != nullptr;
}

std::optional<ProjLibrary> openProj() {
    void* library = dlopen("libproj.so.25", RTLD_NOW | RTLD_LOCAL);
    if (!library) return {};
    ProjLibrary functions;
#define POINTRT_LOAD_PROJ(name)                                                                                        \
    if (!loadFunction(library, #name, functions.name)) return {};
    POINTRT_PROJ_FUNCTIONS(POINTRT_LOAD_PROJ)
#undef POINTRT_LOAD_PROJ
    return functions;
}

} // namespace

const ProjLibrary* projLibrary() {
    static const std::optional<ProjLibrary> library = openProj();
    return library ? &*library : nullptr;
}

} // namespace pointrt
