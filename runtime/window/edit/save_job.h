// SPDX-License-Identifier: Apache-2.0
// A picture on its way to files, behind the window: to filter, pack and write it takes a second.
#pragma once

#include <string>

#include <optional>
#include <string>

#include "runtime/render/film_file.h"
#include "runtime/scene/legend.h"
#include "runtime/window/edit/job.h"
#include "runtime/window/edit/load_job.h"

namespace pointrt {

/// How the PNG is made of the film; the EXR holds it as it is.
struct SaveOptions {
    float exposure = 0; ///< stops
    bool denoise = false;
    std::optional<Legend> legend; ///< to lie on it
};

class SaveJob {
public:
    /// Writes name.exr and name.png. To be started where no other thread uses device.
    SaveJob(Device& device, const std::string& name, SavedFilm saved, SaveOptions look);

    Job& job() { return job_; }
    const Job& job() const { return job_; }
    /// For people: what there is now.
    const std::string& summary() const { return summary_; }

private:
    std::string summary_;
    JobDevice worker_;
    Job job_; ///< last: ends before the others go
};

} // namespace pointrt
