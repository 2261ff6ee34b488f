// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/file_index.h"

#include "format/base/error.h"

namespace pointrt {

TracingIndex fileIndex(const ProSections& sections, const IndexOptions& options, const std::string& name,
                       std::string_view remedy) {
    try {
        return buildTracingIndex(sections.info, sections.view, options);
    } catch (const Error& error) {
        throw Error(error.code, name + ": " + error.what() + "; " + std::string(remedy));
    }
}

} // namespace pointrt
