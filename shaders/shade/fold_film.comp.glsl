// SPDX-License-Identifier: Apache-2.0
// Adds the sums of a batch that is complete to those of the earlier batches, and starts the next one. It is a separate
// program, which runs once in FILM_BATCH samples: in the camera pass, lavapipe would mask its stores in every sample
// but still wait for them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/film.glsl"

void main() {
    uint path = balancedLane();
    if (!isPixel(path)) return;
    PixelSums batch = loadSums(path, 0u), earlier = loadSums(path, FILM_LAYERS);
    if (push.sample_index == FILM_BATCH) earlier = kNoSums; // its memory was never written
    storeSums(path, FILM_LAYERS, addBatch(earlier, batch));
    storeSums(path, 0u, nextBatch(batch));
}
