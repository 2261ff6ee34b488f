// SPDX-License-Identifier: GPL-3.0-or-later
// All tiles' buckets while they are filled: records gathered in memory of a bounded size, appended to a file a tile.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "preprocess/input/batches.h"
#include "preprocess/tiles/bucket_layout.h"
#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/tile_finder.h"

namespace pointrt {

class BucketWriter {
public:
    /// @param most_buffered bytes in memory
    BucketWriter(const SetPlan& plan, std::uint64_t most_buffered);
    ~BucketWriter();
    BucketWriter(const BucketWriter&) = delete;
    BucketWriter& operator=(const BucketWriter&) = delete;

    /// Appends a batch's points to their tiles' records, in its order. Points outside all cores are strays. Throws
    /// Error (kCannotWrite).
    void add(const PointBatch& batch);

    /// Writes what is in memory; returns the bytes that each bucket has then.
    std::vector<std::uint64_t> flush();

    /// Takes up files that have at least so many bytes, and cuts them there. False where that cannot be: everything is
    /// begun anew then.
    bool goOn(const std::vector<std::uint64_t>& bytes);

    /// Takes away what an earlier run has left.
    void beginAnew();

    /// Gives all buckets their trailers and names; those that have them stay. Points were counted before.
    void finish();

    /// Points of each tile so far.
    std::vector<std::uint64_t> counts() const;

private:
    struct Bucket;
    std::string partOf(std::size_t tile) const;
    void findTiles(const std::vector<Vec3d>& positions);
    void sortByTile();
    void makeRoom();
    void writeRecord(const PointBatch& batch, const std::vector<const char*>& attributes, std::size_t point,
                     const Vec3d& corner, char* to) const;
    void append(std::size_t tile);
    void flushLargest();

    const SetPlan& plan_;
    const BucketLayout layout_;
    const TileFinder finder_;
    const std::uint64_t most_buffered_;
    std::uint64_t buffered_ = 0;
    std::vector<std::unique_ptr<Bucket>> buckets_;
    std::vector<Vec3d> corners_; ///< [tiles]
    // Of a batch:
    std::vector<std::uint32_t> tile_of_point_;
    std::vector<std::uint32_t> order_; ///< its points that have a tile, by tiles
    std::vector<char*> place_;         ///< [order] where each one's record goes
};

} // namespace pointrt
