// SPDX-License-Identifier: Apache-2.0
// Undo and redo of edits, and whether there are unsaved ones.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace pointrt {

/// A history of states. It compares states to detect edits: == must ignore changes that are not edits.
template <typename State>
class EditHistory {
public:
    /// A state has a few kilobytes.
    static constexpr std::size_t kMaxSteps = 1000;

    /// Starts over with a state that is saved.
    void open(State state) {
        undo_.clear();
        redo_.clear();
        saved_ = state;
        is_saved_anywhere_ = true;
        current_ = std::move(state);
    }
    /// Records state as a step if it differs from the current one. Call it when an edit is complete: once for a drag.
    bool note(const State& state) {
        if (state == current_) return false;
        if (undo_.size() == kMaxSteps) undo_.erase(undo_.begin());
        undo_.push_back(std::exchange(current_, state));
        redo_.clear();
        return true;
    }
    /// Null if there is nothing to undo or redo. Valid until the next call.
    const State* undo() { return step(undo_, redo_); }
    const State* redo() { return step(redo_, undo_); }
    bool canUndo() const { return !undo_.empty(); }
    bool canRedo() const { return !redo_.empty(); }

    void markSaved() {
        saved_ = current_;
        is_saved_anywhere_ = true;
    }
    /// Treats the opened state as unsaved.
    void markUnsaved() { is_saved_anywhere_ = false; }
    /// Whether state is not saved in any file.
    bool isModified(const State& state) const { return !is_saved_anywhere_ || !(state == saved_); }

private:
    const State* step(std::vector<State>& from, std::vector<State>& to) {
        if (from.empty()) return nullptr;
        to.push_back(std::exchange(current_, std::move(from.back())));
        from.pop_back();
        return &current_;
    }

    std::vector<State> undo_, redo_;
    State current_{}, saved_{};
    bool is_saved_anywhere_ = true;
};

} // namespace pointrt
