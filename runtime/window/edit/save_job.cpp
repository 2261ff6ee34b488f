// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/save_job.h"

#include <utility>

#include "runtime/image/image_png.h"
#include "runtime/render/picture_filter.h"
#include "runtime/scene/legend_picture.h"

namespace pointrt {
namespace {

/// Compressing the EXR takes most of the time.
constexpr double kExrShare = 0.7;

Image8 withLegend(Image8 picture, const std::optional<Legend>& legend) {
    if (legend)
        compositeLegend(drawLegend(*legend, {picture.width, picture.height}),
                        {picture.pixels, picture.width, 0, picture.channels});
    return picture;
}

void save(Device& device, const std::string& name, SavedFilm& saved, const SaveOptions& look, JobControl& control) {
    control.setDetail(name + ".exr");
    writeSavedFilm(name + ".exr", saved);
    control.setProgress(kExrShare);
    control.setDetail(name + ".png");
    if (look.denoise) (look.tone.has_alpha ? denoiseFilm : denoisePicture)(device, saved.film, false);
    writePng(name + ".png", withLegend(tonemapFilm(saved.film, look.tone), look.legend));
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
