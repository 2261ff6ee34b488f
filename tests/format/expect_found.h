// SPDX-License-Identifier: Apache-2.0
// Checks that a wrong value in a valid file is found.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "file_bytes.h"

namespace pointrt::test {

/// Changes one value of a file. Expects that pro_verify reports the finding, and that pro_open refuses the file with
/// that finding or, if opens, opens it.
template <typename T>
void expectFound(const Bytes& sound, std::size_t offset, T value, std::uint32_t finding, bool opens = false) {
    Bytes bytes = sound;
    storeAt(bytes, offset, value);
    fixChecksums(bytes);
    const OpenResult opened = openCopy(bytes);
    EXPECT_EQ(opened.result == PRO_OK, opens) << finding << " " << opened.message.text;
    EXPECT_EQ(opened.message.finding, opens ? 0 : finding) << opened.message.text;
    const auto findings = findingsOf(bytes);
    EXPECT_NE(std::find(findings.begin(), findings.end(), finding), findings.end()) << finding;
}

} // namespace pointrt::test
