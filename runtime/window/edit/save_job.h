// SPDX-License-Identifier: Apache-2.0
// Writes a picture to files in the background: filtering, compressing and writing take about a second.
#pragma once

#include <string>

#include "runtime/image/tonemap.h"
#include "runtime/render/film_file.h"
#include "runtime/scene/overlay.h"
#include "runtime/window/edit/job.h"
#include "runtime/window/edit/load_job.h"

namespace pointrt {

/// How to make the PNG from the film. The EXR stores the film itself.
struct SaveOptions {
    ToneMapping tone;
    bool denoise = false;
    PictureOverlay overlay; ///< of the PNG
};

class SaveJob {
public:
    /// Writes name.exr and name.png. Start it while no other thread uses device.
    SaveJob(Device& device, const std::string& name, SavedFilm saved, SaveOptions look);

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// A message about the files written.
    const std::string& summary() const { return summary_; }

private:
    std::string summary_;
    JobDevice worker_;
    Job job_; ///< last, so that it ends before the others are destroyed
};

} // namespace pointrt
