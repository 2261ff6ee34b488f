// SPDX-License-Identifier: Apache-2.0
// Loads tiles for the current view in the background.
#pragma once

#include "runtime/device_scene/scene_tiles.h"
#include "runtime/window/edit/job.h"
#include "runtime/window/edit/load_job.h"

namespace pointrt {

/// Loads the next step towards the requested cut, coarse tiles first, so that everything is visible early. A step that
/// takes long, such as one that builds indices, ends early with the tiles loaded so far. Start it while no other thread
/// uses device, which must outlive it.
class TileJob {
public:
    TileJob(Device& device, TileLoadRequest request);
    TileJob(const TileJob&) = delete;
    TileJob& operator=(const TileJob&) = delete;

    Job& job() { return job_; }
    /// The loaded tiles, once the job is done.
    LoadedTiles take();
    /// True if the requested cut is complete; otherwise another step follows.
    bool isFinalStep() const { return is_final_step_; }
    /// Number of tiles in the requested cut.
    std::size_t targetTiles() const { return target_tiles_; }

private:
    /// Destroys tiles that were never taken.
    struct OwnedTiles {
        Device& device;
        LoadedTiles tiles;
        ~OwnedTiles() { destroyTiles(device, tiles); }
    };
    void work(TileLoadRequest request);

    JobDevice worker_;
    OwnedTiles loaded_; ///< owned by the thread until the job has ended
    bool is_final_step_ = false;
    std::size_t target_tiles_ = 0;
    Job job_; ///< last, so that it ends before the others are destroyed
};

/// Chooses the cut of the next step among the cuts for all of the memory, a quarter of it, a sixteenth and so on: the
/// finest cut that needs at most about 64 MiB of non-resident files, or if it needs none, the next finer one. Returns
/// true if that is the cut for all of the memory.
bool chooseNextCut(TileLoadRequest& request);

} // namespace pointrt
