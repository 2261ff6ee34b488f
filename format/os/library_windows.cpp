// SPDX-License-Identifier: Apache-2.0
#include "format/os/library.h"

#include "format/os/wide_path_windows.h"

namespace pointrt {

const char* SystemWords::here() const { return on_windows; }

void* openLibrary(const LibraryName& name) {
    // not in the working folder, where anybody may have put a file of that name
    constexpr DWORD kWhere = LOAD_LIBRARY_SEARCH_APPLICATION_DIR | LOAD_LIBRARY_SEARCH_SYSTEM32;
    return LoadLibraryExA(name.here(), nullptr, kWhere);
}

bool findFunction(void* library, const char* name, void (*&function)()) {
    function = reinterpret_cast<void (*)()>(GetProcAddress(static_cast<HMODULE>(library), name));
    return function != nullptr;
}

} // namespace pointrt
