// SPDX-License-Identifier: GPL-3.0-or-later
// MCAP recordings with clouds of ROS 1 or 2: https://mcap.dev/spec
#include <unordered_map>

#include "preprocess/input/points/byte_cursor.h"
#include "preprocess/input/points/ros_clouds.h"
#include "preprocess/input/points/unpack_chunk.h"

namespace pointrt {
namespace {

constexpr std::string_view kMcapMark = "\x89MCAP0\r\n";

enum McapRecord : std::uint8_t { kFooter = 2, kSchema = 3, kChannel = 4, kMessage = 5, kChunk = 6, kDataEnd = 15 };

struct McapChannel {
    std::string topic;
    RosEncoding encoding = RosEncoding::kCdr;
    bool is_wanted = false;
};

class McapReader {
public:
    McapReader(const InputFile& input, Sink& sink) : input_(input), clouds_(input, sink) {}

    void read() {
        if (mayHavePoses()) {
            clouds_.beginPoses();
            readRecords(records(), false);
        }
        clouds_.beginClouds();
        readRecords(records(), false);
        clouds_.finish();
    }

private:
    std::string_view records() const { return input_.bytes.substr(kMcapMark.size()); }

    /// Whether the summary has a schema with poses. A recording without a summary may have any.
    bool mayHavePoses() const {
        constexpr std::size_t kFooterBytes = 8 + 8 + 4, kEndBytes = kFooterBytes + 8; // footer, mark
        if (input_.bytes.size() < kMcapMark.size() + kEndBytes || !input_.bytes.ends_with(kMcapMark)) return true;
        ByteCursor footer{input_, input_.bytes.substr(input_.bytes.size() - kEndBytes)};
        const auto summary = footer.take<std::uint64_t>();
        if (summary < kMcapMark.size() || summary >= input_.bytes.size()) return true;
        ByteCursor cursor{input_, input_.bytes.substr(summary)};
        bool has_schemas = false;
        while (cursor.rest.size() > 1 + 8) { // kind and length
            const auto kind = cursor.take<std::uint8_t>();
            const auto size = cursor.take<std::uint64_t>();
            if (kind == kFooter || size > cursor.rest.size()) break;
            ByteCursor record{input_, cursor.takeBytes(size)};
            if (kind != kSchema) continue;
            record.take<std::uint16_t>(); // its number
            if (RosPoses::hasPoses(record.takeText())) return true;
            has_schemas = true;
        }
        return !has_schemas;
    }

    void readRecords(std::string_view bytes, bool in_chunk) {
        ByteCursor cursor{input_, bytes};
        while (!cursor.rest.empty() && !(cursor.rest == kMcapMark && !in_chunk)) {
            if (!in_chunk) clouds_.reportLeft(cursor.rest.size());
            const auto kind = cursor.take<std::uint8_t>();
            const auto size = cursor.take<std::uint64_t>();
            if (size > cursor.rest.size()) return clouds_.cutShort();
            ByteCursor record{input_, cursor.takeBytes(size)};
            if (kind == kDataEnd || kind == kFooter) return; // the rest of the file repeats schemas and channels
            readRecord(kind, record, in_chunk);
        }
    }

    void readRecord(std::uint8_t kind, ByteCursor& record, bool in_chunk) {
        if (kind == kSchema) readSchema(record);
        if (kind == kChannel) readChannel(record);
        if (kind == kMessage) readMessage(record);
        if (kind == kChunk && !in_chunk) readChunk(record);
    }

    void readSchema(ByteCursor& record) {
        const auto id = record.take<std::uint16_t>();
        type_of_schema_[id] = record.takeText();
    }

    void readChannel(ByteCursor& record) {
        const auto id = record.take<std::uint16_t>(), schema = record.take<std::uint16_t>();
        McapChannel& channel = channels_[id];
        channel.topic = record.takeText();
        const std::string_view encoding = record.takeText();
        const std::string& type = type_of_schema_[schema];
        channel.encoding = encoding == "ros1" ? RosEncoding::kRos1 : RosEncoding::kCdr;
        channel.is_wanted = clouds_.wants(type) && (encoding == "ros1" || encoding == "cdr");
        clouds_.addTopic(channel.topic, type);
    }

    void readMessage(ByteCursor& record) {
        const auto id = record.take<std::uint16_t>();
        record.takeBytes(4 + 8 + 8); // sequence, times of logging and publishing
        const auto channel = channels_.find(id);
        if (channel == channels_.end() || !channel->second.is_wanted) return;
        clouds_.add(channel->second.topic, channel->second.encoding, record.rest);
    }

    void readChunk(ByteCursor& record) {
        record.takeBytes(8 + 8); // times of the first and the last message
        const auto size = record.take<std::uint64_t>();
        record.takeBytes(4); // checksum
        const std::string_view compression = record.takeText();
        const std::string_view packed = record.takeBytes(record.take<std::uint64_t>());
        if (compression.empty()) return readRecords(packed, true);
        readRecords(unpackChunk(input_, compression, packed, size), true);
    }

    const InputFile& input_;
    RosClouds clouds_;
    std::unordered_map<std::uint16_t, std::string> type_of_schema_;
    std::unordered_map<std::uint16_t, McapChannel> channels_;
};

bool isMcap(std::string_view bytes) { return bytes.starts_with(kMcapMark); }

void readMcap(const InputFile& input, Sink& sink) {
    if (!isMcap(input.bytes)) refuse(input, "does not start as MCAP files do");
    McapReader(input, sink).read();
}

} // namespace

const FormatReader readers::kMcap{.isStart = isMcap, .read = readMcap, .readsInBatches = alwaysInBatches};

} // namespace pointrt
