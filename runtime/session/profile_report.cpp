// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/profile_report.h"

#include <algorithm>
#include <cstdio>

#include "runtime/session/report.h"

namespace pointrt {
namespace {

/// Whether the profile has the processor time of each pass.
bool hasCpuTime(const PassProfile& profile) { return profile.clock.counters.handle == VK_NULL_HANDLE; }
bool hasDeviceTime(const PassProfile& profile) { return profile.clock.timer.pool != VK_NULL_HANDLE; }

/// The time of a pass: the device's time only, if the pass is timed within a submission.
double timeOf(const PassProfile& profile, const PassTally& pass) {
    return hasCpuTime(profile) ? pass.host_ms : pass.device_ms;
}

std::string passJson(const PassProfile& profile, const PassTally& pass) {
    return "{\"pass\": " + jsonText(pass.name) + ", \"runs\": " + std::to_string(pass.runs) +
           ", \"device_ms\": " + (hasDeviceTime(profile) ? jsonNumber(pass.device_ms) : "null") +
           ", \"host_ms\": " + jsonNumber(pass.host_ms) +
           ", \"cpu_ms\": " + (hasCpuTime(profile) ? jsonNumber(pass.cpu_ms) : "null") +
           ", \"lanes_in\": " + std::to_string(pass.lanes_in) + ", \"lanes_out\": " + std::to_string(pass.lanes_out) +
           ", \"bytes\": " + std::to_string(pass.bytes) + "}";
}

std::string hostJson(const HostTally& span) {
    return "{\"what\": " + jsonText(span.name) + ", \"ms\": " + jsonNumber(span.ms) + "}";
}

/// A JSON array with one entry per line.
template <typename Entries, typename ToJson>
std::string listed(const Entries& entries, const ToJson& toJson) {
    std::string json = "[";
    for (const auto& each : entries) json += (json.size() > 1 ? ",\n    " : "\n    ") + toJson(each);
    return json + "]";
}

template <typename... Values>
std::string line(const char* format, Values... values) {
    char text[160]; // longer than any line of the table
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

double millions(std::uint64_t count) { return 1e-6 * static_cast<double>(count); }

std::string passLine(const PassProfile& profile, const PassTally& pass) {
    const std::string device = hasDeviceTime(profile) ? line("%10.1f", pass.device_ms) : "         -";
    const std::string cpu = hasCpuTime(profile) ? line("%10.1f", pass.cpu_ms) : "         -";
    const bool over_lists = pass.lanes_in > pass.runs; // lanes are queue entries
    const std::string lane_ns =
        over_lists ? line("%9.1f", 1e6 * timeOf(profile, pass) / static_cast<double>(pass.lanes_in)) : "        -";
    return line("  %-34s %7llu %s %10.1f %s %10.3f %10.3f %9.1f %s\n", pass.name.c_str(),
                static_cast<unsigned long long>(pass.runs), device.c_str(), pass.host_ms, cpu.c_str(),
                millions(pass.lanes_in), millions(pass.lanes_out), millions(pass.bytes), lane_ns.c_str());
}

std::string hostLine(const char* name, double ms) { return line("  %-34s %29.1f\n", name, ms); }

} // namespace

std::string profileJson(const PassProfile& profile) {
    return "{\"frames\": " + std::to_string(profile.frames) + ", \"frames_ms\": " + jsonNumber(profile.frames_ms) +
           ",\n   \"passes\": " +
           listed(profile.passes, [&](const PassTally& pass) { return passJson(profile, pass); }) +
           ",\n   \"host\": " + listed(profile.host, hostJson) +
           ",\n   \"unaccounted_ms\": " + jsonNumber(unaccountedMilliseconds(profile)) + "}";
}

std::string profileTable(const PassProfile& profile) {
    std::vector<PassTally> passes = profile.passes;
    std::stable_sort(passes.begin(), passes.end(),
                     [&](const PassTally& a, const PassTally& b) { return timeOf(profile, a) > timeOf(profile, b); });
    std::string table = line("  %-34s %7s %10s %10s %10s %10s %10s %9s %9s\n", "pass", "runs", "device ms", "host ms",
                             "cpu ms", "M lanes in", "M out", "MB", "ns/lane");
    for (const PassTally& pass : passes) table += passLine(profile, pass);
    for (const HostTally& span : profile.host) table += hostLine(span.name.c_str(), span.ms);
    table += hostLine("unaccounted for", unaccountedMilliseconds(profile));
    return table +
           line("  %-34s %7llu %21.1f\n", "frames", static_cast<unsigned long long>(profile.frames), profile.frames_ms);
}

} // namespace pointrt
