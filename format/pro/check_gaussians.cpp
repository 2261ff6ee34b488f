// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "format/base/parallel.h"
#include "format/pro/checks.h"
#include "format/pro/group_scan.h"

namespace pointrt::format {

namespace {

/// Sums of products stay finite in float.
constexpr float kLargestColor = 1e30f;

/// Numbers in a block, the unit of work of a thread.
constexpr std::size_t kTalliedBlock = std::size_t{1} << 20;

/// False for NaN.
bool isWithin(float value, float low, float high) { return value >= low && value <= high; }

void checkDeviations(const pro_gaussians& gaussians, Findings& findings) {
    const float low = gaussians.deviation_low, step = gaussians.deviation_step;
    const float high = low + static_cast<float>(PRO_DEVIATION_CODE_MAX) * step;
    if (!isWithin(low, PRO_DEVIATION_LOG2_MIN, PRO_DEVIATION_LOW_MAX) || !(step > 0 && step <= 1) ||
        !(high <= PRO_DEVIATION_LOG2_MAX))
        findings.add(Finding::kGaussianCoding, "deviations from 2^%g by steps of 2^%g are out of range", double{low},
                     double{step});
}

void checkColors(const pro_gaussians& gaussians, Findings& findings) {
    if (!isWithin(gaussians.color_low, -kLargestColor, kLargestColor) ||
        !isWithin(gaussians.color_step, 0, kLargestColor))
        findings.add(Finding::kGaussianCoding, "colours of Gaussians from %g by steps of %g are out of range",
                     double{gaussians.color_low}, double{gaussians.color_step});
    for (std::uint32_t degree = 1; degree <= PRO_HARMONICS_DEGREE_MAX; ++degree)
        if (!isWithin(gaussians.harmonic_max[degree - 1], 0, degree <= gaussians.degree ? kLargestColor : 0))
            findings.add(Finding::kGaussianCoding, "largest harmonic %g of degree %u is out of range",
                         double{gaussians.harmonic_max[degree - 1]}, degree);
}

/// The first entry of a node's list; for node_count the end of GLST.
std::uint32_t listStart(const pro_gaussians& gaussians, std::size_t node) {
    return node < gaussians.node_count ? gaussians.nodes[node * PRO_GAUSSIAN_NODE_WORDS + PRO_GAUSSIAN_NODE_FIRST]
                                       : gaussians.list_count;
}

ChildGroup childrenOf(const pro_gaussians& gaussians, std::size_t node) {
    const std::uint32_t group = gaussians.nodes[node * PRO_GAUSSIAN_NODE_WORDS + PRO_GAUSSIAN_NODE_CHILDREN];
    return group == 0 ? ChildGroup{} : group;
}

void checkRoot(const pro_gaussians& gaussians, Findings& findings) {
    Tally others;
    for (std::size_t node = 1; node < PRO_GROUP_SIZE; ++node)
        if (childrenOf(gaussians, node) || listStart(gaussians, node) != listStart(gaussians, node + 1))
            others.hit(node);
    others.addTo(findings, Finding::kGaussianRootGroup, "Gaussian node", "group 0 holds more than the root");
}

void checkNodes(const pro_gaussians& gaussians, Findings& findings) {
    const GroupScan scan = scanGroups(gaussians.node_count / PRO_GROUP_SIZE,
                                      [&](std::size_t node, std::uint32_t) { return childrenOf(gaussians, node); });
    scan.group_number.addTo(findings, Finding::kGaussianGroupNumber, "Gaussian node", "does not name the next group");
    scan.orphan.addTo(findings, Finding::kGaussianGroupWithoutParent, "Gaussian group", "no earlier node names it");
    if (scan.orphan.places == 0 && (scan.inner + 1) * PRO_GROUP_SIZE != gaussians.node_count)
        findings.add(Finding::kGaussianGroupCount, "%llu nodes with children do not fit %u Gaussian nodes",
                     static_cast<unsigned long long>(scan.inner), gaussians.node_count);
    if (scan.depth > PRO_MAX_DEPTH)
        findings.add(Finding::kGaussianDepth, "the octree of Gaussians has depth %u, more than %u", scan.depth,
                     PRO_MAX_DEPTH);
}

void checkLists(const pro_gaussians& gaussians, Findings& findings) {
    Tally lists;
    if (listStart(gaussians, 0) != 0) lists.hit(0);
    for (std::size_t node = 0; node < gaussians.node_count; ++node)
        if (listStart(gaussians, node) > listStart(gaussians, node + 1)) lists.hit(node);
    lists.addTo(findings, Finding::kGaussianLists, "Gaussian node",
                "its list does not follow that of the previous node");
}

/// Counts the numbers that are wrong, in parallel.
template <typename Number, typename IsWrong>
Tally tallyOf(const Number* numbers, std::size_t count, const IsWrong& isWrong) {
    std::vector<Tally> blocks((count + kTalliedBlock - 1) / kTalliedBlock);
    forAll(blocks.size(), [&](std::size_t block) {
        const std::size_t end = std::min(count, (block + 1) * kTalliedBlock);
        for (std::size_t i = block * kTalliedBlock; i < end; ++i)
            if (isWrong(numbers[i])) blocks[block].hit(i);
    });
    Tally all;
    for (const Tally& block : blocks) all.join(block);
    return all;
}

void checkEntries(const pro_info& info, const pro_gaussians& gaussians, Findings& findings) {
    tallyOf(gaussians.lists, gaussians.list_count, [&](std::uint32_t index) {
        return index >= info.splat_count;
    }).addTo(findings, Finding::kGaussianIndex, "listed Gaussian", "out of range");
}

void checkHarmonics(const pro_info& info, const pro_gaussians& gaussians, Findings& findings) {
    if (!gaussians.harmonics) return;
    const std::size_t count = std::size_t{info.splat_count} * 3 * pro_harmonic_count(gaussians.degree);
    tallyOf(gaussians.harmonics, count, [](std::int8_t code) {
        return code == PRO_HARMONIC_INVALID;
    }).addTo(findings, Finding::kHarmonicCode, "harmonic", "its code is -128");
}

/// False for NaN, infinity and rotations that are not of unit length.
bool isExact(const pro_exact_gaussian& exact) {
    constexpr double kUnitTolerance = 1e-5; // some hundred times the rounding error of a unit quaternion of floats
    const float least = std::exp2(PRO_DEVIATION_LOG2_MIN), most = std::exp2(PRO_DEVIATION_LOG2_MAX);
    double squared = 0;
    for (const float each : exact.rotation) squared += double{each} * each;
    return std::fabs(squared - 1) <= kUnitTolerance && isWithin(exact.opacity, 0, 1) &&
           std::all_of(exact.deviation, exact.deviation + 3, [&](float each) { return isWithin(each, least, most); });
}

void checkExact(const pro_info& info, const pro_gaussians& gaussians, Findings& findings) {
    Tally order, values;
    for (std::size_t i = 0; i < gaussians.exact_count; ++i) {
        const pro_exact_gaussian& each = gaussians.exact[i];
        if (each.index >= info.splat_count || (i > 0 && each.index <= gaussians.exact[i - 1].index)) order.hit(i);
        if (!isExact(each)) values.hit(i);
    }
    order.addTo(findings, Finding::kExactIndex, "exact Gaussian", "out of range, or not above the one before");
    values.addTo(findings, Finding::kExactValue, "exact Gaussian", "its parameters are out of range");
}

/// A Gaussian that two nodes on one path list would count twice along a ray, so all nodes that list it must have the
/// same depth.
void checkListedOnce(const pro_info& info, const pro_gaussians& gaussians, Findings& findings) {
    constexpr std::uint8_t kUnlisted = 0xFF;
    std::vector<std::uint8_t> depths(info.splat_count, kUnlisted);
    std::vector<std::uint32_t> last_node(info.splat_count);
    Tally twice;
    scanGroups(gaussians.node_count / PRO_GROUP_SIZE, [&](std::size_t node, std::uint32_t depth) {
        for (std::uint32_t i = listStart(gaussians, node); i < listStart(gaussians, node + 1); ++i) {
            const std::uint32_t index = gaussians.lists[i];
            const bool listed = depths[index] != kUnlisted;
            if (listed && (depths[index] != depth || last_node[index] == node)) twice.hit(node);
            depths[index] = static_cast<std::uint8_t>(depth);
            last_node[index] = static_cast<std::uint32_t>(node);
        }
        return childrenOf(gaussians, node);
    });
    twice.addTo(findings, Finding::kGaussianTwice, "Gaussian node",
                "lists a Gaussian twice, or one that a node of another depth lists");
}

} // namespace

bool checkGaussianCoding(const pro_gaussians& gaussians, Findings& findings) {
    const std::size_t before = findings.count();
    if (gaussians.degree > PRO_HARMONICS_DEGREE_MAX)
        findings.add(Finding::kGaussianCoding, "harmonics of degree %u, more than %u", gaussians.degree,
                     PRO_HARMONICS_DEGREE_MAX);
    checkDeviations(gaussians, findings);
    checkColors(gaussians, findings);
    if ((gaussians.degree > 0) != (gaussians.harmonics != nullptr))
        findings.add(Finding::kGaussiansIncomplete, "harmonics of degree %u %s section GHRM", gaussians.degree,
                     gaussians.harmonics ? "with" : "without");
    if (gaussians.node_count == 0 || gaussians.node_count % PRO_GROUP_SIZE != 0)
        findings.add(Finding::kGaussianGroupCount, "%u Gaussian nodes, not a multiple of 8 above 0",
                     gaussians.node_count);
    return findings.count() == before;
}

void checkGaussians(const pro_info& info, const pro_gaussians& gaussians, Level level, Findings& findings) {
    const std::size_t before = findings.count();
    checkRoot(gaussians, findings);
    checkNodes(gaussians, findings);
    checkLists(gaussians, findings);
    checkEntries(info, gaussians, findings);
    if (level == Level::kVerify && findings.count() == before) checkListedOnce(info, gaussians, findings);
    checkHarmonics(info, gaussians, findings);
    checkExact(info, gaussians, findings);
}

} // namespace pointrt::format
