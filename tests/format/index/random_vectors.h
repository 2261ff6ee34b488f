// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "runtime/util/vec.h"

namespace pointrt::test {

class RandomVectors {
public:
    explicit RandomVectors(unsigned seed) : engine_(seed) {}

    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
    /// Uniform on the unit sphere.
    Vec3 direction() {
        std::normal_distribution<double> gauss;
        return normalize({gauss(engine_), gauss(engine_), gauss(engine_)});
    }
    /// Uniform in the cube of edge 1 around the origin.
    Vec3 point() { return {uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.5, 0.5)}; }

private:
    std::mt19937 engine_;
};

} // namespace pointrt::test
