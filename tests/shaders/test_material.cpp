// SPDX-License-Identifier: Apache-2.0
// Materials on the device: energy, densities, reciprocity, refraction.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "runtime/device_scene/ggx_albedo.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "runtime/util/vec.h"
#include "shaders/material_probe.spv.h"
#include "shaders/shared/scene_layout.h"
#include "tests/runtime/gpu/probe.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

using gpu::vec4;
using std::numbers::pi;

/// Input and output of the probe shader (material_probe.comp.glsl).
struct Surface {
    gpu::Material material;
    vec4 albedo, normal, view;
};
struct MaterialAnswer {
    vec4 scattered, weight, evaluated, reflected, reflected_weight, refracted, refracted_weight, rest, classic;
};
constexpr int kTransmitted = 1, kDelta = 2, kSmooth = 4;

vec4 toVec4(Vec3 v, float w = 0) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), w};
}
Vec3 toVec3(vec4 v) { return {v.x, v.y, v.z}; }
bool hasFlag(const MaterialAnswer& answer, int flag) { return (static_cast<int>(answer.weight.w) & flag) != 0; }

gpu::Material makeMaterial(int kind, float roughness = 0.3f, float index = 1.5f, float mirror_share = 0,
                           std::uint32_t bits = 0) {
    return {{1, 1, 1, std::bit_cast<float>(bits)},
            {static_cast<float>(kind), roughness, index, mirror_share},
            {0, 50, 0, 0},
            {},
            {}};
}

/// Normals in general position and at the poles of the frame.
const std::array<Vec3, 4> kNormals = {normalize({0.3, -0.5, 0.8}), {0, 0, -1}, {0, 0, 1}, normalize({-2, 0.1, -0.2})};

struct ShadingFrame {
    Vec3 tangent, bitangent, normal;
};
ShadingFrame frameOf(Vec3 normal) {
    const Vec3 tangent = normalize(cross(normal, std::abs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    return {tangent, cross(normal, tangent), normal};
}
Vec3 directionAt(const ShadingFrame& frame, double cosine, double azimuth) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return frame.tangent * (sine * std::cos(azimuth)) + frame.bitangent * (sine * std::sin(azimuth)) +
           frame.normal * cosine;
}

Surface makeSurface(const gpu::Material& material, float albedo, double cosine, std::size_t normal = 0,
                    bool back = false) {
    const Vec3 n = kNormals[normal];
    return {material,
            {albedo, albedo, albedo, back ? 1.0f : 0.0f},
            toVec4(n),
            toVec4(directionAt(frameOf(n), cosine, 0.7 + static_cast<double>(normal)))};
}

/// Low-discrepancy points in the unit cube (Roberts' R3 sequence, 2018).
std::vector<vec4> evenInputs(std::uint32_t count) {
    std::vector<vec4> inputs(count);
    const double steps[] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    double at[] = {0.5, 0.5, 0.5};
    for (vec4& input : inputs) {
        for (int i = 0; i < 3; i++) at[i] = std::fmod(at[i] + steps[i], 1.0);
        // 1 is out of range, and doubles close to 1 round to it
        input = {static_cast<float>(at[0] * 0.9999999), static_cast<float>(at[1] * 0.9999999),
                 static_cast<float>(at[2] * 0.9999999), 0};
    }
    return inputs;
}

class MaterialTest : public DeviceFixture {
protected:
    static constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

    MaterialTest() {
        program_ = createProgram(device, "material_probe", material_probe_spv);
        const std::vector<GgxAlbedo> table = ggxAlbedoTable();
        table_ = createFilledBuffer(device, "ggx albedo", table.data(), table.size() * sizeof(GgxAlbedo),
                                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
        createTexelView(device, "ggx albedo", table_, VK_FORMAT_R32G32_SFLOAT);
    }
    ~MaterialTest() override {
        destroyBuffer(device, table_);
        destroyProgram(device, program_);
    }

    /// An answer for each input: inputs are random numbers or, if `directions`, light directions.
    std::vector<MaterialAnswer> evaluate(Surface surface, const std::vector<vec4>& inputs, bool directions = false) {
        surface.view.w = directions ? 1.0f : 0.0f;
        Buffer surface_buffer = createFilledBuffer(device, "surface", &surface, sizeof surface, kStorage);
        Buffer input_buffer =
            createFilledBuffer(device, "inputs", inputs.data(), inputs.size() * sizeof(vec4), kStorage);
        Buffer answered = createBuffer(device, "answers", inputs.size() * sizeof(MaterialAnswer), kStorage);
        VkDescriptorPool pool = createDescriptorPool(device, 1);
        const VkDescriptorSet set = createDescriptorSet(
            device, pool, program_, bindingsInOrder({&table_, &surface_buffer, &input_buffer, &answered}));
        const VkCommandBuffer commands = beginCommands(device);
        recordDispatch(commands, program_, set, {}, {(static_cast<std::uint32_t>(inputs.size()) + 63) / 64, 1, 1});
        submitAndWait(device, commands);
        std::vector<MaterialAnswer> answers(inputs.size());
        downloadBuffer(device, answered, answers.data(), answered.bytes);
        destroyDescriptorPool(device, pool);
        destroyBuffer(device, answered);
        destroyBuffer(device, input_buffer);
        destroyBuffer(device, surface_buffer);
        return answers;
    }
    MaterialAnswer evaluateOnce(const Surface& surface, vec4 input = {0.5f, 0.5f, 0.5f, 0}, bool directions = false) {
        return evaluate(surface, {input}, directions)[0];
    }

private:
    Program program_;
    Buffer table_;
};

std::string describe(const Surface& surface) {
    const double cosine = dot(toVec3(surface.normal), toVec3(surface.view));
    return "kind " + std::to_string(static_cast<int>(surface.material.gloss.x)) + ", roughness " +
           std::to_string(surface.material.gloss.y) + ", cosine " + std::to_string(cosine);
}

constexpr float kRoughnesses[] = {0.0f, 0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 1.0f};
constexpr double kCosines[] = {0.1, 0.25, 0.5, 0.8, 1.0};

/// All rough surfaces of the tests, white.
std::vector<Surface> roughSurfaces() {
    std::vector<Surface> surfaces;
    for (const float roughness : kRoughnesses)
        for (const double cosine : kCosines)
            for (const int kind : {MATERIAL_METAL, MATERIAL_PLASTIC})
                surfaces.push_back(makeSurface(makeMaterial(kind, roughness), 1, cosine, surfaces.size() % 4));
    return surfaces;
}

double meanWeight(const std::vector<MaterialAnswer>& answers) {
    double sum = 0;
    for (const MaterialAnswer& answer : answers) sum += answer.weight.y;
    return sum / static_cast<double>(answers.size());
}

TEST_F(MaterialTest, WhiteRoughSurfacesConserveEnergy) {
    const std::vector<vec4> inputs = evenInputs(1 << 15);
    double worst = 0;
    for (const Surface& surface : roughSurfaces()) {
        const double mean = meanWeight(evaluate(surface, inputs));
        EXPECT_NEAR(mean, 1, 0.005) << describe(surface);
        worst = std::max(worst, std::abs(mean - 1));
    }
    RecordProperty("worst", std::to_string(worst));
}

TEST_F(MaterialTest, SmoothSurfacesReflectTheirAlbedo) {
    const std::vector<vec4> inputs = evenInputs(1 << 14);
    for (const double cosine : kCosines) {
        EXPECT_NEAR(meanWeight(evaluate(makeSurface(makeMaterial(MATERIAL_MATTE), 0.5f, cosine), inputs)), 0.5, 1e-5);
        EXPECT_NEAR(meanWeight(evaluate(makeSurface(makeMaterial(MATERIAL_MIRROR), 0.9f, cosine), inputs)), 0.9, 1e-5);
        const gpu::Material half_mirror = makeMaterial(MATERIAL_MATTE, 0.3f, 1.5f, 0.4f);
        EXPECT_NEAR(meanWeight(evaluate(makeSurface(half_mirror, 0.5f, cosine), inputs)), 0.4 + 0.6 * 0.5, 0.001);
        for (const bool back : {false, true}) {
            const Surface glass = makeSurface(makeMaterial(MATERIAL_GLASS), 1, cosine, 1, back);
            EXPECT_NEAR(meanWeight(evaluate(glass, inputs)), 1, 1e-5) << describe(glass);
        }
    }
}

/// Integrals of evaluateBsdf and bsdfPdf over all directions, by the midpoint rule.
struct Integrals {
    double albedo = 0, pdf = 0;
};
// multiples of chiSquare's bins
constexpr int kRings = 208, kSteps = 168;

/// Directions in equal steps of the angle from axis and of the azimuth, with their solid angle in w.
std::vector<vec4> ringDirections(Vec3 axis) {
    std::vector<vec4> directions;
    const ShadingFrame frame = frameOf(axis);
    for (int i = 0; i < kRings; i++)
        for (int j = 0; j < kSteps; j++) {
            // steps grow with the angle, for narrow lobes around axis
            const double x = (i + 0.5) / kRings, angle = pi * x * x;
            const double area = std::sin(angle) * pi * 2 * x / kRings * 2 * pi / kSteps;
            const Vec3 d = directionAt(frame, std::cos(angle), 2 * pi * (j + 0.5) / kSteps);
            directions.push_back(toVec4(d, static_cast<float>(area)));
        }
    return directions;
}

Vec3 mirroredView(const Surface& surface) {
    const Vec3 n = toVec3(surface.normal), wo = toVec3(surface.view);
    return n * (2 * dot(n, wo)) - wo;
}

Integrals integrate(const std::vector<MaterialAnswer>& answers, const std::vector<vec4>& directions) {
    Integrals sum;
    for (std::size_t i = 0; i < answers.size(); i++) {
        sum.albedo += answers[i].evaluated.y * directions[i].w;
        sum.pdf += answers[i].evaluated.w * directions[i].w;
    }
    return sum;
}

TEST_F(MaterialTest, DensitiesAndReflectanceIntegrateToWhatIsSampled) {
    const std::vector<vec4> inputs = evenInputs(1 << 14);
    std::vector<Surface> surfaces = roughSurfaces();
    surfaces.push_back(makeSurface(makeMaterial(MATERIAL_MATTE, 0.3f, 1.5f, 0.25f), 0.5f, 0.6));
    for (const Surface& surface : surfaces) {
        const std::vector<vec4> directions = ringDirections(mirroredView(surface));
        const Integrals integrals = integrate(evaluate(surface, directions, true), directions);
        double kept = 0, smooth = 0;
        for (const MaterialAnswer& answer : evaluate(surface, inputs)) {
            const bool drawn = answer.scattered.w > 0;
            kept += (drawn ? 1.0 : 0.0) / static_cast<double>(inputs.size());
            smooth += (drawn ? answer.weight.y : 0.0) / static_cast<double>(inputs.size());
        }
        EXPECT_NEAR(integrals.pdf, kept, 0.004) << describe(surface);
        EXPECT_NEAR(integrals.albedo, smooth, 0.004) << describe(surface);
    }
}

TEST_F(MaterialTest, WeightsAreEvaluationOverDensity) {
    for (const Surface& surface : roughSurfaces())
        for (const MaterialAnswer& answer : evaluate(surface, evenInputs(512))) {
            if (answer.scattered.w == 0) {
                EXPECT_EQ(answer.weight.y, 0) << describe(surface);
                continue;
            }
            EXPECT_NEAR(answer.scattered.w, answer.evaluated.w, 1e-5 * answer.evaluated.w) << describe(surface);
            EXPECT_NEAR(answer.weight.y, answer.evaluated.y / answer.evaluated.w, 1e-5 * answer.weight.y)
                << describe(surface);
        }
}

/// Chi square of drawn directions against bsdfPdf, in 16 rings by 24 sectors around the mirrored view.
/// @param on_grid answers for the directions of a fine grid (ringDirections)
/// @param degrees degrees of freedom: the number of bins with enough expected samples
double chiSquare(const std::vector<MaterialAnswer>& drawn, const std::vector<MaterialAnswer>& on_grid,
                 const std::vector<vec4>& directions, Vec3 axis, int& degrees) {
    constexpr int kBinRings = 16, kBinSectors = 24;
    const ShadingFrame frame = frameOf(axis);
    std::vector<double> seen(kBinRings * kBinSectors), expected(seen.size());
    const auto binOf = [&](Vec3 d) {
        const double turn = std::atan2(dot(d, frame.bitangent), dot(d, frame.tangent)) / (2 * pi) + 0.5;
        const double x = std::sqrt(std::acos(std::clamp(dot(d, frame.normal), -1.0, 1.0)) / pi);
        return std::min(static_cast<int>(x * kBinRings), kBinRings - 1) * kBinSectors +
               std::min(static_cast<int>(turn * kBinSectors), kBinSectors - 1);
    };
    for (const MaterialAnswer& answer : drawn)
        if (answer.scattered.w > 0) seen[static_cast<std::size_t>(binOf(toVec3(answer.scattered)))] += 1;
    for (std::size_t i = 0; i < directions.size(); i++)
        expected[static_cast<std::size_t>(binOf(toVec3(directions[i])))] +=
            on_grid[i].evaluated.w * directions[i].w * static_cast<double>(drawn.size());
    double sum = 0;
    degrees = 0;
    for (std::size_t i = 0; i < seen.size(); i++) {
        if (expected[i] < 20) continue;
        sum += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
        degrees++;
    }
    return sum;
}

TEST_F(MaterialTest, DirectionsAreDrawnByTheirDensity) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    std::vector<vec4> inputs(1 << 14);
    for (vec4& input : inputs) input = {uniform(random), uniform(random), uniform(random), 0};
    for (const float roughness : {0.15f, 0.4f, 0.9f})
        for (const double cosine : {0.2, 0.7})
            for (const int kind : {MATERIAL_MATTE, MATERIAL_METAL, MATERIAL_PLASTIC}) {
                const Surface surface = makeSurface(makeMaterial(kind, roughness, 1.5f, 0.2f), 0.7f, cosine);
                const Vec3 axis = mirroredView(surface);
                const std::vector<vec4> directions = ringDirections(axis);
                int degrees = 0;
                const double sum = chiSquare(evaluate(surface, inputs), evaluate(surface, directions, true), directions,
                                             axis, degrees);
                EXPECT_GE(degrees, 40) << describe(surface);
                // five standard deviations of chi square
                EXPECT_LT(sum, degrees + 5 * std::sqrt(2.0 * degrees)) << describe(surface);
            }
}

TEST_F(MaterialTest, RoughSurfacesAreReciprocal) {
    const ShadingFrame frame = frameOf(kNormals[0]);
    for (const float roughness : kRoughnesses)
        for (const int kind : {MATERIAL_METAL, MATERIAL_PLASTIC}) {
            Surface surface = makeSurface(makeMaterial(kind, roughness), 0.6f, 0.3);
            surface.albedo = {0.9f, 0.6f, 0.2f, 0};
            const Vec3 a = toVec3(surface.view);
            for (const double cosine : {0.15, 0.5, 0.97})
                for (const double azimuth : {0.0, 2.0, 3.6, 3.9}) {
                    const Vec3 b = directionAt(frame, cosine, azimuth);
                    Surface exchanged = surface;
                    exchanged.view = toVec4(b);
                    const vec4 to_a = evaluateOnce(surface, toVec4(b), true).evaluated;
                    const vec4 to_b = evaluateOnce(exchanged, toVec4(a), true).evaluated;
                    const double at_a = to_a.x / cosine, at_b = to_b.x / 0.3;
                    EXPECT_NEAR(at_a, at_b, 2e-4 * at_a + 1e-7) << describe(surface) << " to " << cosine;
                    EXPECT_GT(at_a, 0) << describe(surface);
                }
        }
}

TEST_F(MaterialTest, ColoredMetalReflectsItsColorAtNormalIncidence) {
    for (const float roughness : {0.05f, 0.3f}) {
        Surface gold = makeSurface(makeMaterial(MATERIAL_METAL, roughness), 1, 1);
        gold.albedo = {1.0f, 0.7f, 0.3f, 0};
        Vec3 mean;
        const std::vector<MaterialAnswer> answers = evaluate(gold, evenInputs(1 << 14));
        for (const MaterialAnswer& answer : answers)
            mean = mean + toVec3(answer.weight) * (1.0 / static_cast<double>(answers.size()));
        EXPECT_NEAR(mean.x, 1, 0.005);
        EXPECT_NEAR(mean.y, 0.7, 0.01);
        EXPECT_NEAR(mean.z, 0.3, 0.01);
    }
}

/// Fresnel's equations in terms of angles, an independent form, for light that passes from index a to index b.
double fresnelByAngles(double incident, double a, double b) {
    const double sine = a / b * std::sin(incident);
    if (sine >= 1) return 1;
    const double refracted = std::asin(sine);
    const double s = std::sin(incident - refracted) / std::sin(incident + refracted);
    const double p = std::tan(incident - refracted) / std::tan(incident + refracted);
    return 0.5 * (s * s + p * p);
}

TEST_F(MaterialTest, GlassFollowsSnellAndFresnel) {
    for (const double index : {1.33, 1.5, 2.4})
        for (const bool back : {false, true})
            for (const double degrees : {1.0, 20.0, 41.0, 41.9, 60.0, 85.0, 89.9}) {
                const double angle = degrees * pi / 180, before = back ? index : 1, behind = back ? 1 : index;
                const Surface glass = makeSurface(makeMaterial(MATERIAL_GLASS, 0.3f, static_cast<float>(index)), 0.8f,
                                                  std::cos(angle), 3, back);
                const MaterialAnswer answer = evaluateOnce(glass);
                const Vec3 n = toVec3(glass.normal), wo = toVec3(glass.view), out = toVec3(answer.refracted);
                const double reflected = fresnelByAngles(angle, before, behind);
                EXPECT_NEAR(answer.reflected_weight.y, reflected, 2e-5) << index << " " << degrees;
                EXPECT_NEAR(answer.refracted_weight.y, 0.8 * (1 - reflected), 2e-5) << index << " " << degrees;
                EXPECT_NEAR(dot(toVec3(answer.reflected), n), dot(n, wo), 1e-6);
                EXPECT_FALSE(hasFlag(answer, kSmooth));
                if (before / behind * std::sin(angle) >= 1) continue;
                EXPECT_NEAR(behind * length(cross(out, n)), before * length(cross(wo, n)), 1e-6) << index;
                EXPECT_NEAR(dot(cross(out, wo), n), 0, 1e-6) << "leaves the plane of incidence";
                EXPECT_NEAR(length(out), 1, 2e-6);
                EXPECT_LT(dot(out, n), 0);
            }
    EXPECT_NEAR(evaluateOnce(makeSurface(makeMaterial(MATERIAL_GLASS), 1, 1)).reflected_weight.y, 0.04, 1e-6);
}

TEST_F(MaterialTest, GlassIsChosenByFresnelAndReflectsAllBeyondTheCriticalAngle) {
    const Surface glass = makeSurface(makeMaterial(MATERIAL_GLASS), 0.8f, 0.25, 0);
    const double reflected = fresnelByAngles(std::acos(0.25), 1, 1.5);
    double share = 0;
    for (const MaterialAnswer& answer : evaluate(glass, evenInputs(4096))) {
        share += hasFlag(answer, kTransmitted) ? 0 : 1.0 / 4096;
        EXPECT_TRUE(hasFlag(answer, kDelta));
        EXPECT_FLOAT_EQ(answer.weight.y, hasFlag(answer, kTransmitted) ? 0.8f : 1.0f);
        EXPECT_EQ(dot(toVec3(answer.scattered), toVec3(glass.normal)) < 0, hasFlag(answer, kTransmitted));
    }
    EXPECT_NEAR(share, reflected, 0.001);
    // 45.6 degrees; the critical angle is 41.8
    const Surface inside = makeSurface(makeMaterial(MATERIAL_GLASS), 0.8f, 0.7, 0, true);
    for (const MaterialAnswer& answer : evaluate(inside, evenInputs(512))) {
        EXPECT_FALSE(hasFlag(answer, kTransmitted));
        EXPECT_EQ(answer.weight.y, 1);
        EXPECT_EQ(answer.refracted_weight.y, 0);
    }
}

TEST_F(MaterialTest, PanesTransmitRaysUndeviated) {
    for (const double cosine : {0.2, 0.6, 1.0}) {
        const gpu::Material material = makeMaterial(MATERIAL_GLASS, 0.3f, 1.5f, 0, MATERIAL_THIN);
        const Surface front = makeSurface(material, 0.9f, cosine),
                      behind = makeSurface(material, 0.9f, cosine, 0, true);
        const MaterialAnswer answer = evaluateOnce(front), other = evaluateOnce(behind);
        EXPECT_LT(length(toVec3(answer.refracted) + toVec3(front.view)), 1e-6);
        const double side = fresnelByAngles(std::acos(cosine) + 1e-9, 1, 1.5);
        EXPECT_NEAR(answer.reflected_weight.y, 2 * side / (1 + side), 2e-5);
        EXPECT_NEAR(answer.refracted_weight.y, 0.9 * (1 - 2 * side / (1 + side)), 2e-5);
        EXPECT_EQ(other.reflected_weight.y, answer.reflected_weight.y);
    }
}

TEST_F(MaterialTest, WhittedsSharesAddUpToOne) {
    std::vector<Surface> surfaces = roughSurfaces();
    surfaces.push_back(makeSurface(makeMaterial(MATERIAL_MATTE, 0.3f, 1.5f, 0.3f), 1, 0.4));
    surfaces.push_back(makeSurface(makeMaterial(MATERIAL_MIRROR), 1, 0.4));
    surfaces.push_back(makeSurface(makeMaterial(MATERIAL_GLASS), 1, 0.4));
    for (const Surface& surface : surfaces) {
        const MaterialAnswer answer = evaluateOnce(surface);
        EXPECT_NEAR(answer.reflected_weight.y + answer.refracted_weight.y + answer.rest.y, 1, 1e-5)
            << describe(surface);
    }
}

TEST_F(MaterialTest, WhittedsMirrorAndLobeAddUpForLightsThatRaysHit) {
    for (const Surface& surface : roughSurfaces()) {
        const std::vector<vec4> directions = ringDirections(mirroredView(surface));
        const std::vector<MaterialAnswer> answers = evaluate(surface, directions, true);
        double lobe = 0;
        for (std::size_t i = 0; i < answers.size(); i++) lobe += answers[i].classic.y * directions[i].w;
        EXPECT_NEAR(lobe + answers[0].reflected_weight.y, 1, 0.006) << describe(surface);
    }
}

TEST_F(MaterialTest, MatteHasPhongsHighlight) {
    Surface surface = makeSurface(makeMaterial(MATERIAL_MATTE), 0.5f, 0.8);
    surface.material.phong = {0.4f, 20, 0, 0};
    const Vec3 n = toVec3(surface.normal), wo = toVec3(surface.view), wi = directionAt(frameOf(n), 0.7, 3.5);
    const Vec3 mirrored = n * (2 * dot(n, wi)) - wi;
    const double highlight = 0.4 / pi * std::pow(dot(mirrored, wo), 20);
    const MaterialAnswer answer = evaluateOnce(surface, toVec4(wi), true);
    EXPECT_GT(highlight, 1e-3);
    EXPECT_NEAR(answer.reflected.w, highlight, 1e-5);
    EXPECT_NEAR(answer.evaluated.y, 0.5 / pi * 0.7, 1e-6);
    EXPECT_NEAR(answer.classic.y, highlight + 0.5 / pi * 0.7, 1e-5);
    EXPECT_EQ(evaluateOnce(surface, toVec4(directionAt(frameOf(n), -0.1, 3.5)), true).reflected.w, 0);
    EXPECT_NEAR(answer.reflected_weight.w, 0.04 + 0.96 * std::pow(0.2, 5), 1e-6); // highlightMirrorShare
    surface.material.phong.x = 0;
    surface.material.gloss.w = 0.125f;
    EXPECT_EQ(evaluateOnce(surface).reflected_weight.w, 0.125f);
    surface.material.phong.x = 0.4f;
    surface.material.gloss.x = MATERIAL_METAL;
    EXPECT_EQ(evaluateOnce(surface, toVec4(wi), true).reflected.w, 0);
}

bool isFinite(const MaterialAnswer& answer) {
    const auto values = std::bit_cast<std::array<float, sizeof(MaterialAnswer) / 4>>(answer);
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

bool inRange(vec4 weight, float most) {
    return std::min({weight.x, weight.y, weight.z}) >= 0 && std::max({weight.x, weight.y, weight.z}) <= most;
}

TEST_F(MaterialTest, NothingIsUndefinedAtTheEdges) {
    const float top = std::nextafter(1.0f, 0.0f);
    std::vector<vec4> numbers;
    for (const float x : {0.0f, 0.5f, top})
        for (const float y : {0.0f, 0.5f, top})
            for (const float z : {0.0f, 0.04f, 0.5f, top}) numbers.push_back({x, y, z, 0});
    for (int kind = MATERIAL_MATTE; kind <= MATERIAL_GLASS; kind++)
        for (const float roughness : {0.0f, 0.5f, 1.0f})
            for (const float index : {1.0f, 4.0f})
                for (const float albedo : {0.0f, 1.0f})
                    for (const double cosine : {-1e-3, 0.0, 1e-7, 1e-3, 1.0})
                        for (const bool back : {false, true}) {
                            const Surface surface = makeSurface(makeMaterial(kind, roughness, index, albedo), albedo,
                                                                cosine, static_cast<std::size_t>(kind) % 4, back);
                            const Vec3 n = toVec3(surface.normal), wo = toVec3(surface.view);
                            for (const MaterialAnswer& answer : evaluate(surface, numbers)) {
                                EXPECT_TRUE(isFinite(answer)) << describe(surface);
                                EXPECT_NEAR(length(toVec3(answer.scattered)), 1, 1e-5) << describe(surface);
                                EXPECT_TRUE(inRange(answer.weight, INFINITY)) << describe(surface);
                                EXPECT_TRUE(inRange(answer.reflected_weight, 1.00001f)) << describe(surface);
                                EXPECT_TRUE(inRange(answer.refracted_weight, 1.00001f)) << describe(surface);
                            }
                            const std::vector<vec4> ways = {toVec4(n), toVec4(n * -1), toVec4(wo), toVec4(wo * -1)};
                            for (const MaterialAnswer& answer : evaluate(surface, ways, true))
                                EXPECT_TRUE(isFinite(answer)) << describe(surface);
                        }
}

} // namespace
} // namespace pointrt
