// SPDX-License-Identifier: Apache-2.0
// Environment lighting on the available Vulkan device: densities sum to one, samples match them, and known pictures
// give the right light.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "runtime/device_scene/environment.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "shaders/environment_probe.spv.h"
#include "tests/runtime/gpu/probe.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

using std::numbers::pi;
constexpr VkBufferUsageFlags kTexels = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

using Vec4 = std::array<float, 4>;

struct Push {
    gpu::EnvironmentFrame environment;
    std::uint32_t count, drawn, unused[2];
};

struct Answer {
    std::array<float, 3> direction;
    float drawn_pdf; ///< of a sampled direction
    std::array<float, 3> radiance;
    float pdf; ///< environmentPdf
};

FloatImage evenImage(std::uint32_t width, std::uint32_t height, float value) {
    return {width, height, std::vector<float>(std::size_t{3} * width * height, value)};
}

void setTexel(FloatImage& image, std::uint32_t x, std::uint32_t y, std::array<float, 3> rgb) {
    std::copy(rgb.begin(), rgb.end(), &image.rgb[3 * (std::size_t{y} * image.width + x)]);
}

/// Dim light with structure in every texel, black parts, and lamps a thousand times as bright.
FloatImage roomImage(std::uint32_t width, std::uint32_t height) {
    FloatImage image = evenImage(width, height, 0);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const auto wave = static_cast<float>(0.5 + 0.4 * std::sin(x * 0.7) * std::cos(y * 1.1));
            const bool black = x > width / 2 && x < width * 3 / 4 && y > height / 2;
            if (!black) setTexel(image, x, y, {wave, wave * wave, 1 - wave});
        }
    setTexel(image, width / 5, height / 4, {900, 800, 700});
    setTexel(image, width - 1, height / 2, {100, 300, 500});
    setTexel(image, 3, 0, {2000, 2000, 2000});
    return image;
}

/// Points of [0, 1)^2 by Roberts' R2 sequence: low discrepancy, not a grid.
std::vector<Vec4> evenPoints(std::uint32_t count) {
    std::vector<Vec4> points(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0), v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
        points[i] = {std::min(static_cast<float>(u), 0x1.fffffep-1f), std::min(static_cast<float>(v), 0x1.fffffep-1f)};
    }
    return points;
}

/// The inverse of the map's convention, in double precision.
Vec3 directionTo(double u, double v) {
    const double phi = 2 * pi * (u - 0.5), theta = pi * v;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

Vec4 packed(Vec3 d) { return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z), 0}; }

constexpr std::array<Vec3, 3> kUpright = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

class EnvironmentTest : public DeviceFixture {
protected:
    void SetUp() override {
        program = createProgram(device, "environment_probe", environment_probe_spv);
        pool = createDescriptorPool(device, 64);
    }
    void TearDown() override {
        destroyDescriptorPool(device, pool);
        destroyProgram(device, program);
    }

    Buffer texelBuffer(const void* data, std::uint64_t bytes, VkFormat format) {
        Buffer buffer = createFilledBuffer(device, "texels", data, bytes, kTexels);
        createTexelView(device, "texels", buffer, format);
        return buffer;
    }

    std::vector<Answer> evaluate(const Environment& environment, const gpu::EnvironmentFrame& frame, bool drawn,
                                 const std::vector<Vec4>& queries) {
        const auto count = static_cast<std::uint32_t>(queries.size());
        std::array buffers = {
            texelBuffer(environment.texels.data(), environment.texels.size() * 4, VK_FORMAT_R32G32B32A32_SFLOAT),
            texelBuffer(environment.cdf.data(), environment.cdf.size() * 4, VK_FORMAT_R32_SFLOAT),
            texelBuffer(queries.data(), count * sizeof(Vec4), VK_FORMAT_R32G32B32A32_SFLOAT),
            createBuffer(device, "answers", count * sizeof(Answer), kStorage)};
        const VkDescriptorSet set = createDescriptorSet(
            device, pool, program, bindingsInOrder({&buffers[0], &buffers[1], &buffers[2], &buffers[3]}));
        const Push push{frame, count, drawn, {}};
        const VkCommandBuffer commands = beginCommands(device);
        recordDispatch(commands, program, set, pushBytes(push), {(count + 63) / 64, 1, 1});
        submitAndWait(device, commands);
        std::vector<Answer> answers(count);
        downloadBuffer(device, buffers[3], answers.data(), count * sizeof(Answer));
        for (Buffer& buffer : buffers) destroyBuffer(device, buffer);
        return answers;
    }
    std::vector<Answer> draw(const Environment& environment, std::uint32_t count) {
        return evaluate(environment, environmentFrame(environment, kUpright, 1), true, evenPoints(count));
    }
    std::vector<Answer> look(const Environment& environment, const std::vector<Vec4>& directions) {
        return evaluate(environment, environmentFrame(environment, kUpright, 1), false, directions);
    }

    Program program;
    VkDescriptorPool pool = VK_NULL_HANDLE;

private:
};

/// Directions to the centres of a fine grid, and the solid angle of each of its rows.
struct Sphere {
    std::uint32_t width = 1500, height = 751; // not a multiple of the pictures' sizes
    std::vector<Vec4> directions;
    Sphere() {
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x)
                directions.push_back(packed(directionTo((x + 0.5) / width, (y + 0.5) / height)));
    }
    double solidAngle(std::size_t i) const {
        const double row = static_cast<double>(i / width), step = pi / height;
        return 2 * pi / width * (std::cos(row * step) - std::cos((row + 1) * step));
    }
};

TEST_F(EnvironmentTest, Densities_SumToOne) {
    const Sphere sphere;
    for (const FloatImage& image : {roomImage(64, 32), roomImage(300, 211), evenImage(1, 1, 2), evenImage(16, 8, 0)}) {
        const Environment environment = makeEnvironment(image);
        const std::vector<Answer> answers = look(environment, sphere.directions);
        double sum = 0;
        for (std::size_t i = 0; i < answers.size(); ++i) sum += answers[i].pdf * sphere.solidAngle(i);
        EXPECT_NEAR(sum, 1, 0.005) << image.width;
    }
}

TEST_F(EnvironmentTest, Samples_IntegrateToThePicture) {
    FloatImage one = evenImage(64, 32, 0);
    setTexel(one, 21, 9, {100, 50, 25});
    FloatImage seam = evenImage(64, 32, 0.01f);
    setTexel(seam, 0, 0, {1000, 50, 25});
    for (const FloatImage& image : {one, seam, roomImage(64, 32), roomImage(1000, 600), evenImage(7, 3, 1.5f)}) {
        const Environment environment = makeEnvironment(image);
        const std::uint32_t count = 200'000;
        std::array<double, 3> sum{};
        for (const Answer& answer : draw(environment, count)) {
            ASSERT_GT(answer.drawn_pdf, 0);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += answer.radiance[c] / answer.drawn_pdf / count;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = 4 * pi * environment.mean_radiance[c];
            EXPECT_NEAR(sum[c], expected, 0.01 * expected) << image.width << " channel " << c;
        }
    }
}

// The light of one texel of 64 x 32, by hand: the integral of sin(theta) times a tent two texels wide.
TEST_F(EnvironmentTest, OneTexel_HasItsShare) {
    FloatImage image = evenImage(64, 32, 0);
    setTexel(image, 40, 16, {10, 10, 10});
    const double step = pi / 32, solid_angle = step * std::sin(16.5 * step) * 2 * (1 - std::cos(step)) / step;
    const Environment environment = makeEnvironment(image);
    EXPECT_NEAR(4 * pi * environment.mean_radiance[1], 10 * solid_angle, 1e-6);
    double sum = 0;
    for (const Answer& answer : draw(environment, 100'000)) sum += answer.radiance[1] / answer.drawn_pdf / 100'000;
    EXPECT_NEAR(sum, 10 * solid_angle, 0.1 * solid_angle);
}

/// The solid angle of all cells that can be sampled, which is the mean of 1 / pdf.
double litSolidAngle(const Environment& environment) {
    const std::size_t rows = environment.rows, columns = environment.columns;
    double sum = 0;
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x) {
            const float* row = &environment.cdf[rows + 1 + y * (columns + 1)];
            const bool lit = row[x + 1] > row[x] && environment.cdf[y + 1] > environment.cdf[y];
            const double step = pi / static_cast<double>(rows), top = static_cast<double>(y) * step;
            if (lit) sum += 2 * pi / static_cast<double>(columns) * (std::cos(top) - std::cos(top + step));
        }
    return sum;
}

TEST_F(EnvironmentTest, Samples_MatchTheirDensity) {
    for (const FloatImage& image : {roomImage(64, 32), roomImage(900, 450)}) {
        const Environment environment = makeEnvironment(image);
        const std::vector<Answer> answers = draw(environment, 100'000);
        std::size_t different = 0;
        const double lit = litSolidAngle(environment);
        double inverse_sum = 0;
        for (const Answer& answer : answers) {
            const float* d = answer.direction.data();
            ASSERT_NEAR(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1, 1e-5);
            different += std::abs(answer.pdf - answer.drawn_pdf) > 1e-3 * answer.drawn_pdf;
            inverse_sum += 1 / static_cast<double>(answer.drawn_pdf) / static_cast<double>(answers.size());
        }
        // a direction on the edge of a cell may be attributed to its neighbour
        EXPECT_LE(different, answers.size() / 500) << image.width;
        // all but the interior of the black part, which is an eighth of the sphere
        EXPECT_GT(lit, 4 * pi * 0.87);
        EXPECT_LT(lit, 4 * pi * 0.93);
        EXPECT_NEAR(inverse_sum, lit, 0.01 * lit) << image.width;
    }
}

TEST_F(EnvironmentTest, Directions_FollowTheConvention) {
    FloatImage image = evenImage(8, 4, 0);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) setTexel(image, x, y, {static_cast<float>(x), static_cast<float>(y), 1});
    const Environment environment = makeEnvironment(image);
    // ahead, right, behind, left: on the horizon, between rows 1 and 2; behind is between columns 7 and 0
    const std::vector<Answer> around =
        look(environment, {{0, 0, -1, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}, {0, -1, 0, 0}});
    const float columns[] = {3.5f, 5.5f, 3.5f, 1.5f};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(around[i].radiance[0], columns[i], 1e-4) << i;
        EXPECT_NEAR(around[i].radiance[1], 1.5f, 1e-4) << i;
    }
    EXPECT_NEAR(around[4].radiance[1], 0, 1e-4);
    EXPECT_NEAR(around[5].radiance[1], 3, 1e-4);
    const std::vector<Answer> centre = look(environment, {packed(directionTo(6.5 / 8, 0.5 / 4))});
    EXPECT_NEAR(centre[0].radiance[0], 6, 1e-3);
    EXPECT_NEAR(centre[0].radiance[1], 0, 1e-3);
}

TEST_F(EnvironmentTest, Density_FollowsBilinearInterpolation) {
    const FloatImage image = roomImage(4096, 64);
    const Environment environment = makeEnvironment(image);
    std::vector<Vec4> directions;
    std::vector<float> expected;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const std::uint32_t x = (i * 1237) % 4096, y = 2 + (i * 31) % 60;
        directions.push_back(packed(directionTo((x + 0.5) / 4096, (y + 0.5) / 64)));
        expected.push_back(image.rgb[3 * (std::size_t{y} * 4096 + x)]);
    }
    const std::vector<Answer> answers = look(environment, directions);
    // 0.005 texels in the columns, where neighbours differ by up to 0.3
    for (std::size_t i = 0; i < answers.size(); ++i)
        if (expected[i] < 1) {
            ASSERT_NEAR(answers[i].radiance[0], expected[i], 0.004) << i;
        }
}

TEST_F(EnvironmentTest, Rotation_IsAppliedToTheWorld) {
    FloatImage image = evenImage(64, 32, 1);
    setTexel(image, 31, 15, {500, 500, 500});
    setTexel(image, 32, 16, {500, 500, 500});
    const Environment environment = makeEnvironment(image);
    struct Case {
        Vec3 up;
        double rotation_deg;
        Vec3 lamp;
    };
    for (const Case& turned : {Case{{0, 1, 0}, 0, {0, 0, -1}}, Case{{0, 1, 0}, 90, {-1, 0, 0}},
                               Case{{0, 0, 1}, 0, {0, 1, 0}}, Case{{0, 0, 1}, -90, {1, 0, 0}}}) {
        const auto frame = environmentFrame(environment, mapFromWorld(turned.up, turned.rotation_deg), 2);
        const std::vector<Answer> there = evaluate(environment, frame, false, {packed(turned.lamp), packed(turned.up)});
        EXPECT_NEAR(there[0].radiance[0], 2 * 250.5, 5);
        EXPECT_NEAR(there[1].radiance[0], 2, 1e-3);
        double towards = 0;
        const std::vector<Answer> draws = evaluate(environment, frame, true, evenPoints(10'000));
        for (const Answer& answer : draws)
            towards += turned.lamp.x * answer.direction[0] + turned.lamp.y * answer.direction[1] +
                       turned.lamp.z * answer.direction[2];
        EXPECT_GT(towards / 10'000, 0.3); // 2 of 500 texels emit a third more than all the others
    }
}

TEST(Environment, LargePictures_AreDownsampled) {
    FloatImage image = evenImage(10'000, 20, 0.5f);
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) image.rgb[i] = i / 3 % 10'000 < 5'000 ? 4.0f : 0.0f;
    const Environment environment = makeEnvironment(image);
    EXPECT_EQ(environment.width, 4096u);
    EXPECT_EQ(environment.height, 20u);
    EXPECT_EQ(environment.columns, 512u);
    EXPECT_EQ(environment.rows, 20u);
    EXPECT_EQ(environment.texels.size(), 4u * 4096 * 20);
    EXPECT_EQ(environment.cdf.size(), 21u + 20 * 513);
    EXPECT_NEAR(environment.mean_radiance[0], 2, 1e-4);
    EXPECT_NEAR(environment.mean_radiance[2], 0.5, 1e-5);
    EXPECT_EQ(environment.texels[4 * 2047], 4);
    EXPECT_EQ(environment.texels[4 * 2048], 0);
    EXPECT_EQ(environment.texels[3], 1);
}

TEST(Environment, Distributions_RiseFromZeroToOne) {
    const Environment environment = makeEnvironment(roomImage(700, 300));
    const auto expectRise = [&](std::size_t first, std::size_t count) {
        const auto begin = environment.cdf.begin() + static_cast<std::ptrdiff_t>(first);
        EXPECT_EQ(*begin, 0);
        EXPECT_EQ(begin[static_cast<std::ptrdiff_t>(count)], 1);
        EXPECT_TRUE(std::is_sorted(begin, begin + static_cast<std::ptrdiff_t>(count) + 1));
    };
    expectRise(0, environment.rows);
    for (std::size_t y = 0; y < environment.rows; ++y)
        expectRise(environment.rows + 1 + y * (environment.columns + 1), environment.columns);
}

} // namespace
} // namespace pointrt
