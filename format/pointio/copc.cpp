// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/copc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "format/pointio/bytes.h"

namespace pointrt {
namespace {

constexpr std::size_t kInfoBytes = 160, kEntryBytes = 32;
/// Coordinates of nodes have 31 bits, so there are no deeper levels.
constexpr std::int32_t kDeepestLevel = 30;

struct Info {
    std::array<double, 3> center;
    double half_size;
    std::uint64_t root_at, root_bytes;

    explicit Info(std::string_view bytes)
        : center{loadAt<double>(bytes, 0), loadAt<double>(bytes, 8), loadAt<double>(bytes, 16)},
          half_size(loadAt<double>(bytes, 24)), root_at(loadAt<std::uint64_t>(bytes, 40)),
          root_bytes(loadAt<std::uint64_t>(bytes, 48)) {}
};

/// An entry of a page of the hierarchy: a node, or another page if points is -1.
struct Entry {
    std::int32_t level, place[3];
    std::uint64_t at;
    std::int32_t bytes, points;

    explicit Entry(std::string_view from)
        : level(loadAt<std::int32_t>(from, 0)), place{loadAt<std::int32_t>(from, 4), loadAt<std::int32_t>(from, 8),
                                                      loadAt<std::int32_t>(from, 12)},
          at(loadAt<std::uint64_t>(from, 16)), bytes(loadAt<std::int32_t>(from, 24)),
          points(loadAt<std::int32_t>(from, 28)) {}
};

CopcBox boxOf(const Info& info, const Entry& entry) {
    const double size = std::ldexp(2 * info.half_size, -entry.level);
    CopcBox box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = info.center[axis] - info.half_size + size * entry.place[axis];
        box.high[axis] = box.low[axis] + size;
    }
    return box;
}

void checkEntry(const LasFile& file, const Entry& entry) {
    if (entry.level < 0 || entry.level > kDeepestLevel || entry.bytes < 0 || entry.points < -1 ||
        !liesIn(entry.at, static_cast<std::uint64_t>(entry.bytes), file.bytes.size()))
        refuseFile("COPC hierarchy: points outside the file");
}

struct Page {
    std::uint64_t at, bytes;
};

/// Walks all pages from the root's. Reads at most as many entries as the file has room for, which stops at cyclic and
/// overlapping pages.
template <typename Use>
void forEntries(const LasFile& file, Page root, const Use& use) {
    std::uint64_t room = file.bytes.size() / kEntryBytes;
    std::vector<Page> pages = {root};
    while (!pages.empty()) {
        const Page page = pages.back();
        pages.pop_back();
        if (!liesIn(page.at, page.bytes, file.bytes.size())) refuseFile("COPC hierarchy: points outside the file");
        for (std::uint64_t at = 0; at + kEntryBytes <= page.bytes; at += kEntryBytes) {
            if (room-- == 0) refuseFile("COPC hierarchy: is cyclic");
            const Entry entry(file.bytes.substr(page.at + at, kEntryBytes));
            checkEntry(file, entry);
            if (entry.points == -1) pages.push_back({entry.at, static_cast<std::uint64_t>(entry.bytes)});
            if (entry.points > 0) use(entry);
        }
    }
}

const LasVlr* infoOf(const LasFile& file) { return findVlr(file, kCopcUser, kCopcInfoRecord); }

} // namespace

bool isCopc(const LasFile& file) {
    const LasVlr* const info = infoOf(file);
    return file.header.packed && info && info->data.size() >= kInfoBytes;
}

std::vector<LazChunk> copcChunks(const LasFile& file, const CopcChoice& is_selected) {
    const Info info(infoOf(file)->data);
    if (!std::isfinite(info.half_size) || info.half_size <= 0) refuseFile("COPC hierarchy: the size must be above 0");
    std::vector<LazChunk> chunks;
    std::uint64_t points = 0;
    forEntries(file, {info.root_at, info.root_bytes}, [&](const Entry& entry) {
        if (!is_selected(entry.level, boxOf(info, entry))) return;
        chunks.push_back({entry.at, static_cast<std::uint64_t>(entry.bytes), static_cast<std::uint64_t>(entry.points)});
        points += chunks.back().points;
    });
    if (points > file.header.point_count)
        refuseFile(fmt::format("COPC hierarchy: has {} points, the file {}", points, file.header.point_count));
    std::sort(chunks.begin(), chunks.end(), [](const LazChunk& a, const LazChunk& b) { return a.at < b.at; });
    for (std::size_t i = 1; i < chunks.size(); ++i)
        if (chunks[i - 1].at + chunks[i - 1].bytes > chunks[i].at) refuseFile("COPC hierarchy: chunks overlap");
    return chunks;
}

} // namespace pointrt
