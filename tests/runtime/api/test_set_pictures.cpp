// SPDX-License-Identifier: Apache-2.0
// Pictures of tile sets from several cameras: each uses the same tiles as when it is rendered alone.
#include <algorithm>

#include "tests/runtime/api/same_pictures.h"
#include "tests/support/hand_cut_set.h"

namespace pointrt::test {
namespace {

class SetPictures : public PictureFolder {
protected:
    SetPictures() {
        const Splats fine = sphereSplats(4000, Vec3f(0, 0, 0), 1), coarse = sphereSplats(2000, Vec3f(0, 0, 0), 1);
        Splats root = coarse;
        std::fill(root.radii.begin(), root.radii.end(), fine.radii[0]);
        writeHandCutSet(folder.file("ball.proset"), {{-1.25, -1.25, -1.25}, 1.25, 2, 0.02, fine.radii[0]}, fine, root);
    }
};

TEST_F(SetPictures, MatchPointrtView) {
    const PictureSettings settings{{"integrator", "path"}, {"spp", "2"}, {"lights", "2"}};
    folder.write("scene.toml", "up = \"z\"\nstaged_for = [0, -5, 0]\n[[instance]]\nfile = \"ball.proset\"\n");
    PictureRenderer renderer(device, {folder.file("scene.toml")}, settings);
    // near, so far away that the root suffices, and near again from another side
    const std::array<double, 3> eyes[] = {{1.5, -1.5, 0.5}, {0, -60, 1}, {-1.4, 1.2, -0.6}};
    for (const auto& eye : eyes) {
        LookAt camera;
        camera.eye = eye;
        camera.target = {0, 0, 0};
        const std::string place = std::to_string(eye[0]) + "," + std::to_string(eye[1]) + "," + std::to_string(eye[2]);
        const ExrPicture file =
            viewed("scene.toml --integrator path --spp 2 --lights 2 --size 40x40 --target 0,0,0 --eye " + place);
        expectSame(renderer.render(camera, 40, 40, allLayers()), file);
    }
}

} // namespace
} // namespace pointrt::test
