// SPDX-License-Identifier: Apache-2.0
#include "preprocess/ingest/attribute_names.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

TEST(AttributeNames, SpellingsMapToOneName) {
    for (const char* written : {"intensity", "Intensity", "INTENSITY", "scalar_Intensity", "Scalar_intensity"})
        EXPECT_EQ(attributeName(written), "intensity") << written;
    for (const char* written : {"GpsTime", "gps_time", "scalar_GpsTime", "gps time", "Gps_Time"})
        EXPECT_EQ(attributeName(written), "gps_time") << written;
    EXPECT_EQ(attributeName("scalar_Number_Of_Returns"), "number_of_returns");
    EXPECT_EQ(attributeName("class"), "classification");
    EXPECT_EQ(attributeName("EdgeOfFlightLine"), "edge_of_flight_line");
    EXPECT_EQ(attributeName("ScanAngleRank"), "scan_angle_rank");
}

TEST(AttributeNames, OthersStay) {
    for (const char* written : {"label", "scalar_C2C_distances", "Reflectance", "ring", "f", "scalar_", "H\u00f6he"})
        EXPECT_EQ(attributeName(written), written);
    EXPECT_EQ(attributeName("a name of more than thirty-one letters"), "a name of more than thirty-one ");
    EXPECT_EQ(attributeName("thirty letters, then an umlaut\u00fc"), "thirty letters, then an umlaut"); // 32 bytes
    EXPECT_EQ(attributeName("a\xff\x1b[b"), "a??[b");
    EXPECT_EQ(attributeName("\xed\xa0\x80"), "???"); // a surrogate
    EXPECT_EQ(attributeName(""), "");
}

TEST(AttributeNames, NamesAreUnique) {
    AttributeNames names;
    EXPECT_EQ(names.take("Intensity"), "intensity");
    EXPECT_EQ(names.take("scalar_Intensity"), "scalar_Intensity");
    EXPECT_EQ(names.take("scalar_Intensity"), std::nullopt);
    EXPECT_EQ(names.take(""), std::nullopt);
}

} // namespace
} // namespace pointrt
