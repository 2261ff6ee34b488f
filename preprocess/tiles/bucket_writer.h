// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the buckets of all tiles: records are buffered in bounded memory and appended to one file per tile.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "preprocess/ingest/batches.h"
#include "preprocess/tiles/bucket_layout.h"
#include "preprocess/tiles/grid_priors.h"
#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/tile_finder.h"

namespace pointrt {

class BucketWriter {
public:
    /// @param most_buffered memory for buffered records, in bytes
    BucketWriter(const SetPlan& plan, std::uint64_t most_buffered);
    ~BucketWriter();
    BucketWriter(const BucketWriter&) = delete;
    BucketWriter& operator=(const BucketWriter&) = delete;

    /// Appends a batch's points to their tiles' records, in its order. Points outside all cores are strays. Throws
    /// Error (kCannotWrite).
    void add(const PointBatch& batch, const GridPriors& priors = {});

    /// Writes all buffered records and returns the size of each bucket in bytes.
    std::vector<std::uint64_t> flush();

    /// Resumes with existing files, truncated to these sizes. Returns false if that is not possible: call restart()
    /// then.
    bool resume(const std::vector<std::uint64_t>& bytes);

    /// Removes the files of an earlier run.
    void restart();

    /// Appends the trailers and renames the files of all buckets that are not finished yet.
    void finish();

    /// Points of each tile so far.
    std::vector<std::uint64_t> counts() const;

private:
    struct Bucket;
    std::string partOf(std::size_t tile) const;
    void findTiles(const std::vector<Vec3d>& positions);
    void sortByTile();
    void makeRoom();
    void writeRecord(const PointBatch& batch, const GridPriors& priors, const std::vector<const char*>& attributes,
                     std::size_t point, char* to) const;
    void append(std::size_t tile);
    void flushLargest();

    const SetPlan& plan_;
    const BucketLayout layout_;
    const TileFinder finder_;
    const std::uint64_t most_buffered_;
    std::uint64_t buffered_ = 0;
    std::vector<std::unique_ptr<Bucket>> buckets_;
    std::vector<Vec3d> corners_; ///< [tiles]
    // The current batch:
    std::vector<std::uint32_t> tile_of_point_;
    std::vector<std::uint32_t> order_; ///< points within a tile, sorted by tile
    std::vector<char*> place_;         ///< [order] where to write each record
};

} // namespace pointrt
