// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/ros_poses.h"

#include <algorithm>

namespace pointrt {
namespace {

/// Poses are valid this long before the first and after the last pose of a frame: for one rotation of a lidar at 10 Hz,
/// whose cloud may be stamped at its start or its end.
constexpr std::int64_t kReach_ns = 100'000'000;
/// About as many poses as a day at 100 Hz has: a compressed recording may declare any number.
constexpr std::size_t kMostSamples = std::size_t{1} << 23;
/// More frames than a robot has joints.
constexpr std::size_t kMostFrames = 4096;
/// More frames than there are between a scanner and a map: transforms of a damaged file may form a cycle.
constexpr int kMostSteps = 64;

bool isTransforms(std::string_view type) {
    return type == "tf2_msgs/TFMessage" || type == "tf2_msgs/msg/TFMessage" || type == "tf/tfMessage";
}

bool isOdometry(std::string_view type) { return type == "nav_msgs/Odometry" || type == "nav_msgs/msg/Odometry"; }

/// Whether a frame is on the ground, judged by common names (REP 105). The transform to the Earth's frame is not used,
/// since z is not up there.
bool isGround(const std::string& frame) { return frame == "map" || frame == "world"; }

Eigen::Vector3d takeVector(RosMessage& message) {
    Eigen::Vector3d vector;
    for (double& value : vector) value = message.take<double>();
    return vector;
}

} // namespace

bool RosPoses::hasPoses(std::string_view type) { return isTransforms(type) || isOdometry(type); }

void RosPoses::add(const InputFile& input, const std::string& topic, const std::string& type, RosEncoding encoding,
                   std::string_view bytes) {
    RosMessage message(input, encoding, bytes);
    if (isOdometry(type)) return addOdometry(message, topic);
    const auto count = message.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        const RosHeader header(message);
        addSample(message, header, RosHeader::withoutSlash(message.text()), topic, transforms_);
    }
}

void RosPoses::addOdometry(RosMessage& message, const std::string& topic) {
    const RosHeader header(message);
    addSample(message, header, RosHeader::withoutSlash(message.text()), topic, odometry_);
}

/// Takes the position, then the quaternion x y z w. If there are several parents or odometries, the first counts, as tf
/// is a tree.
void RosPoses::addSample(RosMessage& message, const RosHeader& header, const std::string& frame,
                         const std::string& topic, Edges& edges) {
    Sample sample{header.time_ns, takeVector(message), {}};
    for (double& value : sample.rotation.coeffs()) value = message.take<double>(); // x y z w, as Eigen stores them
    const double size = sample.rotation.norm();
    if (frame.size() > kLongestFrame || header.frame.size() > kLongestFrame) return;
    if (edges.size() >= kMostFrames && !edges.contains(frame)) return;
    if (!sample.translation.allFinite() || !std::isfinite(size) || size == 0 || frame == header.frame) return;
    sample.rotation.normalize();
    Edge& edge = edges.try_emplace(frame, Edge{header.frame, topic, false, {}}).first->second;
    if (edge.parent != header.frame || (&edges == &odometry_ && edge.topic != topic)) return;
    if (++samples_ > kMostSamples)
        refuse(message.bytes.input, fmt::format("has more than {} poses; split it with 'rosbag filter'", kMostSamples));
    edge.samples.push_back(sample);
}

void RosPoses::sort() {
    for (Edges* const edges : {&transforms_, &odometry_})
        for (auto& [frame, edge] : *edges) {
            std::vector<Sample>& samples = edge.samples;
            std::stable_sort(samples.begin(), samples.end(),
                             [](const Sample& a, const Sample& b) { return a.time_ns < b.time_ns; });
            edge.moves = std::any_of(samples.begin(), samples.end(), [&](const Sample& each) {
                return each.translation != samples[0].translation ||
                       each.rotation.coeffs() != samples[0].rotation.coeffs();
            });
        }
}

/// A frame that never moves is valid at all times: its transform is sent only once.
std::optional<Eigen::Isometry3d> RosPoses::poseAt(const Edge& edge, std::int64_t time_ns) {
    const std::vector<Sample>& samples = edge.samples;
    const auto isometry = [](const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
        return Eigen::Isometry3d(Eigen::Translation3d(translation) * rotation);
    };
    const auto pose = [&](const Sample& sample) { return isometry(sample.translation, sample.rotation); };
    if (!edge.moves) return pose(samples[0]);
    const auto after = std::upper_bound(samples.begin(), samples.end(), time_ns,
                                        [](std::int64_t time, const Sample& sample) { return time < sample.time_ns; });
    if (after == samples.begin())
        return after->time_ns - time_ns > kReach_ns ? std::nullopt : std::optional(pose(*after));
    const auto before = after - 1;
    if (after == samples.end())
        return time_ns - before->time_ns > kReach_ns ? std::nullopt : std::optional(pose(*before));
    const double share = double(time_ns - before->time_ns) / double(after->time_ns - before->time_ns);
    return isometry(before->translation + share * (after->translation - before->translation),
                    before->rotation.slerp(share, after->rotation));
}

const RosPoses::Edge* RosPoses::edgeOf(const std::string& frame, bool prefers_odometry) const {
    const auto transform = transforms_.find(frame), odometry = odometry_.find(frame);
    if (odometry != odometry_.end() && (prefers_odometry || transform == transforms_.end())) return &odometry->second;
    return transform == transforms_.end() ? nullptr : &transform->second;
}

std::optional<RosPlacement> RosPoses::climb(std::string frame, std::int64_t time_ns, bool prefers_odometry) const {
    RosPlacement placement;
    Eigen::Isometry3d root_from_frame = Eigen::Isometry3d::Identity();
    int steps = 0;
    for (; steps < kMostSteps && !isGround(frame); ++steps) {
        const Edge* const edge = edgeOf(frame, prefers_odometry);
        if (!edge) break;
        const auto parent_from_frame = poseAt(*edge, time_ns);
        if (!parent_from_frame) return std::nullopt;
        root_from_frame = *parent_from_frame * root_from_frame;
        placement.moves = placement.moves || edge->moves;
        frame = edge->parent;
    }
    if (steps == 0 || steps == kMostSteps) return std::nullopt;
    placement.root_from_frame = {root_from_frame.linear(), root_from_frame.translation()};
    placement.root = std::move(frame);
    return placement;
}

std::optional<RosPlacement> RosPoses::place(const std::string& frame, std::int64_t time_ns) const {
    const auto by_transforms = climb(frame, time_ns, false);
    if (by_transforms && by_transforms->moves) return by_transforms;
    // A vehicle whose parts tf places, but whose own motion is only in the odometry.
    const auto by_odometry = climb(frame, time_ns, true);
    return by_odometry && by_odometry->moves ? by_odometry : by_transforms;
}

} // namespace pointrt
