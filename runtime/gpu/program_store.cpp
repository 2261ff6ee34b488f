// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/program_store.h"

namespace pointrt {

Program ProgramStore::use(std::map<ProgramKey, Entry>::iterator entry) {
    Entry& kept = entry->second;
    if (kept.users++ == 0 && kept.unused != unused_.end()) {
        unused_.erase(kept.unused);
        kept.unused = unused_.end();
    }
    return kept.program;
}

Program ProgramStore::take(Device& device, const ProgramKey& key, const std::function<Program()>& build) {
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = entries_.find(key); found != entries_.end()) return use(found);
    }
    Program built = build(); // without holding the lock, since it takes long
    const std::lock_guard lock(mutex_);
    const auto [entry, is_new] = entries_.try_emplace(key, Entry{built, 0, unused_.end()});
    if (is_new)
        keys_.emplace(built.pipeline, key);
    else
        freeProgram(device, built);
    return use(entry);
}

void ProgramStore::release(Device& device, const Program& program) {
    const std::lock_guard lock(mutex_);
    const ProgramKey& key = keys_.at(program.pipeline);
    Entry& entry = entries_.at(key);
    if (--entry.users == 0) entry.unused = unused_.insert(unused_.end(), key);
    if (unused_.size() > kUnusedKept) freeOldest(device);
}

void ProgramStore::freeOldest(Device& device) {
    const auto entry = entries_.find(unused_.front());
    unused_.pop_front();
    keys_.erase(entry->second.program.pipeline);
    freeProgram(device, entry->second.program);
    entries_.erase(entry);
}

void ProgramStore::clear(Device& device) {
    const std::lock_guard lock(mutex_);
    for (auto& [key, entry] : entries_) freeProgram(device, entry.program);
    entries_.clear();
    keys_.clear();
    unused_.clear();
}

std::size_t ProgramStore::size() {
    const std::lock_guard lock(mutex_);
    return entries_.size();
}

} // namespace pointrt
