// SPDX-License-Identifier: Apache-2.0
// Output of a point cloud to a file or to standard output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "format/os/atomic_file.h"

namespace pointrt {

/// A file appears under its name when commit has completed it; "-" is standard output, which is written at once. Every
/// function throws Error kCannotWrite "PATH: reason".
class PointFile {
public:
    PointFile(std::string path, format::Existing existing);

    /// "standard output" for "-".
    const std::string& name() const { return name_; }
    void append(const void* data, std::size_t bytes);
    /// Overwrites bytes written before. Files only.
    void overwrite(std::uint64_t offset, const void* data, std::size_t bytes);
    void commit();

private:
    void require(bool done) const;

    std::string name_;
    std::unique_ptr<format::AtomicFile> file_; ///< null: standard output
};

} // namespace pointrt
