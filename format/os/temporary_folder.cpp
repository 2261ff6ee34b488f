// SPDX-License-Identifier: Apache-2.0
#include "format/os/temporary_folder.h"

#include <stdlib.h>

#include <filesystem>
#include <system_error>

namespace pointrt {

std::string makeTemporaryFolder() {
    std::error_code failure;
    const std::filesystem::path above = std::filesystem::temp_directory_path(failure);
    std::string folder = (above / "pointrt-XXXXXX").string();
    return !failure && mkdtemp(folder.data()) ? folder : "";
}

} // namespace pointrt
