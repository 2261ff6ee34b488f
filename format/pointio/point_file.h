// SPDX-License-Identifier: Apache-2.0
// The bytes of a point cloud on their way to a file or to standard output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "format/base/atomic_file.h"

namespace pointrt {

/// A file that has its name when all of it is there; "-" is standard output, which gets the pieces as they come. Each
/// function throws Error kCannotWrite "PATH: reason".
class PointFile {
public:
    PointFile(std::string path, format::Existing existing);

    /// "standard output" for "-".
    const std::string& name() const { return name_; }
    void append(const void* data, std::size_t bytes);
    /// In place of bytes that were written before; of a file only.
    void overwrite(std::uint64_t offset, const void* data, std::size_t bytes);
    void commit();

private:
    void require(bool done) const;

    std::string name_;
    std::unique_ptr<format::AtomicFile> file_; ///< null: standard output
};

} // namespace pointrt
