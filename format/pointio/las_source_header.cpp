// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_source_header.h"

#include <exception>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "format/base/json_integer.h"
#include "format/pointio/base64.h"
#include "format/pointio/bytes.h"

namespace pointrt {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = std::size_t{1} << 20;

/// Whether a record describes the layout of the file.
bool isAboutBytes(const LasVlr& vlr) {
    constexpr std::uint16_t kLaxRecord = 30; // spatial index of LAStools
    constexpr std::uint16_t kFirstWaveform = 100, kLastWaveform = 354;
    if (vlr.user_id == kLaszipUser || vlr.user_id == kCopcUser) return true;
    if (vlr.user_id == "LAStools") return vlr.record_id == kLaxRecord;
    const bool waveform =
        vlr.record_id == kWaveformDataRecord || (vlr.record_id >= kFirstWaveform && vlr.record_id <= kLastWaveform);
    return vlr.user_id == kLasSpecUser && waveform;
}

Json recordJson(const LasVlr& vlr) {
    return {{"user_id", vlr.user_id},
            {"record_id", vlr.record_id},
            {"description", vlr.description},
            {"extended", vlr.extended},
            {"data", toBase64(vlr.data)}};
}

LasSource::Record recordOf(const Json& json) {
    LasSource::Record record;
    record.vlr.user_id = json.at("user_id").get<std::string>();
    record.vlr.record_id = jsonInteger<std::uint16_t>(json.at("record_id"));
    record.vlr.description = json.at("description").get<std::string>();
    record.vlr.extended = json.at("extended").get<bool>();
    record.data = fromBase64(json.at("data").get<std::string>()).value();
    return record;
}

} // namespace

std::string lasSourceHeader(LasFile& file, bool moved) {
    const LasHeader& header = file.header;
    Json json = {{"format", "las"},         {"point_format", header.point_format},
                 {"packed", header.packed}, {"scale", header.scale},
                 {"offset", header.offset}, {"header", toBase64(file.bytes.substr(0, header.header_bytes))},
                 {"vlrs", Json::array()}};
    std::size_t bytes = 0, left_out = 0;
    for (const LasVlr& vlr : file.vlrs) {
        if (isAboutBytes(vlr) || (moved && vlr.user_id == kLasCrsUser)) continue;
        if (vlr.data.size() > kMostBytes - bytes) {
            ++left_out;
            continue;
        }
        bytes += vlr.data.size();
        json["vlrs"].push_back(recordJson(vlr));
    }
    if (left_out > 0)
        file.notes.push_back(fmt::format("has {} records too long to keep; exports will lack them", left_out));
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<LasSource> parseLasSource(std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    try {
        if (json.at("format") != "las") return std::nullopt;
        LasSource source;
        source.header_bytes = fromBase64(json.at("header").get<std::string>()).value();
        source.header = readLasHeader(source.header_bytes);
        for (const Json& record : json.at("vlrs")) source.records.push_back(recordOf(record));
        return source;
    } catch (const std::exception&) { // in JSON, base64 or the header
        return std::nullopt;
    }
}

} // namespace pointrt
