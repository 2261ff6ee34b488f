// SPDX-License-Identifier: Apache-2.0
// Libraries opened at run time.
#pragma once

namespace pointrt {

/// Words that differ by system.
struct SystemWords {
    const char *on_linux, *on_windows;
    /// The word for this system.
    const char* here() const;
};

/// A library's file, looked up where the system keeps libraries, and on Windows beside the program.
using LibraryName = SystemWords;

/// Opens a library for the rest of the process. Null if it is missing.
void* openLibrary(const LibraryName& name);

/// Finds a function by its name. False if the library lacks it.
bool findFunction(void* library, const char* name, void (*&function)());

/// The same for a pointer of the function's own type.
template <typename Function>
bool findFunction(void* library, const char* name, Function& function) {
    void (*found)() = nullptr;
    findFunction(library, name, found);
    function = reinterpret_cast<Function>(found);
    return found != nullptr;
}

} // namespace pointrt
