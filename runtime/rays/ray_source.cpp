// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/ray_source.h"

#include <utility>

#include "runtime/rays/byte_input.h"
#include "runtime/rays/csv_rays.h"
#include "runtime/rays/npy_header.h"
#include "runtime/rays/npy_rays.h"

namespace pointrt {

const RowKind kRayRows{"ray", "rays", {6}, "6: origin and direction", "(N, 6): origin and direction"};

std::unique_ptr<RaySource> openRays(const std::string& path, const RowKind& kind) {
    auto input = std::make_unique<ByteInput>(path);
    const bool is_array = input->beginsWith(std::string(kNpyMagic));
    return is_array ? npyRays(std::move(input), kind) : csvRays(std::move(input), kind);
}

} // namespace pointrt
