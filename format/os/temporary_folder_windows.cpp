// SPDX-License-Identifier: Apache-2.0
#include "format/os/temporary_folder.h"

#include <filesystem>
#include <system_error>

#include "format/os/temporary_name.h"

namespace pointrt {

/// The folder of temporary files is the user's own already.
std::string makeTemporaryFolder() {
    std::error_code failure;
    const std::filesystem::path above = std::filesystem::temp_directory_path(failure);
    const std::filesystem::path folder = above / ("pointrt-" + format::randomLetters());
    return !failure && std::filesystem::create_directory(folder, failure) ? folder.string() : "";
}

} // namespace pointrt
