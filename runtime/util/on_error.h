// SPDX-License-Identifier: Apache-2.0
// What is undone where a function ends by an error: std::experimental::scope_fail of the Library Fundamentals TS.
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
