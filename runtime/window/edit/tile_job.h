// SPDX-License-Identifier: Apache-2.0
// Tiles for what the window shows, loaded behind it.
#pragma once

#include "runtime/device_scene/scene_tiles.h"
#include "runtime/window/edit/job.h"
#include "runtime/window/edit/load_job.h"

namespace pointrt {

/// Loads a step towards the tiles that order asks for: coarse ones first, so that something is seen of all of them
/// soon; what takes long, such as building indices, ends it with what is there by then. To be started where no other
/// thread uses device, which must outlive it.
class TileJob {
public:
    TileJob(Device& device, TileLoadRequest request);
    TileJob(const TileJob&) = delete;
    TileJob& operator=(const TileJob&) = delete;

    Job& job() { return job_; }
    /// What it has loaded, once; when it is done.
    LoadedTiles take();
    /// True where that is all that was asked for; else another step follows.
    bool isFinalStep() const { return is_final_step_; }
    /// Tiles of all that was asked for.
    std::size_t targetTiles() const { return target_tiles_; }

private:
    /// What nobody has taken goes from the device with it.
    struct OwnedTiles {
        Device& device;
        LoadedTiles tiles;
        ~OwnedTiles() { destroyTiles(device, tiles); }
    };
    void work(TileLoadRequest request);

    JobDevice worker_;
    OwnedTiles loaded_; ///< the thread's until the job has ended
    bool is_final_step_ = false;
    std::size_t target_tiles_ = 0;
    Job job_; ///< last: ends before the others go
};

/// Chooses the cuts of the next step: the finest of a few, each with a quarter of the memory of the one before, that
/// take no more than some 64 MiB of files, and where those are there already the next finer one. True where that is the
/// finest.
bool chooseNextCut(TileLoadRequest& request);

} // namespace pointrt
