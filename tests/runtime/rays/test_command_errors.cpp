// SPDX-License-Identifier: Apache-2.0
// Errors of pointrt-rays cast: one line, the exit code, no partial output.
#include <limits>

#include "tests/runtime/rays/cast_command.h"

namespace pointrt::test {
namespace {

const std::string kCast = POINTRT_RAYS " cast plane.pro --rays ";

TEST_F(CastCommand, ArraysOfOtherThanRaysAreRefused) {
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
    refused("*type*'<i4'*'<f4'*'<f8'");
    array("'>f8'", "False", "(2, 6)", 96);
    refused("*type*'>f8'*'<f4'*'<f8'");
    array("'<f8'", "False", "(2, 3)", 48);
    refused("*shape*(2, 3)*(N, 6)");
    array("'<f8'", "False", "(6,)", 48);
    refused("*shape*(6,)*(N, 6)");
    array("'<f8'", "True", "(2, 6)", 96);
    refused("*Fortran");
    array("'<f8'", "False", "(3, 6)", 96);
    refused("*ray 2 of 3");
    array("'<f8'", "False", "(18446744073709551615, 6)", 96);
    refused("*ray 2 of 18446744073709551615");
    array("'<f8'", "False", "2, 6", 96);
    refused("*shape*header");
    array("'<f8'", "Maybe", "(2, 6)", 96);
    refused("*fortran_order*header");
    folder.write("rays.npy", rayArray(kTwoRays) + "x");
    refused("*more*2 rays");
    folder.write("rays.npy", rayArray(kTwoRays).substr(0, 40));
    refused("*truncated*header");
    folder.write("rays.npy", std::string("\x93NUMPY\x07\x00\x02\x00{}", 12));
    refused("*version");
    folder.write("rays.npy", std::string("\x93NUMPY\x02\x00\xFF\xFF\xFF\x7F", 12));
    refused("*header*long");
}

TEST_F(CastCommand, InvalidRaysAreNamedByTheirRow) {
    std::vector<double> rays(6 * 300000, 1.0); // in the second chunk
    rays[6 * 299999 + 4] = std::numeric_limits<double>::quiet_NaN();
    folder.write("rays.npy", rayArray(rays));
    expectRefused(1, "rays.npy: ray 299999: *direction*finite", kCast + "rays.npy -o out.npz");
    expectRefused(1, "standard input: ray 299999: *direction*finite", kCast + "- --any -o out.npz <rays.npy");
    folder.write("zero.csv", "x y z dx dy dz\n1 2 3 0 0 1\n1 2 3 0 0 0\n");
    expectRefused(1, "zero.csv:3: *direction*0", kCast + "zero.csv -o out.npz");
    folder.write("zero.csv", "1 2 inf 0 0 1\n");
    expectRefused(1, "zero.csv:1: *origin*finite", kCast + "zero.csv -o out.npz");
}

TEST_F(CastCommand, InvalidTextIsNamedByItsLine) {
    const auto refused = [&](const std::string& lines, const std::string& reason) {
        folder.write("rays.csv", lines);
        expectRefused(1, "rays.csv:" + reason, kCast + "rays.csv -o out.npz");
    };
    refused("1 2 3 0 0 1\n1,2,3,0,0\n", "2: 5 *6");
    refused("1 2 3 0 0 1 7\n", "1: 7 *6");
    refused("a b c\n1 2 3 0 0 one\n", "2: \"one\" *number");
    refused("1 2 3 0 0 1\nx y z\n", "2: \"x\" *number");
    refused("1 2 3 0 0 1e999\n", "1: \"1e999\" *number");
    refused("1 2 3 0x1 0 1\n", "1: \"0x1\" *number");
    refused(std::string(1 << 17, '7'), "1: *long");
}

TEST_F(CastCommand, MissingFilesAreNamed) {
    folder.write("rays.npy", rayArray(kTwoRays));
    expectRefused(1, "missing.npy: No such file or directory", kCast + "missing.npy -o out.npz");
    expectRefused(1, ".: Is a directory", kCast + ". -o out.npz");
    const std::string rays = " --rays rays.npy -o out.npz";
    expectRefused(1, "missing.pro: No such file or directory", POINTRT_RAYS " cast missing.pro" + rays);
    expectRefused(1, "site.proset/set.json: No such file or directory", POINTRT_RAYS " cast site.proset" + rays);
    expectRefused(4, "nowhere/hits.npz: *folder", kCast + "rays.npy -o nowhere/hits.npz");
    expectRefused(4, "nowhere/stats.json: *folder", kCast + "rays.npy -o out.npz --stats nowhere/stats.json");
}

TEST_F(CastCommand, WrongUsageExitsWithTwo) {
    folder.write("rays.npy", rayArray(kTwoRays));
    const auto refused = [&](const std::string& reason, const std::string& words) {
        expectRefused(2, reason + "*(see --help)", POINTRT_RAYS " " + words);
    };
    refused("*command*cast*lidar*sun*viewshed", "");
    refused("throw: *command*cast*lidar*sun*viewshed", "throw plane.pro");
    refused("--rays *required", "cast plane.pro -o out.npz");
    refused("*--ray,*--rays", "cast plane.pro --ray rays.npy -o out.npz");
    const std::string cast = "cast plane.pro --rays rays.npy ";
    refused("hits.txt: *.npz, .npy, .csv", cast + "-o hits.txt");
    refused("hits.ply: --any *.npz", cast + "--any -o hits.ply");
    refused("rays.npy: *input", cast + "-o rays.npy");
    refused("plane.pro: *input", cast + "-o out.npz --stats plane.pro");
    refused("--any *--attributes *combined", cast + "-o out.npz --any --attributes intensity");
    refused("--attributes: *intensity*none", cast + "-o out.npz --attributes intensity");
    refused("--attributes: t_hit *column", cast + "-o out.npz --attributes t_hit");
    refused("t_min *t_max", cast + "-o out.npz --t-min 3 --t-max 2");
    refused("-q *-v *combined", cast + "-o out.npz -q -v");
}

TEST_F(CastCommand, AMissingDeviceExitsWithThree) {
    folder.write("rays.npy", rayArray(kTwoRays));
    const Outcome result = cast("--rays rays.npy -o out.npz --device nonesuch");
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(CastCommand, AClosedPipeEndsTheRun) {
    folder.write("rays.npy", rayArray(std::vector<double>(6 * 300000, 1.0)));
    const Outcome result = run(POINTRT_RAYS " cast plane.pro --rays rays.npy -o - | head -c 100 >/dev/null");
    EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    if (!std::filesystem::exists("/dev/full")) return;
    const Outcome full = run("(" POINTRT_RAYS " cast plane.pro --rays rays.npy -o - >/dev/full); echo $?");
    EXPECT_EQ(full.out, "4\n") << full.err;
}

} // namespace
} // namespace pointrt::test
