// SPDX-License-Identifier: Apache-2.0
#include "format/pro/checks.h"

namespace pointrt::format {

namespace {

/// Length in bytes of the UTF-8 sequence at the start of text (RFC 3629), 0 if invalid.
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const unsigned second = byte(1);
    const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
    const bool surrogate = lead == 0xED && second > 0x9F;
    const bool past_last = lead == 0xF4 && second > 0x8F;
    return overlong || surrogate || past_last ? 0 : length;
}

} // namespace

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = sequenceLength(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

void checkContent(const pro_info& info, const Content& content, Level level, Findings& findings) {
    const pro_view& view = content.view;
    const bool tree = view.nodes && checkTree(info, view, findings);
    if (findings.stopped()) return;
    const bool leaves = view.leaves && checkLeaves(info, view, findings);
    if (findings.stopped()) return;
    const bool refs = view.refs && checkRefs(info, view, findings);
    if (findings.stopped()) return;
    const bool splats = view.splats && checkSplats(info, view, findings);
    if (findings.stopped()) return;
    if (view.materials) checkMaterials(info, view, findings);
    if (findings.stopped()) return;
    if (view.order) checkOrder(info, view, level, findings);
    if (findings.stopped()) return;
    if (isComplete(content.index)) checkIndex(info, content.index, findings);
    if (findings.stopped()) return;
    if (isComplete(content.gaussians)) checkGaussians(info, content.gaussians, level, findings);
    if (findings.stopped()) return;
    if (content.world.sensors) checkSensors(content.world, findings);
    if (level != Level::kVerify) return;
    if (leaves && refs) checkRefsOfLeaves(info, view, findings);
    if (tree && leaves && splats) checkCentres(info, view, findings);
    checkAttributeValues(info, content, findings);
    if (splats) checkSamplingSections(info, content, findings);
    if (view.metadata_bytes > 0 && !isUtf8({view.metadata, view.metadata_bytes}))
        findings.add(Finding::kMetadataUtf8, "META is not UTF-8");
}

} // namespace pointrt::format
