// SPDX-License-Identifier: GPL-3.0-or-later
// Octrees of points in a folder, described by a JSON file: Entwine's EPT and Potree 2.
#pragma once

#include "preprocess/ingest/sink.h"

namespace pointrt {

inline constexpr std::string_view kEptMeta = "ept.json", kPotreeMeta = "metadata.json";

bool isEptMeta(std::string_view text);
bool isPotreeMeta(std::string_view text);

/// Whether to read a node: it is no finer than the sink's level, and its box, in the file's coordinates, overlaps the
/// bounds of the sink's filter.
bool selectsNode(const Sink& sink, int level, const Eigen::AlignedBox3d& box);

/// The eighth of a box: bit 2 of child is x, bit 1 y, bit 0 z.
Eigen::AlignedBox3d childBox(const Eigen::AlignedBox3d& box, unsigned child);

} // namespace pointrt
