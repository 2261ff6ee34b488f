// SPDX-License-Identifier: GPL-3.0-or-later
// Messages of ROS, whatever container holds them.
#pragma once

#include "preprocess/input/points/byte_cursor.h"

namespace pointrt {

/// How a message is written: by ROS 1, without padding, or by ROS 2, as CDR.
enum class RosEncoding { kRos1, kCdr };

/// Takes the members of a message. CDR aligns numbers to their size, counted from the end of its header of 4 bytes.
struct RosMessage {
    ByteCursor bytes;
    RosEncoding encoding;
    std::size_t size;

    RosMessage(const InputFile& input, RosEncoding how, std::string_view message)
        : bytes{input, message}, encoding(how), size(message.size()) {
        if (how != RosEncoding::kCdr) return;
        const std::string_view header = bytes.takeBytes(4);
        if (header[1] != '\1' && header[1] != '\0') refuse(input, "has messages in an encoding other than plain CDR");
        if (header[1] == '\0') refuse(input, "has big-endian messages, which this build does not read");
        size -= 4;
    }
    template <typename Value>
    Value take() {
        const std::size_t done = size - bytes.rest.size();
        if (encoding == RosEncoding::kCdr) bytes.takeBytes((sizeof(Value) - done % sizeof(Value)) % sizeof(Value));
        return bytes.take<Value>();
    }
    std::string_view text() {
        std::string_view text = bytes.takeBytes(take<std::uint32_t>());
        while (!text.empty() && text.back() == '\0') text.remove_suffix(1); // CDR ends texts with a 0
        return text;
    }
};

/// Longer frame names are useless, and each takes memory, which compressed recordings can request cheaply.
inline constexpr std::size_t kLongestFrame = 256;

/// std_msgs/Header: the time and frame of a message.
struct RosHeader {
    std::int64_t time_ns = 0;
    std::string frame; ///< without the slash that old versions of tf put before it

    RosHeader() = default;
    explicit RosHeader(RosMessage& message) {
        if (message.encoding == RosEncoding::kRos1) message.take<std::uint32_t>(); // seq
        const std::int64_t seconds = message.take<std::uint32_t>();
        time_ns = 1'000'000'000 * seconds + message.take<std::uint32_t>();
        frame = withoutSlash(message.text());
    }
    static std::string withoutSlash(std::string_view frame) {
        return std::string(frame.starts_with('/') ? frame.substr(1) : frame);
    }
};

} // namespace pointrt
