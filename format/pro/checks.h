// SPDX-License-Identifier: Apache-2.0
// The checks on what a file says, apart from how it is laid out: the same for reading and before writing.
#pragma once

#include <string_view>

#include "format/pro/findings.h"
#include "format/pro/header.h"

namespace pointrt::format {

/// kOpen makes every index reachable through a view safe. kVerify adds what only a correct bake needs. kTrace is kOpen
/// for what PRO_OPEN_TRACE leaves.
enum class Level { kTrace, kOpen, kVerify };

/// Header values: counts, finite numbers, ranges.
void checkRanges(const pro_info& info, Findings& findings);

/// NODE: true when the words are one octree over all leaves. Needs view.nodes.
bool checkTree(const pro_info& info, const pro_view& view, Findings& findings);

/// LEAF: true when members and references are partitioned. Needs view.leaves.
bool checkLeaves(const pro_info& info, const pro_view& view, Findings& findings);

/// REFS: indices in range. Needs view.refs.
bool checkRefs(const pro_info& info, const pro_view& view, Findings& findings);

/// REFS against members. Needs all lists and a file that passed checkLeaves and checkRefs.
void checkRefsOfLeaves(const pro_info& info, const pro_view& view, Findings& findings);

/// SPLT: reserved bits, materials, radii. Needs view.splats.
bool checkSplats(const pro_info& info, const pro_view& view, Findings& findings);

/// Centres in their leaves' cells and in the bounds. Needs a file that passed all checks of kOpen.
void checkCentres(const pro_info& info, const pro_view& view, Findings& findings);

/// MATL: ranges, reserved floats. Needs view.materials.
void checkMaterials(const pro_info& info, const pro_view& view, Findings& findings);

/// ORDR: no input index twice. Indices of splat_count and above are compared only at kVerify. Needs view.order.
void checkOrder(const pro_info& info, const pro_view& view, Level level, Findings& findings);

/// META.
bool isUtf8(std::string_view text);

/// The index's frame and counts, apart from what they count. Its pointers are not looked at.
bool checkIndexFrame(const pro_index& index, Findings& findings);

/// ENTR to BLDS: every word that a tracer follows leads to one cell, skips go on, lists are in range. Needs a frame
/// that passed checkIndexFrame and all pointers.
void checkIndex(const pro_info& info, const pro_index& index, Findings& findings);

/// PRO_OFF_UP and what follows it in the header.
void checkWorld(const pro_world& world, Findings& findings);

/// PRO_OFF_INPUT_COUNT and what follows it in the header.
void checkSampling(const pro_info& info, const pro_sampling& sampling, Findings& findings);

/// The same against ORDR and NOIS. Needs a header that passed checkSampling, and splats that passed.
void checkSampled(const pro_info& info, const Content& content, Findings& findings);

/// SENS. Needs world.sensors.
void checkSensors(const pro_world& world, Findings& findings);

/// One record of ATTD, apart from its values. Needs content.attribute_records.
bool checkAttributeRecord(const Content& content, std::size_t i, Findings& findings);

/// No two records of one name. Needs records that passed.
void checkAttributeNames(const Content& content, Findings& findings);

/// Ranges of the records against the values. Needs records that passed.
void checkAttributeValues(const pro_info& info, const Content& content, Findings& findings);

/// All of the above that the pointers in content allow; null sections, and an index in parts, are left out. The frame
/// of a whole one must have passed checkIndexFrame.
void checkContent(const pro_info& info, const Content& content, Level level, Findings& findings);

} // namespace pointrt::format
