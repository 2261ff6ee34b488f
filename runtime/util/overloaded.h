// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pointrt {

/// Several functions as one overload set, for std::visit.
template <typename... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

} // namespace pointrt
