// SPDX-License-Identifier: Apache-2.0
#include "format/crs/proj_library.h"

#include <optional>

#include "format/os/library.h"

namespace pointrt {
namespace {

constexpr LibraryName kProj{"libproj.so.25", "libproj_9.dll"};

std::optional<ProjLibrary> openProj() {
    void* library = openLibrary(kProj);
    if (!library) return {};
    ProjLibrary functions;
#define POINTRT_LOAD_PROJ(name)                                                                                        \
    if (!findFunction(library, #name, functions.name)) return {};
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
