// SPDX-License-Identifier: Apache-2.0
// Checks of the content of a file, not of its layout; shared by the reader and the writer.
#pragma once

#include <string_view>

#include "format/pro/findings.h"
#include "format/pro/sections.h"

namespace pointrt::format {

/// kOpen: every index reachable through a view is in range. kTrace: the same for what PRO_OPEN_TRACE reads. kVerify
/// adds checks of correctness that safety does not need.
enum class Level { kTrace, kOpen, kVerify };

/// Header fields: counts, finite numbers, ranges.
void checkRanges(const pro_info& info, Findings& findings);

/// NODE: true if the words are one octree over all leaves. Needs view.nodes.
bool checkTree(const pro_info& info, const pro_view& view, Findings& findings);

/// LEAF: true if the leaves partition members and references. Needs view.leaves.
bool checkLeaves(const pro_info& info, const pro_view& view, Findings& findings);

/// REFS: indices in range. Needs view.refs.
bool checkRefs(const pro_info& info, const pro_view& view, Findings& findings);

/// No leaf refers to its own members or to a splat twice. Needs all lists, and checkLeaves and checkRefs to have
/// passed.
void checkRefsOfLeaves(const pro_info& info, const pro_view& view, Findings& findings);

/// SPLT: reserved bits, materials, radii. Needs view.splats.
bool checkSplats(const pro_info& info, const pro_view& view, Findings& findings);

/// Splat centres lie in the cells of their leaves and in the bounds. Needs all checks of kOpen to have passed.
void checkCentres(const pro_info& info, const pro_view& view, Findings& findings);

/// MATL: ranges, reserved floats. Needs view.materials.
void checkMaterials(const pro_info& info, const pro_view& view, Findings& findings);

/// ORDR: no input index twice. Indices of splat_count and above are compared only at kVerify. Needs view.order.
void checkOrder(const pro_info& info, const pro_view& view, Level level, Findings& findings);

/// Whether META is valid.
bool isUtf8(std::string_view text);

/// The frame and the counts of the index; does not read its sections.
bool checkIndexFrame(const pro_index& index, Findings& findings);

/// ENTR to BLDS: every word that a tracer follows leads to one cell, skips are not 0, lists are in range. Needs all
/// sections, and checkIndexFrame to have passed.
void checkIndex(const pro_info& info, const pro_index& index, Findings& findings);

/// The coding and the counts of the Gaussians, and whether GHRM is there if the degree is not 0; does not read their
/// sections.
bool checkGaussianCoding(const pro_gaussians& gaussians, Findings& findings);

/// GHRM, GNOD, GLST and GEXA: the nodes are one octree, lists, their entries and exact parameters are in range; at
/// kVerify also that no Gaussian is listed twice. Needs all sections, and checkGaussianCoding to have passed.
void checkGaussians(const pro_info& info, const pro_gaussians& gaussians, Level level, Findings& findings);

/// Header fields PRO_OFF_UP and PRO_OFF_METRES.
void checkWorld(const pro_world& world, Findings& findings);

/// Header fields PRO_OFF_INPUT_COUNT, PRO_OFF_FILLED_COUNT and PRO_OFF_NOISE.
void checkSampling(const pro_info& info, const pro_sampling& sampling, Findings& findings);

/// The same fields against ORDR and NOIS. Needs checkSampling and checkSplats to have passed.
void checkSamplingSections(const pro_info& info, const Content& content, Findings& findings);

/// SENS. Needs world.sensors.
void checkSensors(const pro_world& world, Findings& findings);

/// One record of ATTD without its values. Needs content.attribute_records.
bool checkAttributeRecord(const Content& content, std::size_t i, Findings& findings);

/// Names are unique. Needs checkAttributeRecord to have passed.
void checkAttributeNames(const Content& content, Findings& findings);

/// Ranges in ATTD against the values. Needs checkAttributeRecord to have passed.
void checkAttributeValues(const pro_info& info, const Content& content, Findings& findings);

/// Runs the checks above on the sections that content has; skips an incomplete index and incomplete Gaussians. For
/// complete ones checkIndexFrame and checkGaussianCoding must have passed.
void checkContent(const pro_info& info, const Content& content, Level level, Findings& findings);

} // namespace pointrt::format
