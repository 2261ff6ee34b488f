// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/save_job.h"

#include <utility>

#include "runtime/image/image_png.h"
#include "runtime/render/picture_filter.h"

namespace pointrt {
namespace {

/// Compressing the EXR takes most of the time.
constexpr double kExrShare = 0.7;

void save(Device& device, const std::string& name, SavedFilm& saved, const SaveOptions& look, JobControl& control) {
    control.setDetail(name + ".exr");
    writeSavedFilm(name + ".exr", saved);
    control.setProgress(kExrShare);
    control.setDetail(name + ".png");
    if (look.denoise) (look.tone.has_alpha ? denoiseFilm : denoisePicture)(device, saved.film, false);
    Image8 picture = tonemapFilm(saved.film, look.tone);
    compositeOverlay(look.overlay, {picture.pixels, picture.width, 0, picture.channels});
    writePng(name + ".png", picture);
}

} // namespace

SaveJob::SaveJob(Device& device, const std::string& name, SavedFilm saved, SaveOptions look)
    : summary_("saved " + name + ".png and " + name + ".exr, " + std::to_string(saved.samples) + " samples"),
      worker_(device), job_(
                           "Saving the picture",
                           [this, name, look, film = std::make_shared<SavedFilm>(std::move(saved))](
                               JobControl& control) { save(worker_.get(), name, *film, look, control); },
                           false) {}

} // namespace pointrt
