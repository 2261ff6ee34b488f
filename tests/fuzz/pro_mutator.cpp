// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/pro_mutator.h"

#include <algorithm>
#include <cstring>

#include "pointrt/pro_layout.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointrt::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename T>
T load(const Bytes& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

template <typename T>
void store(Bytes& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Whether a section beside SPLT has an element for each splat.
bool isPerSplat(std::uint32_t kind) {
    constexpr std::uint32_t kKinds[] = {PRO_KIND_ORDR, PRO_KIND_NOIS, PRO_KIND_ATTR, PRO_KIND_GAUS, PRO_KIND_GHRM};
    return std::find(std::begin(kKinds), std::end(kKinds), kind) != std::end(kKinds);
}

struct Part {
    Bytes record;  ///< in the table, PRO_SECTION_BYTES
    Bytes content; ///< of the section

    std::uint32_t kind() const { return load<std::uint32_t>(record, PRO_SEC_OFF_KIND); }
    std::size_t stride() const { return load<std::uint32_t>(record, PRO_SEC_OFF_STRIDE); }
};

/// The parts of a file.
struct Parts {
    Bytes header; ///< PRO_HEADER_BYTES
    std::vector<Part> sections;
};

bool isPro(const Bytes& file) {
    return file.size() >= PRO_HEADER_BYTES && load<std::uint32_t>(file, PRO_OFF_MAGIC) == PRO_MAGIC_WORD0;
}

/// Splits a file. Sections outside the file become empty.
Parts takeApart(const Bytes& file) {
    Parts parts;
    parts.header.assign(file.begin(), file.begin() + PRO_HEADER_BYTES);
    const std::size_t count = std::min<std::size_t>(load<std::uint32_t>(file, PRO_OFF_SECTION_COUNT), PRO_SECTION_MAX);
    for (std::size_t i = 0; i < count; ++i) {
        const auto record = file.begin() + std::ptrdiff_t(PRO_TABLE_OFFSET + i * PRO_SECTION_BYTES);
        Part part{{record, record + PRO_SECTION_BYTES}, {}};
        const auto offset = load<std::uint64_t>(part.record, PRO_SEC_OFF_OFFSET);
        const auto length = load<std::uint64_t>(part.record, PRO_SEC_OFF_LENGTH);
        if (offset <= file.size() && length <= file.size() - offset)
            part.content.assign(file.begin() + std::ptrdiff_t(offset), file.begin() + std::ptrdiff_t(offset + length));
        parts.sections.push_back(std::move(part));
    }
    return parts;
}

void fixHeaderChecksum(Bytes& file) {
    store(file, PRO_OFF_HEADER_XXH3,
          std::uint64_t{XXH3_64bits(file.data() + PRO_OFF_SECTION_COUNT, PRO_HEADER_BYTES - PRO_OFF_SECTION_COUNT)});
}

/// Assembles a file with a valid table, size and checksums.
Bytes putTogether(const Parts& parts) {
    Bytes file = parts.header;
    for (std::size_t i = 0; i < parts.sections.size(); ++i) {
        const Part& part = parts.sections[i];
        const std::size_t record = PRO_TABLE_OFFSET + i * PRO_SECTION_BYTES;
        file.resize((file.size() + PRO_SECTION_ALIGNMENT - 1) / PRO_SECTION_ALIGNMENT * PRO_SECTION_ALIGNMENT);
        std::copy(part.record.begin(), part.record.end(), file.begin() + std::ptrdiff_t(record));
        store(file, record + PRO_SEC_OFF_OFFSET, std::uint64_t{file.size()});
        store(file, record + PRO_SEC_OFF_LENGTH, std::uint64_t{part.content.size()});
        if (part.stride() > 0)
            store(file, record + PRO_SEC_OFF_COUNT, std::uint64_t{part.content.size() / part.stride()});
        store(file, record + PRO_SEC_OFF_XXH3, std::uint64_t{XXH3_64bits(part.content.data(), part.content.size())});
        file.insert(file.end(), part.content.begin(), part.content.end());
    }
    store(file, PRO_OFF_FILE_BYTES, std::uint64_t{file.size()});
    fixHeaderChecksum(file);
    return file;
}

class Mutation {
public:
    Mutation(std::mt19937& random, const ChangeBytes& change) : random_(random), change_(change) {}

    std::size_t below(std::size_t count) { return count > 0 ? random_() % count : 0; }
    bool oneIn(std::size_t count) { return below(count) == 0; }

    /// Changes a section without resizing it: words become extremes, adjacent values or other words; or any bytes
    /// change.
    void changeContent(Part& part) {
        Bytes& content = part.content;
        for (std::size_t changes = 1 + below(3); changes > 0 && content.size() >= 4; --changes) {
            if (oneIn(3))
                changeWindow(content);
            else
                changeWord(content, below(content.size() / 4) * 4, below(content.size() / 4) * 4);
        }
        if (content.size() < 4) changeWindow(content);
    }

    /// Adds or removes elements (fewer added if they take more space than that), and adjusts the counts in the header.
    void resize(Parts& parts, Part& part, std::size_t most) {
        constexpr std::size_t kMore = 4; // a few are enough
        const std::size_t stride = std::max<std::size_t>(part.stride(), 1), count = part.content.size() / stride;
        const std::size_t resized = oneIn(2) ? count + 1 + below(kMore) : count - std::min(count, 1 + below(kMore));
        const auto resizeTo = [&](Part& each, std::size_t bytes) { // a mutant may have any stride
            if (bytes <= most) each.content.resize(bytes);
        };
        resizeTo(part, resized * stride);
        const std::uint32_t kind = part.kind();
        if (kind == PRO_KIND_SPLT)
            for (Part& each : parts.sections)
                if (isPerSplat(each.kind())) resizeTo(each, resized * each.stride());
        const std::pair<std::uint32_t, std::size_t> counts[] = {{PRO_KIND_SPLT, PRO_OFF_SPLAT_COUNT},
                                                                {PRO_KIND_NODE, PRO_OFF_NODE_COUNT},
                                                                {PRO_KIND_LEAF, PRO_OFF_LEAF_COUNT},
                                                                {PRO_KIND_REFS, PRO_OFF_REF_COUNT},
                                                                {PRO_KIND_MATL, PRO_OFF_MATERIAL_COUNT}};
        for (const auto& [counted, offset] : counts)
            if (kind == counted) store(parts.header, offset, static_cast<std::uint32_t>(resized));
    }

    void changeField(Parts& parts) {
        const auto word = [this] {
            return PRO_OFF_SECTION_COUNT + 4 * below((PRO_FIELDS_END - PRO_OFF_SECTION_COUNT) / 4);
        };
        changeWord(parts.header, word(), word());
    }

    /// Changes the table of a file and keeps its checksum valid.
    void changeRecord(Bytes& file, std::size_t sections) {
        const std::size_t record = PRO_TABLE_OFFSET + below(sections) * PRO_SECTION_BYTES;
        changeWord(file, record + 4 * below(PRO_SECTION_BYTES / 4), record + 4 * below(PRO_SECTION_BYTES / 4));
        fixHeaderChecksum(file);
    }

    void changeAnything(Bytes& file, std::size_t most) {
        const std::size_t size = file.size();
        file.resize(std::max(most, size));
        file.resize(change_(file.data(), size, file.size()));
    }

private:
    void changeWord(Bytes& bytes, std::size_t at, std::size_t other) {
        constexpr std::uint32_t kExtremes[] = {0,          1,          16,         0xFFFF,     0x7F800000,
                                               0x7FFFFFFF, 0x80000000, 0x80000001, 0xFFFFFFF0, 0xFFFFFFFF};
        const auto was = load<std::uint32_t>(bytes, at);
        switch (below(5)) {
        case 0:
            return store(bytes, at, kExtremes[below(std::size(kExtremes))]);
        case 1:
            return store(bytes, at, was + (oneIn(2) ? 1u : ~0u));
        case 2:
            return store(bytes, at, was ^ 1u << below(32));
        case 3:
            return store(bytes, at, load<std::uint32_t>(bytes, other));
        default:
            store(bytes, at, load<std::uint32_t>(bytes, other));
            store(bytes, other, was);
        }
    }

    void changeWindow(Bytes& bytes) {
        constexpr std::size_t kWindow = 64; // a few elements of any section
        if (bytes.empty()) return;
        const std::size_t first = below(bytes.size()), size = std::min(kWindow, bytes.size() - first);
        change_(bytes.data() + first, size, size);
    }

    std::mt19937& random_;
    const ChangeBytes& change_;
};

} // namespace

std::vector<std::uint8_t> mutatePro(std::vector<std::uint8_t> file, std::size_t most, std::mt19937& random,
                                    const ChangeBytes& change) {
    Mutation mutation(random, change);
    if (!isPro(file) || mutation.oneIn(32)) {
        mutation.changeAnything(file, most);
        return file;
    }
    Parts parts = takeApart(file);
    const std::size_t sections = parts.sections.size();
    if (sections == 0 || mutation.oneIn(8))
        mutation.changeField(parts);
    else if (mutation.oneIn(8))
        mutation.resize(parts, parts.sections[mutation.below(sections)], most);
    else
        mutation.changeContent(parts.sections[mutation.below(sections)]);
    Bytes mutant = putTogether(parts);
    if (mutation.oneIn(16)) mutation.changeRecord(mutant, sections);
    return mutant.size() <= most ? mutant : file;
}

} // namespace pointrt::fuzz
