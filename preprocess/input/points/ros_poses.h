// SPDX-License-Identifier: GPL-3.0-or-later
// Poses of the frames of a ROS recording over time, from its transforms (tf) and its odometry.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/ingest/scan_traits.h"
#include "preprocess/input/points/ros_message.h"

namespace pointrt {

/// A frame placed in the frame nearest to the ground: a map, or the last frame on the way to one.
struct RosPlacement {
    Pose root_from_frame;
    std::string root;
    bool moves = false; ///< some of the transforms changed during the recording
};

class RosPoses {
public:
    /// Whether messages of a type have poses: tf, as all of its versions spell it, and odometry.
    static bool hasPoses(std::string_view type);

    /// Adds the poses of a message. Poses that are not finite are left out.
    void add(const InputFile& input, const std::string& topic, const std::string& type, RosEncoding encoding,
             std::string_view bytes);
    /// To be called after the last message, before place().
    void sort();

    /// The placement of a frame at a time; nullopt if nothing places the frame, or its poses do not cover that time.
    std::optional<RosPlacement> place(const std::string& frame, std::int64_t time_ns) const;

private:
    struct Sample {
        std::int64_t time_ns;
        Eigen::Vector3d translation;
        Eigen::Quaterniond rotation;
    };
    /// The poses of a frame in its parent.
    struct Edge {
        std::string parent, topic;
        bool moves = false;
        std::vector<Sample> samples;
    };
    using Edges = std::map<std::string, Edge>; ///< by the name of the frame

    void addOdometry(RosMessage& message, const std::string& topic);
    void addSample(RosMessage& message, const RosHeader& header, const std::string& frame, const std::string& topic,
                   Edges& edges);
    const Edge* edgeOf(const std::string& frame, bool prefers_odometry) const;
    std::optional<RosPlacement> climb(std::string frame, std::int64_t time_ns, bool prefers_odometry) const;
    static std::optional<Eigen::Isometry3d> poseAt(const Edge& edge, std::int64_t time_ns);

    Edges transforms_, odometry_;
    std::size_t samples_ = 0;
};

} // namespace pointrt
