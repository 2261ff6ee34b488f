// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "tests/bench/quality/devices/random.h"
#include "tests/bench/quality/devices/world.h"

namespace pointrt::quality {

namespace {

using std::numbers::pi;

/// Rolling ground: a grid of 1 m over the square around the origin.
void addGround(WorldBuilder& builder, double half, double roll) {
    const auto at = [&](double x, double y) {
        return Vec3d(x, y, roll * std::sin(0.21 * x + 0.5) * std::cos(0.17 * y));
    };
    for (double x = -half; x < half; ++x)
        for (double y = -half; y < half; ++y)
            builder.addQuad(at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1), Part::kOther);
}

/// Leaves are quads; their number follows from the leaf area density, m^2 of leaves per m^3 of crown. Single
/// broadleaved trees have about 0.5 to 1.5 (Hosoi and Omasa, "Voxel-based 3-D modeling of individual trees for
/// estimating leaf area density", IEEE TGRS 2006, measure 0.4 to 1.2).
constexpr double kLeafAreaDensity = 0.7;
/// A leaf's edge in metres: leaves of lime and maple are 5 to 15 cm long.
constexpr double kLeafEdge = 0.1;

void addLeaves(World& world, WorldBuilder& builder, const Crown& crown, Random& random) {
    const double volume = 4 * pi / 3 * crown.radii.prod();
    const auto count = static_cast<int>(kLeafAreaDensity * volume / (kLeafEdge * kLeafEdge));
    for (int i = 0; i < count;) {
        const Vec3d place(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        if (place.squaredNorm() > 1) continue;
        ++i;
        const Vec3d center = crown.center + place.cwiseProduct(crown.radii);
        const Vec3d normal = Vec3d(random.normal(), random.normal(), random.normal()).normalized();
        const Vec3d u = kLeafEdge / 2 * normal.unitOrthogonal(), v = normal.cross(u);
        builder.addQuad(center - u - v, center + u - v, center + u + v, center - u + v, Part::kLeaf);
    }
    world.crowns.push_back(crown);
}

void addTree(World& world, WorldBuilder& builder, const Vec3d& foot, double height, Random& random) {
    const double radius = height * random.between(0.2, 0.27);
    const Crown crown{foot + Vec3d(0, 0, 0.65 * height), Vec3d(radius, radius, 0.35 * height)};
    builder.addCylinder(foot - Vec3d(0, 0, 0.3), foot + Vec3d(0, 0, 0.8 * height), 0.03 * height, 0.01 * height);
    for (int i = 0; i < 8; ++i) { // branches from the trunk into the crown
        const double around = 2 * pi * i / 8 + random.between(0, 0.5), from = random.between(0.35, 0.6) * height;
        const Vec3d out(std::cos(around), std::sin(around), random.between(0.4, 0.9));
        const Vec3d start = foot + Vec3d(0, 0, from);
        builder.addCylinder(start, start + 0.75 * radius * out, 0.01 * height, 0.003 * height, 8);
    }
    addLeaves(world, builder, crown, random);
}

void addChair(WorldBuilder& builder, const Vec3d& place, double yaw) {
    const Eigen::AngleAxisd turn(yaw * pi / 180, Vec3d::UnitZ());
    const auto box = [&](const Vec3d& center, const Vec3d& size) {
        builder.addBox(place + turn * center, size, Part::kOther, yaw);
    };
    box({0, 0, 0.44}, {0.42, 0.42, 0.04});
    box({0, -0.19, 0.7}, {0.42, 0.03, 0.48});
    for (const double x : {-0.18, 0.18})
        for (const double y : {-0.18, 0.18}) box({x, y, 0.21}, {0.04, 0.04, 0.42});
}

void addTable(WorldBuilder& builder, const Vec3d& place, const Vec3d& size) {
    builder.addBox(place + Vec3d(0, 0, size.z() - 0.02), {size.x(), size.y(), 0.04}, Part::kWall);
    for (const double x : {-0.45, 0.45})
        for (const double y : {-0.42, 0.42})
            builder.addBox(place + Vec3d(x * size.x(), y * size.y(), size.z() / 2 - 0.02),
                           {0.06, 0.06, size.z() - 0.04}, Part::kOther);
}

void addShelf(WorldBuilder& builder, const Vec3d& place, double width, double height, Random& random) {
    for (const double x : {-0.5, 0.5})
        builder.addBox(place + Vec3d(x * width, 0, height / 2), {0.025, 0.3, height}, Part::kOther);
    for (double z = 0.05; z < height; z += 0.38) {
        builder.addBox(place + Vec3d(0, 0, z), {width, 0.3, 0.025}, Part::kOther);
        for (double x = -0.45 * width; x < 0.3 * width;) { // books
            const double thick = random.between(0.02, 0.06), tall = random.between(0.2, 0.3);
            builder.addBox(place + Vec3d(x + thick / 2, random.between(-0.03, 0.03), z + 0.0125 + tall / 2),
                           {thick, 0.2, tall}, Part::kOther);
            x += thick + (random.uniform() < 0.1 ? 0.1 : 0);
        }
    }
}

void addCar(WorldBuilder& builder, const Vec3d& place, double yaw) {
    builder.addBox(place + Vec3d(0, 0, 0.55), {4.2, 1.75, 0.7}, Part::kOther, yaw);
    builder.addBox(place + Vec3d(0, 0, 1.15), {2.2, 1.55, 0.5}, Part::kOther, yaw);
}

/// A wire hangs as a parabola.
void addWire(WorldBuilder& builder, const Vec3d& from, const Vec3d& to, double sag) {
    constexpr int kPieces = 12;
    const auto at = [&](int i) {
        const double s = static_cast<double>(i) / kPieces;
        return Vec3d(from + s * (to - from) - Vec3d(0, 0, 4 * sag * s * (1 - s)));
    };
    for (int i = 0; i < kPieces; ++i) builder.addCylinder(at(i), at(i + 1), 0.01, 0.01, 6);
}

/// A row of houses along x, seen from the side that y_out points to.
void addHouses(WorldBuilder& builder, double y, double y_out, double half, Random& random) {
    for (double x = -half; x < half - 1;) {
        const double width = std::min(half - x, random.between(9, 14)), height = random.between(8, 13);
        const double front = y + y_out * random.between(-0.3, 0.3), back = y - 8 * y_out;
        const WorldBuilder::WindowGrid windows{3, static_cast<int>(height / 3), 1.1, 1.5, 0.9, 3.0, 0.2};
        const Vec3d left(x, front, 0), right(x + width, front, 0);
        const bool south = y_out < 0;
        builder.addFacade(south ? left : right, south ? right : left, height, windows);
        builder.addQuad({x, front, height}, {x + width, front, height}, {x + width, back, height}, {x, back, height},
                        Part::kWall);
        for (const double side : {x, x + width})
            builder.addQuad({side, front, 0}, {side, back, 0}, {side, back, height}, {side, front, height},
                            Part::kWall);
        x += width;
    }
}

} // namespace

World roomWorld(int variant) {
    World world;
    WorldBuilder builder(world);
    Random random(100, static_cast<std::uint64_t>(variant));
    const double width = random.between(4.5, 5.5), depth = random.between(3.8, 4.6), height = random.between(2.5, 2.8);
    const Vec3d a(0, 0, 0), b(width, 0, 0), c(width, depth, 0), d(0, depth, 0), up(0, 0, height);
    builder.addQuad(a, b, c, d, Part::kWall);
    builder.addQuad(a + up, d + up, c + up, b + up, Part::kWall);
    builder.addFacade(b, a, height, {2, 1, 0.9, 1.2, 0.9, 3.0, 0.2}); // seen from inside
    builder.addFacade(c, b, height, {});
    builder.addFacade(d, c, height, {1, 1, 1.0, 2.0, 0.0, 3.0, 0.12});
    builder.addFacade(a, d, height, {});
    const Vec3d table(width * random.between(0.4, 0.6), depth * random.between(0.4, 0.55), 0);
    addTable(builder, table, {1.5, 0.85, 0.74});
    for (int i = 0; i < 4; ++i)
        addChair(builder, table + Vec3d(i % 2 ? 0.45 : -0.45, i < 2 ? 0.75 : -0.75, 0),
                 (i < 2 ? 180 : 0) + random.between(-25, 25));
    builder.addBall(table + Vec3d(random.between(-0.5, 0.5), 0.1, 0.86), 0.12);
    builder.addBox(table + Vec3d(0.2, -0.2, 0.82), {0.25, 0.18, 0.16}, Part::kOther, 30);
    addShelf(builder, {width * random.between(0.2, 0.35), depth - 0.16, 0}, 1.0, 1.9, random);
    builder.addBox({width - 0.5, depth * 0.5, 0.2}, {0.9, 1.9, 0.4}, Part::kOther); // a sofa
    builder.addBox({width - 0.15, depth * 0.5, 0.55}, {0.2, 1.9, 0.7}, Part::kOther);
    const Vec3d lamp(0.5, 0.5, 0);
    builder.addCylinder(lamp, lamp + Vec3d(0, 0, 1.5), 0.015, 0.015);
    builder.addBall(lamp + Vec3d(0, 0, 1.6), 0.16);
    return world;
}

World houseWorld(int variant) {
    World world;
    WorldBuilder builder(world);
    Random random(200, static_cast<std::uint64_t>(variant));
    addGround(builder, 22, 0.25);
    const double x = random.between(4.5, 6), y = random.between(3.5, 4.5), eaves = random.between(4.5, 6), roof = 3;
    const Vec3d a(-x, -y, -0.3), b(x, -y, -0.3), c(x, y, -0.3), d(-x, y, -0.3);
    const WorldBuilder::WindowGrid windows{variant + 2, 2, 1.0, 1.3, 1.3, 2.7, 0.15};
    builder.addFacade(a, b, eaves + 0.3, windows);
    builder.addFacade(b, c, eaves + 0.3, {2, 2, 1.0, 1.3, 1.3, 2.7, 0.15});
    builder.addFacade(c, d, eaves + 0.3, windows);
    builder.addFacade(d, a, eaves + 0.3, {});
    const double over = 0.4, low = eaves - over * roof / y; // the roof overhangs the walls
    for (const double side : {-1.0, 1.0}) {
        builder.addTriangle({side * x, -y, eaves}, {side * x, y, eaves}, {side * x, 0, eaves + roof}, Part::kWall);
        builder.addQuad({-x - over, side * (y + over), low}, {x + over, side * (y + over), low},
                        {x + over, 0, eaves + roof}, {-x - over, 0, eaves + roof}, Part::kWall);
    }
    builder.addBox({0.4 * x, 0.3 * y, eaves + roof}, {0.6, 0.6, 1.8}, Part::kOther);
    for (int i = 0; i < 3; ++i) {
        const double around = 2 * pi * i / 3 + random.between(0, 1), away = random.between(10, 14);
        addTree(world, builder, {away * std::cos(around), away * std::sin(around), 0}, random.between(6, 9), random);
    }
    return world;
}

World streetWorld(int variant) {
    World world;
    WorldBuilder builder(world);
    Random random(300, static_cast<std::uint64_t>(variant));
    const double half = 24, road = random.between(3.5, 4.5), walk = road + random.between(2, 3), kerb = 0.12;
    builder.addQuad({-half, -road, 0}, {half, -road, 0}, {half, road, 0}, {-half, road, 0}, Part::kWall);
    for (const double side : {-1.0, 1.0}) {
        builder.addBox({0, side * (road + walk) / 2, kerb / 2}, {2 * half, walk - road, kerb}, Part::kWall);
        addHouses(builder, side * walk, -side, half, random);
    }
    std::optional<Vec3d> last;
    for (double x = -half + 3; x < half; x += 14) {
        const Vec3d foot(x, road + 0.4, kerb), top = foot + Vec3d(0, 0, 7);
        builder.addCylinder(foot, top, 0.1, 0.07);
        builder.addCylinder(top, top - Vec3d(0, 1.5, -0.2), 0.04, 0.04);
        if (last) addWire(builder, *last, top, 0.5);
        last = top;
        addCar(builder, {x + 6 + random.between(-1, 1), -road + 1.1, 0}, random.between(-4, 4));
        addTree(world, builder, {x + 4, -road - 0.8, kerb}, random.between(5, 6.5), random);
    }
    return world;
}

} // namespace pointrt::quality
