// SPDX-License-Identifier: Apache-2.0
// Transforms to render space, against long doubles and by hand.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "runtime/device_scene/render_space.h"

namespace pointrt {
namespace {

using std::numbers::pi;

pro_info infoAt(Vec3 origin, double scale) {
    pro_info info{};
    const double corner[3] = {origin.x, origin.y, origin.z};
    for (int i = 0; i < 3; ++i) {
        info.origin[i] = corner[i];
        info.bounds_min[i] = corner[i] + 0.125 * scale;
        info.bounds_max[i] = corner[i] + 0.75 * scale;
    }
    info.scale = scale;
    return info;
}

/// A rotation about an oblique axis by Rodrigues' formula, orthonormal to the last bits.
std::array<Vec3, 3> rotation(double degrees) {
    const Vec3 axis = normalize({1, 2, -1});
    const double angle = degrees * pi / 180;
    std::array<Vec3, 3> columns;
    const Vec3 units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; ++i)
        columns[i] = std::cos(angle) * units[i] + std::sin(angle) * cross(axis, units[i]) +
                     ((1 - std::cos(angle)) * dot(axis, units[i])) * axis;
    return {Vec3{columns[0].x, columns[1].x, columns[2].x}, Vec3{columns[0].y, columns[1].y, columns[2].y},
            Vec3{columns[0].z, columns[1].z, columns[2].z}};
}

SceneDescription sceneOf(std::vector<Placement> placements) {
    SceneDescription scene;
    for (const Placement& placement : placements) {
        scene.instances.emplace_back();
        scene.instances.back().placement = placement;
    }
    return scene;
}

using Long3 = std::array<long double, 3>;

Long3 longOf(Vec3 v) { return {v.x, v.y, v.z}; }

/// The world position of a point in an instance's cube.
Long3 worldOf(const Placement& placement, const pro_info& info, Vec3 cube) {
    const Long3 at = longOf(cube), translation = longOf(placement.translation);
    Long3 input, world;
    for (int i = 0; i < 3; ++i) input[i] = info.origin[i] + static_cast<long double>(info.scale) * at[i];
    for (int i = 0; i < 3; ++i) {
        const Long3 row = longOf(placement.rotation[i]);
        world[i] = translation[i] + static_cast<long double>(placement.scale) *
                                        (row[0] * input[0] + row[1] * input[1] + row[2] * input[2]);
    }
    return world;
}

/// The render space position of a world point, without rounding.
Long3 renderPointOf(const RenderSpace& space, const Long3& world) {
    const Long3 origin = longOf(space.origin);
    Long3 point;
    for (int i = 0; i < 3; ++i) point[i] = (world[i] - origin[i]) / static_cast<long double>(space.scale);
    return point;
}

double applied(const gpu::vec4& row, const Long3& p) {
    return static_cast<double>(row.x * p[0] + row.y * p[1] + row.z * p[2] + row.w);
}

void expectRow(const gpu::vec4& row, float x, float y, float z, float w) {
    EXPECT_EQ(row.x, x);
    EXPECT_EQ(row.y, y);
    EXPECT_EQ(row.z, z);
    EXPECT_EQ(row.w, w);
}

TEST(RenderSpace, IsTheFirstCubeIfThatIsNotTransformed) {
    for (const Vec3 origin : {Vec3{}, Vec3{5'412'345.678, 331'234.567, -12.3}, Vec3{-0.1, 0.7, 1e-9}})
        for (const double scale : {1.0, 0.0731, 123.456789}) {
            const pro_info infos[] = {infoAt(origin, scale)};
            const RenderSpace space = chooseRenderSpace(sceneOf({{}}), infos);
            EXPECT_EQ(space.origin.x, origin.x);
            EXPECT_EQ(space.origin.y, origin.y);
            EXPECT_EQ(space.origin.z, origin.z);
            EXPECT_EQ(space.scale, scale);
            const auto rows = cubeFromRender(space, {}, infos[0]);
            expectRow(rows[0], 1, 0, 0, 0);
            expectRow(rows[1], 0, 1, 0, 0);
            expectRow(rows[2], 0, 0, 1, 0);
        }
}

TEST(RenderSpace, FollowsTheFirstInstance) {
    const Placement placement{rotation(0), 2.5, {100, 200, 300}};
    const pro_info infos[] = {infoAt({1, 2, 3}, 4), infoAt({0, 0, 0}, 1)};
    const RenderSpace space = chooseRenderSpace(sceneOf({placement, {}}), infos);
    EXPECT_NEAR(space.origin.x, 102.5, 1e-12);
    EXPECT_NEAR(space.origin.y, 205, 1e-12);
    EXPECT_NEAR(space.origin.z, 307.5, 1e-12);
    EXPECT_EQ(space.scale, 10);
    const Vec3 point = renderPoint(space, {112.5, 205, 297.5}), world = worldPoint(space, {1, 0, -1});
    EXPECT_NEAR(point.x, 1, 1e-12);
    EXPECT_NEAR(point.z, -1, 1e-12);
    EXPECT_NEAR(world.x, 112.5, 1e-12);
    EXPECT_NEAR(world.z, 297.5, 1e-12);
}

TEST(RenderSpace, FramesShapesIfThereIsNoInstance) {
    SceneDescription scene;
    EXPECT_EQ(chooseRenderSpace(scene, {}).scale, 1);
    scene.shapes.push_back({});
    EXPECT_EQ(chooseRenderSpace(scene, {}).scale, 1) << "a plane has no extent";
    scene.shapes.push_back({ShapeKind::kSphere, {10, 20, 30}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, 0, true});
    scene.shapes.push_back({ShapeKind::kQuad, {20, 20, 30}, {0, 0, 1}, {0, 0.5, 0}, {1, 0, 0}, 0, true});
    const RenderSpace space = chooseRenderSpace(scene, {});
    EXPECT_EQ(space.scale, 12);
    EXPECT_EQ(space.origin.x, 8);
    EXPECT_EQ(space.origin.y, 18);
    EXPECT_EQ(space.origin.z, 28);
}

// A millimetre is the 13th digit of coordinates in a national grid.
TEST(RenderSpace, KeepsMillimetresOfNationalGrids) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit;
    for (int round = 0; round < 200; ++round) {
        const Vec3 far{5'000'000 + 1000 * unit(random), 330'000 + 1000 * unit(random), 100 * unit(random)};
        const Placement first{rotation(round % 2 ? 360 * unit(random) : 0), 0.5 + unit(random), {unit(random), 0, 7}};
        Placement second{first.rotation, first.scale, {40 * unit(random), 30, -20}};
        const pro_info infos[] = {infoAt(far, 80), infoAt(far + Vec3{12.5, -3, 60 * unit(random)}, 45)};
        const Placement placements[] = {first, second};
        const RenderSpace space = chooseRenderSpace(sceneOf({first, second}), infos);
        for (int i = 0; i < 2; ++i) {
            const auto rows = cubeFromRender(space, placements[i], infos[i]);
            const Vec3 cube{unit(random), unit(random), unit(random)};
            const Long3 point = renderPointOf(space, worldOf(placements[i], infos[i], cube));
            // floats of coordinates of about 2; five million units in floats would be off by half a unit, 1 / 90 here
            EXPECT_NEAR(applied(rows[0], point), cube.x, 5e-7);
            EXPECT_NEAR(applied(rows[1], point), cube.y, 5e-7);
            EXPECT_NEAR(applied(rows[2], point), cube.z, 5e-7);
        }
    }
}

TEST(RenderSpace, RowsAreASimilarity) {
    const Placement placement{rotation(77), 3, {4, 5, 6}};
    const pro_info infos[] = {infoAt({1, 1, 1}, 10), infoAt({2, 3, 4}, 6)};
    const RenderSpace space = chooseRenderSpace(sceneOf({{}, placement}), infos);
    const auto rows = cubeFromRender(space, placement, infos[1]);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            const double product =
                double(rows[a].x) * rows[b].x + double(rows[a].y) * rows[b].y + double(rows[a].z) * rows[b].z;
            const double units = 10.0 / (3 * 6); // cube units per render unit
            EXPECT_NEAR(product, a == b ? units * units : 0, 1e-7);
        }
}

TEST(RenderSpace, BoundsHoldEveryCorner) {
    const Placement placement{rotation(30), 2, {1, 2, 3}};
    const pro_info info = infoAt({10, 20, 30}, 8);
    const Bounds bounds = placedBounds(placement, info);
    Bounds corners{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
    for (int c = 0; c < 8; ++c) {
        const auto at = [&](int axis) { return (c >> axis & 1) ? 0.75 : 0.125; };
        const Long3 world = worldOf(placement, info, {at(0), at(1), at(2)});
        const Vec3 point{static_cast<double>(world[0]), static_cast<double>(world[1]), static_cast<double>(world[2])};
        corners = joined(corners, {point, point});
    }
    EXPECT_NEAR(length(bounds.lo - corners.lo), 0, 1e-12);
    EXPECT_NEAR(length(bounds.hi - corners.hi), 0, 1e-12);
}

/// The largest coordinate along each axis of points center + x u + y v + z w, by trying many.
Bounds triedBounds(const ShapeDescription& shape) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    Bounds tried{shape.center, shape.center};
    for (int i = 0; i < 200'000; ++i) {
        Vec3 p{normal(random), normal(random), normal(random)};
        if (shape.kind == ShapeKind::kDisc) p.z = 0;
        if (shape.kind == ShapeKind::kBox || shape.kind == ShapeKind::kQuad)
            p = {std::copysign(1, p.x), std::copysign(1, p.y),
                 shape.kind == ShapeKind::kBox ? std::copysign(1, p.z) : 0};
        else
            p = normalize(p);
        const Vec3 at = shape.center + p.x * shape.u + p.y * shape.v + p.z * shape.w;
        tried = joined(tried, {at, at});
    }
    return tried;
}

TEST(RenderSpace, BoundsOfShapesAreTight) {
    const auto axes = rotation(50);
    for (const ShapeKind kind : {ShapeKind::kDisc, ShapeKind::kQuad, ShapeKind::kBox, ShapeKind::kSphere}) {
        const bool sphere = kind == ShapeKind::kSphere;
        const ShapeDescription shape{kind, {3, -2, 1}, 2.0 * axes[0], 2.0 * axes[1], (sphere ? 2.0 : 1.0) * axes[2],
                                     0,    true};
        const Bounds bounds = shapeBounds(shape).value(), tried = triedBounds(shape);
        EXPECT_NEAR(length(bounds.lo - tried.lo), 0, 1e-3);
        EXPECT_NEAR(length(bounds.hi - tried.hi), 0, 1e-3);
    }
    EXPECT_FALSE(shapeBounds({}).has_value());
}

TEST(PackShape, TransformsTheShapeToItsUnitForm) {
    const Vec3 far{5'000'000, 330'000, 100};
    const auto axes = rotation(33);
    const ShapeDescription shape{ShapeKind::kBox,
                                 far + Vec3{20, 30, 40},
                                 3.0 * axes[0],
                                 2.0 * axes[1] + 0.5 * axes[0],
                                 5.0 * axes[2],
                                 17,
                                 false};
    const RenderSpace space{far, 100};
    const gpu::Shape packed = packShape(space, shape);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 100; ++i) {
        const Vec3 local{unit(random), unit(random), unit(random)};
        const Long3 center = longOf(shape.center), u = longOf(shape.u), v = longOf(shape.v), w = longOf(shape.w);
        Long3 world;
        for (int k = 0; k < 3; ++k) world[k] = center[k] + local.x * u[k] + local.y * v[k] + local.z * w[k];
        const Long3 point = renderPointOf(space, world);
        // local coordinates are about 20 at the origin of render space
        EXPECT_NEAR(applied(packed.row_x, point), local.x, 5e-6);
        EXPECT_NEAR(applied(packed.row_y, point), local.y, 5e-6);
        EXPECT_NEAR(applied(packed.row_z, point), local.z, 5e-6);
    }
    EXPECT_EQ(packed.kind.x, std::uint32_t{SHAPE_BOX});
    EXPECT_EQ(packed.kind.y, 17u);
    EXPECT_EQ(packed.kind.z, SHAPE_UNSEEN_BY_CAMERA);
}

TEST(PackShape, StoresEachKind) {
    const std::pair<ShapeKind, std::uint32_t> kinds[] = {{ShapeKind::kPlane, SHAPE_PLANE},
                                                         {ShapeKind::kDisc, SHAPE_DISC},
                                                         {ShapeKind::kQuad, SHAPE_QUAD},
                                                         {ShapeKind::kBox, SHAPE_BOX},
                                                         {ShapeKind::kSphere, SHAPE_SPHERE}};
    for (const auto& [kind, number] : kinds) {
        ShapeDescription shape;
        shape.kind = kind;
        EXPECT_EQ(packShape({}, shape).kind.x, number);
        EXPECT_EQ(packShape({}, shape).kind.z, 0u);
    }
}

// A light one metre away gives the same irradiance for any render unit.
TEST(PackLight, KeepsIrradianceAndRadiance) {
    const RenderSpace space{{10, 0, 0}, 4};
    const gpu::Light point = packLight(space, PointLight{{12, 4, 8}, {32, 16, 8}});
    expectRow(point.position, 0.5f, 1, 2, LIGHT_POINT);
    EXPECT_EQ(point.power.x, 2);
    EXPECT_EQ(point.power.z, 0.5f);
    const gpu::Light spot = packLight(space, SpotLight{{12, 4, 8}, {0, 0, -1}, 60, 0, {32, 16, 8}});
    EXPECT_EQ(spot.position.w, LIGHT_SPOT);
    EXPECT_EQ(spot.power.y, 1);
    expectRow(spot.axis, 0, 0, -1, 0.5f);
    EXPECT_EQ(spot.edge_u.x, 1);
    const gpu::Light sun = packLight(space, SunLight{{0, 1, 0}, 0, {3, 2, 1}});
    expectRow(sun.axis, 0, 1, 0, 1);
    EXPECT_EQ(sun.position.w, LIGHT_SUN);
    EXPECT_EQ(sun.power.x, 3);
    EXPECT_NEAR(packLight(space, SunLight{{0, 1, 0}, 60, {3, 2, 1}}).axis.w, 0.5, 1e-7);
    const gpu::Light sphere = packLight(space, SphereLight{{14, 0, 0}, 2, {5, 6, 7}});
    expectRow(sphere.position, 1, 0, 0, LIGHT_SPHERE);
    EXPECT_EQ(sphere.axis.w, 0.5f);
    EXPECT_EQ(sphere.power.y, 6);
    const gpu::Light quad = packLight(space, QuadLight{{14, 0, 0}, {2, 0, 0}, {0, 8, 0}, {5, 6, 7}, true});
    expectRow(quad.position, 1, 0, 0, LIGHT_QUAD);
    expectRow(quad.axis, 0, 0, 1, 0);
    expectRow(quad.edge_u, 0.5f, 0, 0, 0);
    expectRow(quad.edge_v, 0, 2, 0, 0);
    EXPECT_EQ(quad.power.z, 7);
}

TEST(PackLight, PutsDiscsInTheirPlane) {
    const RenderSpace space{{10, 0, 0}, 4};
    const LightDescription disc = DiscLight{{14, 0, 0}, {0, 0, 1}, 2, {5, 6, 7}, false};
    const gpu::Light row = packLight(space, disc);
    expectRow(row.position, 1, 0, 0, LIGHT_DISC);
    expectRow(row.axis, 0, 0, 1, 0);
    for (const gpu::vec4& edge : {row.edge_u, row.edge_v}) {
        EXPECT_NEAR(std::hypot(edge.x, edge.y), 0.5, 1e-7);
        EXPECT_EQ(edge.z, 0);
    }
    const gpu::Shape shape = lampShape(space, disc, 3).value();
    EXPECT_EQ(shape.kind.x, std::uint32_t{SHAPE_DISC});
    EXPECT_EQ(shape.kind.z, SHAPE_UNSEEN_BY_CAMERA);
    // a point of the rim, half a unit from the centre, is at distance 1 in the shape's unit form
    EXPECT_NEAR(std::hypot(shape.row_x.x * 1.5 + shape.row_x.w, shape.row_y.x * 1.5 + shape.row_y.w), 1, 1e-6);
    EXPECT_EQ(lampMaterial(disc, 9).value().emission.z, 7);
}

TEST(PackLight, GivesSpheresAndQuadsASurface) {
    const RenderSpace space{{10, 0, 0}, 4};
    const LightDescription sphere = SphereLight{{14, 0, 0}, 2, {5, 6, 7}, false};
    const gpu::Shape round = lampShape(space, sphere, 3).value();
    EXPECT_EQ(round.kind.x, std::uint32_t{SHAPE_SPHERE});
    EXPECT_EQ(round.kind.y, 3u);
    EXPECT_EQ(round.kind.z, SHAPE_UNSEEN_BY_CAMERA);
    expectRow(round.row_x, 2, 0, 0, -2);
    expectRow(round.row_y, 0, 2, 0, 0);
    const LightDescription quad = QuadLight{{14, 0, 0}, {2, 0, 0}, {0, 8, 0}, {5, 6, 7}, true};
    const gpu::Shape flat = lampShape(space, quad, 4).value();
    EXPECT_EQ(flat.kind.x, std::uint32_t{SHAPE_QUAD});
    EXPECT_EQ(flat.kind.z, 0u);
    expectRow(flat.row_x, 2, 0, 0, -2);
    expectRow(flat.row_y, 0, 0.5f, 0, 0);
    const gpu::Material material = lampMaterial(quad, 9).value();
    EXPECT_EQ(std::bit_cast<std::uint32_t>(material.emission.w), 9u);
    EXPECT_EQ(material.emission.y, 6);
    EXPECT_EQ(material.base.x, 0);
    EXPECT_FALSE(lampShape(space, PointLight{}, 0).has_value());
    EXPECT_FALSE(lampMaterial(SunLight{}, 0).has_value());
}

TEST(PackMaterial, PutsEachPropertyInItsPlace) {
    MaterialDescription glass;
    glass.kind = MaterialKind::kGlass;
    glass.color = {0.1f, 0.2f, 0.3f};
    glass.roughness = 0.4f;
    glass.index = 1.7f;
    glass.thin = true;
    glass.absorption = {1, 2, 3};
    glass.emission = {4, 5, 6};
    const gpu::Material packed = packMaterial({{1, 2, 3}, 10}, glass);
    EXPECT_EQ(packed.gloss.x, MATERIAL_GLASS);
    EXPECT_EQ(packed.gloss.y, 0.4f);
    EXPECT_EQ(packed.gloss.z, 1.7f);
    EXPECT_EQ(packed.base.y, 0.2f);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(packed.base.w), MATERIAL_THIN);
    EXPECT_EQ(packed.absorption.y, 20) << "per render unit, which is ten world units";
    EXPECT_EQ(packed.emission.z, 6);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(packed.emission.w), NO_LIGHT);
    MaterialDescription matte;
    matte.splat_color = true;
    matte.mirror_share = 0.25f;
    matte.specular = 0.5f;
    matte.shininess = 80;
    const gpu::Material plain = packMaterial({}, matte);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(plain.base.w), MATERIAL_USES_SPLAT_COLOR);
    EXPECT_EQ(plain.gloss.x, MATERIAL_MATTE);
    EXPECT_EQ(plain.gloss.w, 0.25f);
    EXPECT_EQ(plain.phong.x, 0.5f);
    EXPECT_EQ(plain.phong.y, 80);
}

} // namespace
} // namespace pointrt
