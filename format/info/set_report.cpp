// SPDX-License-Identifier: Apache-2.0
#include "format/info/set_report.h"

#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "format/base/printable.h"
#include "format/info/set_summary.h"
#include "format/pointio/metadata.h"
#include "format/set/open_tile.h"
#include "format/set/verify_tile.h"

namespace pointrt {

namespace {

using Json = nlohmann::ordered_json;
using Findings = std::vector<std::vector<TileFinding>>; ///< of each tile

std::string findingsText(const TileSet& set, const std::string& folder, const Findings& findings) {
    std::string text;
    for (std::size_t i = 0; i < findings.size(); ++i)
        for (const TileFinding& finding : findings[i]) {
            const std::string number = finding.number > 0 ? fmt::format(" {:04}", finding.number) : "";
            text += fmt::format("{}: finding{}: {}\n", printable(tilePath(folder, set.tiles[i]), std::string::npos),
                                number, printable(finding.text, std::string::npos));
        }
    return text;
}

/// Findings in the JSON form of a single file's, with the tile of each.
std::string findingsJson(const TileSet& set, const std::string& folder, const Findings& findings) {
    Json json = {{"file", folder}, {"findings", Json::array()}};
    for (std::size_t i = 0; i < findings.size(); ++i)
        for (const TileFinding& finding : findings[i])
            json["findings"].push_back(
                {{"tile", set.tiles[i].file}, {"number", finding.number}, {"text", finding.text}});
    return dumpJson(json, false) + "\n";
}

} // namespace

int printSet(const std::string& folder, bool json) {
    const TileSet set = readTileSet(folder);
    const SetSummary summary = summarizeSet(set, folder);
    const std::string text = json ? setSummaryJson(summary, set) : setSummaryText(folder, summary, set);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

int verifySet(const std::string& folder, bool json, bool quiet) {
    const TileSet set = readTileSet(folder);
    Findings findings(set.tiles.size());
    forAll(findings.size(), [&](std::size_t i) { findings[i] = verifyTile(set, folder, i); });
    std::size_t count = 0;
    for (const auto& each : findings) count += each.size();
    std::string text = json ? findingsJson(set, folder, findings) : findingsText(set, folder, findings);
    if (!json && count == 0 && !quiet)
        text = fmt::format("{}: {} tiles, no findings\n", printable(folder, std::string::npos), set.tiles.size());
    std::fwrite(text.data(), 1, text.size(), stdout);
    if (count == 0) return 0;
    throw Error(ExitCode::kBadInput, fmt::format("{}: {} finding{}", folder, count, count == 1 ? "" : "s"));
}

} // namespace pointrt
