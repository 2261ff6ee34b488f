// SPDX-License-Identifier: GPL-3.0-or-later
// smooth_peers METHOD RADIUS IN.ply OUT.ply: cleans a raw scan by PCL or CGAL, to compare with pointrt-bake.
//   mls        PCL's moving least squares of order 2 (Alexa et al. 2003), with the normals of the fit
//   bilateral  CGAL's bilateral smoothing (Huang et al. 2013, "Edge-aware point set resampling"), with its normals
//   jet        CGAL's jet smoothing (Cazals and Pouget 2005), without normals
//   wlop       CGAL's weighted locally optimal projection (Huang et al. 2009) to half the points, without normals
// RADIUS is in input units; methods that take a number of neighbours get the mean number within it. Points need
// oriented normals. Prints the seconds of the smoothing.
#define PCL_NO_PRECOMPILE // avoids linking PCL's surface library, which depends on VTK
#include <pcl/point_types.h>
#include <pcl/surface/impl/mls.hpp>
#include <pcl/surface/mls.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/bilateral_smooth_point_set.h>
#include <CGAL/jet_smooth_point_set.h>
#include <CGAL/property_map.h>
#include <CGAL/wlop_simplify_and_regularize_point_set.h>

#include <chrono>
#include <cstdio>

#include "format/base/run_tool.h"
#include "preprocess/input/read.h"
#include "preprocess/surface/neighbors.h"
#include "tests/bench/quality/shapes.h"

namespace pointrt::quality {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Positions = CGAL::First_of_pair_property_map<Oriented>;
using Normals = CGAL::Second_of_pair_property_map<Oriented>;

std::vector<Oriented> orientedOf(const Cloud& cloud) {
    std::vector<Oriented> points;
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const Vec3f &p = cloud.positions[i], &n = cloud.normals[i];
        points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), Kernel::Vector_3(n.x(), n.y(), n.z()));
    }
    return points;
}

template <typename Point>
Vec3f vectorOf(const Point& point) {
    return {static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())};
}

void takeBack(Cloud& cloud, const std::vector<Oriented>& points, bool with_normals) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        cloud.positions[i] = vectorOf(points[i].first);
        cloud.normals[i] = with_normals ? vectorOf(points[i].second) : Vec3f::Zero();
    }
}

/// Mean number of neighbours, over a thousandth of the points.
unsigned neighborsWithin(const Cloud& cloud, float radius) {
    const surface::NearestSearch search(cloud.positions);
    std::vector<std::uint32_t> found(100000);
    std::size_t sum = 0, counted = 0;
    for (std::size_t i = 0; i < cloud.positions.size(); i += 1000, ++counted)
        sum += search.within(cloud.positions[i], radius * radius, found);
    return static_cast<unsigned>(sum / counted);
}

void smoothByMls(Cloud& cloud, float radius) {
    const auto input = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    for (const Vec3f& p : cloud.positions) input->emplace_back(p.x(), p.y(), p.z());
    pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal> mls;
    mls.setInputCloud(input);
    mls.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    mls.setSearchRadius(radius);
    mls.setPolynomialOrder(2);
    mls.setComputeNormals(true);
    mls.setNumberOfThreads(2);
    pcl::PointCloud<pcl::PointNormal> output;
    mls.process(output);
    const auto indices = mls.getCorrespondingIndices();
    Cloud smooth;
    for (std::size_t i = 0; i < output.size(); ++i) {
        const Vec3f normal(output[i].normal_x, output[i].normal_y, output[i].normal_z);
        const bool turned = normal.dot(cloud.normals[static_cast<std::size_t>(indices->indices[i])]) < 0;
        smooth.positions.emplace_back(output[i].x, output[i].y, output[i].z);
        smooth.normals.push_back(turned ? Vec3f(-normal) : normal);
    }
    cloud = std::move(smooth);
}

void smoothBilaterally(Cloud& cloud, float radius) {
    std::vector<Oriented> points = orientedOf(cloud);
    CGAL::bilateral_smooth_point_set<CGAL::Parallel_if_available_tag>(
        points, neighborsWithin(cloud, radius),
        CGAL::parameters::point_map(Positions()).normal_map(Normals()).sharpness_angle(25)); // CGAL's own example
    takeBack(cloud, points, true);
}

void smoothByJets(Cloud& cloud, float radius) {
    std::vector<Oriented> points = orientedOf(cloud);
    CGAL::jet_smooth_point_set<CGAL::Parallel_if_available_tag>(points, neighborsWithin(cloud, radius),
                                                                CGAL::parameters::point_map(Positions()));
    takeBack(cloud, points, false);
}

void projectByWlop(Cloud& cloud, float radius) {
    std::vector<Oriented> points = orientedOf(cloud);
    std::vector<Kernel::Point_3> output;
    CGAL::wlop_simplify_and_regularize_point_set<CGAL::Parallel_if_available_tag>(
        points, std::back_inserter(output),
        CGAL::parameters::point_map(Positions()).select_percentage(50).neighbor_radius(radius));
    cloud = {};
    for (const auto& point : output) cloud.positions.push_back(vectorOf(point));
    cloud.normals.assign(cloud.positions.size(), Vec3f::Zero());
}

int run(const std::vector<std::string>& words) {
    if (words.size() != 4)
        throw Error(ExitCode::kBadUsage, "smooth_peers mls|bilateral|jet|wlop RADIUS IN.ply OUT.ply");
    Cloud cloud = readInputs({words[2]}, {});
    if (cloud.normals.empty()) throw Error(ExitCode::kBadInput, words[2] + ": has no normals");
    const float radius = std::stof(words[1]);
    const auto start = std::chrono::steady_clock::now();
    if (words[0] == "mls")
        smoothByMls(cloud, radius);
    else if (words[0] == "bilateral")
        smoothBilaterally(cloud, radius);
    else if (words[0] == "jet")
        smoothByJets(cloud, radius);
    else if (words[0] == "wlop")
        projectByWlop(cloud, radius);
    else
        throw Error(ExitCode::kBadUsage, words[0] + ": not a method");
    std::printf("%.1f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    for (Vec3f& position : cloud.positions) position += cloud.origin.cast<float>();
    writeMesh(words[3], cloud);
    return 0;
}

} // namespace

} // namespace pointrt::quality

int main(int argc, char** argv) {
    return pointrt::runTool("smooth_peers",
                            [&] { return pointrt::quality::run(std::vector<std::string>(argv + 1, argv + argc)); });
}
