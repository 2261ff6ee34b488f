// SPDX-License-Identifier: Apache-2.0
// Damaged files: each byte of a small valid file changed to critical values must be read or refused.
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using HostileTest = InputTest;

struct Sample {
    std::string name, bytes;
};

std::vector<Sample> samples() {
    const std::string floats = bytesOf(1.f) + bytesOf(2.f) + bytesOf(3.f);
    return {
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n4 5 6\n3 0 1 0\n"},
        {"b.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float "
                  "y\nproperty float z\n"
                  "element face 1\nproperty list uint int vertex_indices\nend_header\n" +
                      floats + bytesOf(3u) + bytesOf(0) + bytesOf(0) + bytesOf(0)},
        {"c.pcd",
         "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n" +
             floats},
        {"d.pcd", "VERSION .7\nFIELDS x y z\nWIDTH 1\nHEIGHT 1\nDATA binary_compressed\n" + bytesOf(13u) +
                      bytesOf(12u) + "\x0b" + floats},
        {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 -1//1\n"},
        {"f.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"g.csv", "x,y,z,r,g,b\n1,2,3,4,5,6\n1,2,3,4,5,6\n"},
        {"h.pts", "2\n1 2 3 4 5 6 7\n1 2 3 4 5 6 7\n"},
        {"i.csv", "X,Y,Z,Intensity,Class,GpsTime\n1,2,3,4,5,6.5\n1,2,3,4,5,6.5\n"},
        {"j.ptx", "1\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 0.5\n0 0 0 0.5\n"},
        {"k.splat", floats + floats + std::string("\1\2\3\xff\xff\x80\x80\x80", 8)},
        {"l.spz", "NGSP" + bytesOf(2u) + bytesOf(1u) + std::string("\0\x0c\0\0", 4) + std::string(9, '\1') + "\xff" +
                      std::string(9, '\x80')},
        {"m.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                  "z\nproperty float f_dc_0\n"
                  "property float f_dc_1\nproperty float f_dc_2\nproperty float opacity\nproperty float "
                  "scale_0\nproperty float scale_1\n"
                  "property float rot_0\nproperty float rot_1\nproperty float rot_2\nproperty float rot_3\nend_header\n"
                  "1 2 3 0 0 0 9 -1 -2 1 0 0 0\n"},
        {"z.conf", "bmesh none.ply 0 0 0 0 0 0 1\n"},
    };
}

TEST_F(HostileTest, ChangedBytes) {
    for (const Sample& sample : samples())
        for (std::size_t i = 0; i < sample.bytes.size(); ++i)
            for (const char byte : {'\0', '\xff', '9', '-', ' ', '\n', '\x7f'}) {
                std::string bytes = sample.bytes;
                bytes[i] = byte;
                const std::string path = write(sample.name, bytes);
                try {
                    readInputs({path}, {});
                } catch (const Error& error) {
                    ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
                    ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
                }
            }
}

TEST_F(HostileTest, LinesMissingTwiceAndSwapped) {
    for (const Sample& sample : samples())
        for (std::size_t i = 0; i < sample.bytes.size(); i += 3)
            for (std::size_t size = 1; size < 40; size += 6) {
                std::string without = sample.bytes, twice = sample.bytes;
                without.erase(i, size);
                twice.insert(i, sample.bytes.substr(i, size));
                for (const std::string& bytes : {without, twice}) {
                    const std::string path = write(sample.name, bytes);
                    try {
                        readInputs({path}, {});
                    } catch (const Error& error) {
                        ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
                    }
                }
            }
}

} // namespace
} // namespace pointrt
