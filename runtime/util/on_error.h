// SPDX-License-Identifier: Apache-2.0
// A scope guard that runs only if the scope is left by an exception, as std::experimental::scope_fail.
#pragma once

#include <exception>
#include <utility>

namespace pointrt {

template <typename Undo>
class OnError {
public:
    explicit OnError(Undo undo) : undo_(std::move(undo)) {}
    OnError(const OnError&) = delete;
    OnError& operator=(const OnError&) = delete;
    ~OnError() {
        if (std::uncaught_exceptions() > before_) undo_();
    }

private:
    Undo undo_;
    int before_ = std::uncaught_exceptions();
};

} // namespace pointrt
