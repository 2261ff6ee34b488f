// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/ros_clouds.h"

#include <algorithm>

#include "preprocess/ingest/text.h"
#include "preprocess/input/points/ros_cloud.h"

namespace pointrt {
namespace {

/// Whether a frame stays fixed while its scanner moves, judged by common names (REP 105).
bool isFixedFrame(std::string_view frame) {
    const std::string lower = lowerCase(frame);
    for (const std::string_view word : {"map", "odom", "world", "earth", "utm", "global"})
        if (lower.find(word) != std::string::npos) return true;
    return false;
}

} // namespace

bool isRosCloud(std::string_view type) {
    return type == "sensor_msgs/PointCloud2" || type == "sensor_msgs/msg/PointCloud2";
}

void RosClouds::reportLeft(std::size_t bytes) {
    const std::size_t done = input_.bytes.size() - bytes;
    const double share = static_cast<double>(done) / static_cast<double>(input_.bytes.size());
    if (progress_) progress_(looks_for_poses_ ? share / 2 : (poses_looked_for_ ? (1 + share) / 2 : share));
    release_pages_(done);
}

bool RosClouds::wants(std::string_view type) const {
    return isRosCloud(type) || (looks_for_poses_ && RosPoses::hasPoses(type));
}

void RosClouds::beginPoses() { looks_for_poses_ = poses_looked_for_ = true; }

void RosClouds::beginClouds() {
    looks_for_poses_ = false;
    release_pages_.kept_from = 0;
    poses_.sort();
    for (auto& [name, topic] : topics_) {
        topic.is_placed = std::any_of(topic.headers.begin(), topic.headers.end(), [&](const RosHeader& header) {
            return poses_.place(header.frame, header.time_ns).has_value();
        });
        topic.headers = {};
    }
}

void RosClouds::add(const std::string& topic, RosEncoding encoding, std::string_view message) {
    Topic& its = topics_[topic];
    if (!looks_for_poses_) return addCloud(topic, its, takeRosCloud(input_, encoding, message));
    if (!isRosCloud(its.type)) return poses_.add(input_, topic, its.type, encoding, message);
    constexpr std::size_t kMostHeaders = 1 << 16; // hours of a lidar; a part of them shows whether poses fit
    RosMessage start(input_, encoding, message);
    RosHeader header(start);
    if (its.headers.size() < kMostHeaders && header.frame.size() <= kLongestFrame)
        its.headers.push_back(std::move(header));
}

void RosClouds::addCloud(const std::string& name, Topic& topic, RosCloud cloud) {
    topic.frame = cloud.header.frame;
    ++topic.clouds;
    const std::uint64_t count = std::uint64_t{cloud.height} * cloud.width;
    if (count == 0) return;
    const auto placement = topic.is_placed ? poses_.place(topic.frame, cloud.header.time_ns) : std::nullopt;
    if (topic.is_placed && !placement) return void(++topic.unplaced);
    placeFields(input_, cloud);
    if (!hasPositions(cloud.fields))
        refuse(input_, fmt::format("a cloud of topic {} has no fields x, y and z", inQuotes(name)));
    if (placement) {
        sink_.transform.input_from_scan = placement->root_from_frame;
        topic.root = placement->root;
        moves_ = moves_ || placement->moves;
    }
    addFieldPoints(input_, cloud.fields, count, sink_);
    if (!isFixedFrame(cloud.header.frame)) sink_.setScanSensor(Vec3d::Zero());
    sink_.finishScan(input_, fmt::format("{} {}", name, topic.clouds), Emptiness::kAllowed);
    sink_.transform.input_from_scan.reset();
    ++clouds_;
}

void RosClouds::cutShort() {
    if (looks_for_poses_) return; // the next pass finds it too
    if (!sink_.salvages) refuse(input_, "truncated: it ends within a record; --salvage reads the clouds before it");
    sink_.note(input_, "truncated: the clouds before its end are read");
}

std::string RosClouds::otherTopics() const {
    std::string others;
    for (const auto& [name, topic] : topics_)
        if (!isRosCloud(topic.type) && !RosPoses::hasPoses(topic.type))
            addQuoted(fmt::format("{} ({})", name, topic.type), others);
    return others;
}

/// Notes which topics are placed by which poses, and which are not.
void RosClouds::notePlaces() {
    std::string placed, as_they_are, roots;
    std::uint64_t unplaced = 0, clouds = 0;
    for (const auto& [name, topic] : topics_) {
        if (topic.clouds == 0) continue;
        addQuoted(fmt::format("{} ({} in frame {})", name, topic.clouds, topic.frame),
                  topic.is_placed ? placed : as_they_are);
        if (topic.is_placed && roots.find(topic.root) == roots.npos) addQuoted(topic.root, roots);
        unplaced += topic.unplaced;
        clouds += topic.clouds;
    }
    if (!placed.empty())
        sink_.note(input_, fmt::format("clouds are placed in frame {} by the {} of the recording: {}", roots,
                                       moves_ ? "poses" : "static transforms", placed));
    if (!as_they_are.empty())
        sink_.note(input_,
                   fmt::format("clouds are read as they are, without poses of a moving scanner: {}", as_they_are));
    if (unplaced > 0)
        sink_.note(input_, fmt::format("{} of {} clouds are from before the first pose or after the last, and left out",
                                       unplaced, clouds));
}

void RosClouds::finish() {
    if (clouds_ == 0)
        refuse(input_, fmt::format("has no clouds of type sensor_msgs/PointCloud2; its topics are {}",
                                   topics_.empty() ? "none" : otherTopics()));
    notePlaces();
    if (const std::string others = otherTopics(); !others.empty())
        sink_.note(input_, fmt::format("topics without clouds are not read: {}", others));
    WorldFrame frame;
    frame.up = Vec3d::UnitZ(); // the convention for vehicles and maps alike (REP 103)
    frame.up_by_custom = true;
    frame.metres_per_unit = 1;
    sink_.setWorldFrame(input_, frame);
}

} // namespace pointrt
