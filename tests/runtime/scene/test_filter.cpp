// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/filter.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pointrt {
namespace {

using Ranges = std::vector<ValueRange>;

TEST(Filter, ReadsValuesAndRanges) {
    EXPECT_EQ(parseFilter("class=2,6").shown, (SplatSelection{"class", Ranges{{2, 2}, {6, 6}}}));
    EXPECT_EQ(parseFilter("height=-1.5:2e3").shown, (SplatSelection{"height", Ranges{{-1.5, 2000}}}));
    EXPECT_EQ(parseFilter("rgb16.1=7:7").shown, (SplatSelection{"rgb16.1", Ranges{{7, 7}}}));
    EXPECT_TRUE(parseFilter("class=2").enabled);
}

TEST(Filter, RefusesOtherText) {
    for (const char* text : {"", "class", "=2", "class=", "class=2,", "class=,2", "class=a", "class=2:", "class=:2",
                             "class=3:2", "class=1:2:3", "class=1:2,4", "class=nan", "class=inf", "class= 2"})
        EXPECT_THROW(parseFilter(text), std::invalid_argument) << text;
}

TEST(Filter, HidesOnlyWhereEnabledAndNotEmpty) {
    EXPECT_TRUE(hidesSplats(FilterDescription{{"class", {{2, 2}}}, true, ""}));
    EXPECT_FALSE(hidesSplats(FilterDescription{{"class", {{2, 2}}}, false, ""}));
    EXPECT_FALSE(hidesSplats(FilterDescription{{"class", {}}, true, ""}));
    EXPECT_FALSE(hidesSplats(std::vector<FilterDescription>{}));
}

} // namespace
} // namespace pointrt
