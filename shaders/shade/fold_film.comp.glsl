// SPDX-License-Identifier: Apache-2.0
// Adds the sums of a complete batch to those of the earlier batches, and starts the next batch. A separate program, run
// once in FILM_BATCH samples: as part of the camera pass, its stores would take lavapipe time in every sample, although
// masked.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/film.glsl"

void main() {
    uint path = balancedLane();
    if (!isPixel(path)) return;
    PixelSums batch = loadSums(path, 0u), earlier = loadSums(path, FILM_LAYERS);
    if (push.sample_index == FILM_BATCH) earlier = kNoSums; // the memory for earlier batches has not been written yet
    storeSums(path, FILM_LAYERS, addBatch(earlier, batch));
    storeSums(path, 0u, nextBatch(batch));
}
