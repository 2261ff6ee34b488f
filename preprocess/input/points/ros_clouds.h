// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds in ROS recordings: messages of type sensor_msgs/PointCloud2, whatever container holds them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "preprocess/ingest/formats.h"
#include "preprocess/input/points/ros_message.h"
#include "preprocess/input/points/ros_poses.h"

namespace pointrt {

/// Whether a type is PointCloud2, as ROS 1 and ROS 2 spell it.
bool isRosCloud(std::string_view type);

struct RosCloud;

/// Receives the messages of one recording and adds each cloud as a scan. A recording with poses is read twice: a cloud
/// may come before the pose that follows it in time.
class RosClouds {
public:
    RosClouds(const InputFile& input, Sink& sink)
        : input_(input), sink_(sink), progress_(std::exchange(sink.progress, nullptr)), release_pages_{input} {}
    ~RosClouds() { sink_.progress = progress_; }
    RosClouds(const RosClouds&) = delete;
    RosClouds& operator=(const RosClouds&) = delete;

    /// Reports how much of the file is read, and releases the memory of that.
    void reportLeft(std::size_t bytes);

    /// Starts a pass over the messages that gathers poses; none if the recording has no topic with poses.
    void beginPoses();
    /// Starts the pass that adds the clouds.
    void beginClouds();

    /// A topic of the recording, with clouds or something else.
    void addTopic(const std::string& topic, const std::string& type) { topics_[topic].type = type; }
    /// Whether add() takes messages of a type in this pass.
    bool wants(std::string_view type) const;
    /// Throws Error if the message is malformed.
    void add(const std::string& topic, RosEncoding encoding, std::string_view message);
    /// Notes that the recording ends within a record. Throws Error unless the sink salvages.
    void cutShort();
    /// Notes what was read of which topics and sets the frame. Throws Error if no topic had a point.
    void finish();

private:
    struct Topic {
        std::string type, frame, root;
        std::uint64_t clouds = 0, unplaced = 0;
        bool is_placed = false;         ///< a pose is known at the time of at least one cloud
        std::vector<RosHeader> headers; ///< of its clouds, until the poses are known
    };
    void addCloud(const std::string& name, Topic& topic, RosCloud cloud);
    void notePlaces();
    std::string otherTopics() const;

    const InputFile& input_;
    Sink& sink_;
    std::function<void(double)> progress_; ///< for the file: the sink would report the progress of each cloud
    ReleasePagesBehind release_pages_;
    std::map<std::string, Topic> topics_;
    RosPoses poses_;
    std::uint64_t clouds_ = 0;
    bool looks_for_poses_ = false, poses_looked_for_ = false, moves_ = false;
};

} // namespace pointrt
