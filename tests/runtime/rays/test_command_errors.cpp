// SPDX-License-Identifier: Apache-2.0
// pointrt-rays cast on what is wrong: one line, the exit code, nothing half-written.
#include <limits>

#include "tests/runtime/rays/cast_command.h"

namespace pointrt::test {
namespace {

const std::string kCast = POINTRT_RAYS " cast plane.pro --rays ";

TEST_F(CastCommand, ArraysThatHoldNoRaysAreRefused) {
    const std::string numbers(96, '\0');
    const auto array = [&](const std::string& descr, const std::string& order, const std::string& shape,
                           std::size_t bytes) {
        folder.write("rays.npy",
                     arrayBytes("{'descr': " + descr + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }",
                                numbers.data(), bytes));
    };
    const auto refused = [&](const std::string& reason) {
        expectRefused(1, "rays.npy: " + reason, kCast + "rays.npy -o out.npz");
    };
    array("'<i4'", "False", "(2, 6)", 48);
    refused("its numbers are '<i4', where rays are float32 ('<f4') or float64 ('<f8')");
    array("'>f8'", "False", "(2, 6)", 96);
    refused("its numbers are '>f8', where rays are float32 ('<f4') or float64 ('<f8')");
    array("'<f8'", "False", "(2, 3)", 48);
    refused("its shape is (2, 3), where rays are (N, 6): origin and direction");
    array("'<f8'", "False", "(6,)", 48);
    refused("its shape is (6,), where rays are (N, 6): origin and direction");
    array("'<f8'", "True", "(2, 6)", 96);
    refused("it is in Fortran order: save numpy.ascontiguousarray of it");
    array("'<f8'", "False", "(3, 6)", 96);
    refused("ends in ray 2 of 3");
    array("'<f8'", "False", "(18446744073709551615, 6)", 96);
    refused("ends in ray 2 of 18446744073709551615");
    array("'<f8'", "False", "2, 6", 96);
    refused("its header has no shape");
    array("'<f8'", "Maybe", "(2, 6)", 96);
    refused("its header has no order");
    folder.write("rays.npy", rayArray(kTwoRays) + "x");
    refused("goes on behind its 2 rays");
    folder.write("rays.npy", rayArray(kTwoRays).substr(0, 40));
    refused("cut short in its header");
    folder.write("rays.npy", std::string("\x93NUMPY\x07\x00\x02\x00{}", 12));
    refused("an array of a version that is not known here");
    folder.write("rays.npy", std::string("\x93NUMPY\x02\x00\xFF\xFF\xFF\x7F", 12));
    refused("its header is too long");
}

TEST_F(CastCommand, RaysThatAreNoneAreToldByTheirRow) {
    std::vector<double> rays(6 * 300000, 1.0); // the second chunk
    rays[6 * 299999 + 4] = std::numeric_limits<double>::quiet_NaN();
    folder.write("rays.npy", rayArray(rays));
    expectRefused(1, "rays.npy: ray 299999: the direction is not finite", kCast + "rays.npy -o out.npz");
    expectRefused(1, "standard input: ray 299999: the direction is not finite", kCast + "- --any -o out.npz <rays.npy");
    folder.write("zero.csv", "x y z dx dy dz\n1 2 3 0 0 1\n1 2 3 0 0 0\n");
    expectRefused(1, "zero.csv:3: the direction is 0", kCast + "zero.csv -o out.npz");
    folder.write("zero.csv", "1 2 inf 0 0 1\n");
    expectRefused(1, "zero.csv:1: the origin is not finite", kCast + "zero.csv -o out.npz");
}

TEST_F(CastCommand, TextThatIsNoRaysIsToldByItsLine) {
    const auto refused = [&](const std::string& lines, const std::string& reason) {
        folder.write("rays.csv", lines);
        expectRefused(1, "rays.csv:" + reason, kCast + "rays.csv -o out.npz");
    };
    refused("1 2 3 0 0 1\n1,2,3,0,0\n", "2: there are 5 numbers, where a ray has 6: origin and direction");
    refused("1 2 3 0 0 1 7\n", "1: there are 7 numbers, where a ray has 6: origin and direction");
    refused("a b c\n1 2 3 0 0 one\n", "2: \"one\" is no number");
    refused("1 2 3 0 0 1\nx y z\n", "2: \"x\" is no number");
    refused("1 2 3 0 0 1e999\n", "1: \"1e999\" is no number");
    refused("1 2 3 0x1 0 1\n", "1: \"0x1\" is no number");
    refused(std::string(1 << 17, '7'), "1: a line without end: no list of rays");
}

TEST_F(CastCommand, FilesThatAreNotThereAreToldByTheirName) {
    folder.write("rays.npy", rayArray(kTwoRays));
    expectRefused(1, "missing.npy: No such file or directory", kCast + "missing.npy -o out.npz");
    expectRefused(1, ".: Is a directory", kCast + ". -o out.npz");
    const std::string rays = " --rays rays.npy -o out.npz";
    expectRefused(1, "missing.pro: No such file or directory", POINTRT_RAYS " cast missing.pro" + rays);
    expectRefused(1, "site.proset/set.json: No such file or directory", POINTRT_RAYS " cast site.proset" + rays);
    expectRefused(4, "nowhere/hits.npz: the folder does not exist", kCast + "rays.npy -o nowhere/hits.npz");
    expectRefused(4, "nowhere/stats.json: the folder does not exist",
                  kCast + "rays.npy -o out.npz --stats nowhere/stats.json");
}

TEST_F(CastCommand, WrongUsageIsExitTwo) {
    folder.write("rays.npy", rayArray(kTwoRays));
    const auto refused = [&](const std::string& reason, const std::string& words) {
        expectRefused(2, reason + " (see --help)", POINTRT_RAYS " " + words);
    };
    refused("a command is missing: cast, lidar, sun, viewshed", "");
    refused("throw: no command; there is cast, lidar, sun, viewshed", "throw plane.pro");
    refused("--rays is required", "cast plane.pro -o out.npz");
    refused("unknown option --ray, did you mean --rays?", "cast plane.pro --ray rays.npy -o out.npz");
    const std::string cast = "cast plane.pro --rays rays.npy ";
    refused("hits.txt: hits are written as .npz, .npy, .csv and .ply, and to - as a stream", cast + "-o hits.txt");
    refused("hits.ply: --any knows no points; .npz, .npy and .csv hold its answers", cast + "--any -o hits.ply");
    refused("rays.npy: is an input", cast + "-o rays.npy");
    refused("plane.pro: is an input", cast + "-o out.npz --stats plane.pro");
    refused("--any and --attributes exclude each other", cast + "-o out.npz --any --attributes intensity");
    refused("--attributes: there is no intensity, but none at all", cast + "-o out.npz --attributes intensity");
    refused("--attributes: t_hit is there already", cast + "-o out.npz --attributes t_hit");
    refused("t_min must be 0 or more and finite, and t_max no less", cast + "-o out.npz --t-min 3 --t-max 2");
    refused("-q and -v exclude each other", cast + "-o out.npz -q -v");
}

TEST_F(CastCommand, ADeviceThatIsNotThereIsExitThree) {
    folder.write("rays.npy", rayArray(kTwoRays));
    const Outcome result = cast("--rays rays.npy -o out.npz --device nonesuch");
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(CastCommand, AReaderThatLeavesEndsIt) {
    folder.write("rays.npy", rayArray(std::vector<double>(6 * 300000, 1.0)));
    const Outcome result = run(POINTRT_RAYS " cast plane.pro --rays rays.npy -o - | head -c 100 >/dev/null");
    EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    if (!std::filesystem::exists("/dev/full")) return;
    const Outcome full = run("(" POINTRT_RAYS " cast plane.pro --rays rays.npy -o - >/dev/full); echo $?");
    EXPECT_EQ(full.out, "4\n") << full.err;
}

} // namespace
} // namespace pointrt::test
