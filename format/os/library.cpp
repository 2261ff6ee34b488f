// SPDX-License-Identifier: Apache-2.0
#include "format/os/library.h"

#include <dlfcn.h>

namespace pointrt {

const char* SystemWords::here() const { return on_linux; }

void* openLibrary(const LibraryName& name) { return dlopen(name.here(), RTLD_NOW | RTLD_LOCAL); }

bool findFunction(void* library, const char* name, void (*&function)()) {
    function = reinterpret_cast<void (*)()>(dlsym(library, name));
    return function != nullptr;
}

} // namespace pointrt
