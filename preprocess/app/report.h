// SPDX-License-Identifier: GPL-3.0-or-later
// The statistics of a bake, as JSON and as one line for the user.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "preprocess/app/options.h"
#include "preprocess/cloud/cloud.h"
#include "preprocess/input/read.h"
#include "preprocess/octree/write.h"

namespace pointrt {

struct BakeReport {
    std::uint64_t input_points = 0, points_non_finite = 0, points_unused = 0, points_filtered = 0;
    std::uint64_t points_no_data = 0, points_withheld = 0;
    std::uint64_t gaussians = 0;      ///< splats that are Gaussians: all or none
    std::uint64_t points_sampled = 0; ///< on mesh faces; input_points then counts these, not the vertices
    std::vector<Note> notes;          ///< from reading
    std::vector<FileReport> files;
    WorldFrame world;
    std::string up_from;   ///< "option", "file", "data", "format" (its convention) or "guess"; "" if unknown
    std::string up_reason; ///< FoundUp::reason
    std::vector<Scan> scans;
    std::string source_header;         ///< Cloud::source_header
    std::vector<Attribute> attributes; ///< names and types only
    SurfaceReport surface;
    std::uint64_t merged = 0; ///< splats at one quantised position
    std::uint64_t splats = 0;
    std::uint64_t filled = 0;              ///< splats that fill gaps between points
    std::uint64_t balls = 0;               ///< splats that are balls
    std::uint64_t references_unpruned = 0; ///< members included
    PruneReport pruning;                   ///< zeros without pruning
    double harm_allowed = 0;               ///< --prune-harm
    OctreeCounts octree;                   ///< as written
    std::vector<std::pair<std::string, double>> seconds;
    double seconds_total = 0;
};

/// Writes the report to path ("-" is standard output). Throws Error (kCannotWrite).
void writeStats(const BakeReport& report, const std::string& path);

/// One line for the user about the input.
std::string noteLine(const Note& note);

/// Provenance for META: tool, settings, sources, world frame. Independent of the run and the number of threads.
std::string metadataJson(const BakeOptions& options, const BakeReport& report);

/// One line for the user about a file that was read.
std::string fileLine(const FileReport& file);
/// ", 0.05 s, 1.6 million points/s", to append to fileLine.
std::string rateText(const FileReport& file);

} // namespace pointrt
