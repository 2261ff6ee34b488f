// SPDX-License-Identifier: Apache-2.0
// NumPy arrays that own their numbers.
#pragma once

#include <nanobind/ndarray.h>

#include <utility>
#include <vector>

namespace pointrt::python {

/// [N], or with several columns [N][columns].
template <typename Number>
nanobind::ndarray<nanobind::numpy, Number> owned(std::vector<Number> numbers, std::size_t columns) {
    auto* const kept = new std::vector<Number>(std::move(numbers));
    nanobind::capsule owner(kept, [](void* memory) noexcept { delete static_cast<std::vector<Number>*>(memory); });
    const std::size_t shape[] = {kept->size() / columns, columns};
    return nanobind::ndarray<nanobind::numpy, Number>(kept->data(), columns == 1 ? 1 : 2, shape, owner);
}

} // namespace pointrt::python
