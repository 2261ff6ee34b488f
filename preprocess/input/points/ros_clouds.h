// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds in ROS recordings: messages of type sensor_msgs/PointCloud2, whatever container holds them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "preprocess/ingest/formats.h"

namespace pointrt {

/// How a message is written: by ROS 1, without padding, or by ROS 2, as CDR.
enum class RosEncoding { kRos1, kCdr };

/// Whether a type is PointCloud2, as ROS 1 and ROS 2 spell it.
bool isRosCloud(std::string_view type);

/// Receives the messages of one recording and adds each as a scan.
class RosClouds {
public:
    RosClouds(const InputFile& input, Sink& sink)
        : input_(input), sink_(sink), progress_(std::exchange(sink.progress, nullptr)), release_pages_{input} {}
    ~RosClouds() { sink_.progress = progress_; }
    RosClouds(const RosClouds&) = delete;
    RosClouds& operator=(const RosClouds&) = delete;

    /// Reports how much of the file is read, and releases the memory of that.
    void reportLeft(std::size_t bytes);

    /// A topic of the recording, with clouds or something else.
    void addTopic(const std::string& topic, const std::string& type) { topics_[topic].type = type; }
    /// Throws Error if the message is malformed.
    void add(const std::string& topic, RosEncoding encoding, std::string_view message);
    /// Notes that the recording ends within a record. Throws Error unless the sink salvages.
    void cutShort();
    /// Notes what was read of which topics and sets the frame. Throws Error if no topic had a point.
    void finish();

private:
    struct Topic {
        std::string type, frame;
        std::uint64_t clouds = 0;
    };
    std::string otherTopics() const;

    const InputFile& input_;
    Sink& sink_;
    std::function<void(double)> progress_; ///< of the file: the sink would report that of each cloud
    ReleasePagesBehind release_pages_;
    std::map<std::string, Topic> topics_;
    std::uint64_t clouds_ = 0, points_ = 0;
};

} // namespace pointrt
