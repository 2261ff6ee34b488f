// SPDX-License-Identifier: Apache-2.0
// Gaussians as a .pro, and the results of brute force in double precision for rays through them.
#pragma once

#include <string>
#include <vector>

#include "runtime/util/color.h"
#include "runtime/util/vec.h"
#include "tests/gaussians/oracle.h"

namespace pointrt::test {

/// A .pro of Gaussians for as long as this lives.
struct GaussianFile {
    explicit GaussianFile(const std::vector<OracleGaussian>& gaussians);
    ~GaussianFile();
    GaussianFile(const GaussianFile&) = delete;
    GaussianFile& operator=(const GaussianFile&) = delete;

    std::string path;
    OracleScene scene; ///< as read back from the file, which rounds them
};

/// A ball: standard deviation `sigma` in all directions.
OracleGaussian roundGaussian(const Double3& mean, double sigma, double opacity, const Double3& color);

/// What a ray with a unit direction hits before t_max.
OracleComposite compositeAlong(const OracleScene& scene, Vec3 origin, Vec3 direction,
                               double t_max = std::numeric_limits<double>::infinity());

/// The linear light of a composite in front of a black background, without anything else in between.
Color lightOf(const OracleComposite& composite);
/// The same in front of a surface, whose own light is multiplied by the transmittance and added.
Color lightBefore(const OracleComposite& composite);

} // namespace pointrt::test
