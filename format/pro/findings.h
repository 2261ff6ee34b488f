// SPDX-License-Identifier: Apache-2.0
// Possible faults of a .pro file: stable numbers, and the sink that receives them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pointrt/pro.h"

namespace pointrt::format {

/// Numbers never change their meaning and are never reused. SPEC.md describes them.
enum class Finding : std::uint32_t {
    kShorterThanHeader = 1001,
    kMagic = 1002,
    kMajorVersion = 1003,
    kFileSize = 1004,
    kHeaderChecksum = 1005,
    kHeaderReserved = 1006,
    kUnknownFlags = 1007,
    kHeaderCounts = 1008,
    kMaxDepthRange = 1009,
    kRadiusMax = 1010,
    kRadiusStep = 1011,
    kBlendSlab = 1012,
    kFrame = 1013,
    kBounds = 1014,
    kGridFrame = 1015,
    kUp = 1016,
    kMetres = 1017,
    kFilledCount = 1018,
    kNoiseMedian = 1019,

    kTableShape = 2001,
    kRequiredUnknown = 2002,
    kSectionTwice = 2003,
    kSectionMissing = 2004,
    kSectionLength = 2005,
    kSectionOutside = 2006,
    kSectionAlignment = 2007,
    kSectionOverlap = 2008,
    kSectionCount = 2009,
    kTableReserved = 2010,
    kPadding = 2011,
    kSectionChecksum = 2012,
    kIndexIncomplete = 2013,
    kAttributeSections = 2014,

    kRootGroup = 3001,
    kGroupNumber = 3002,
    kGroupWithoutParent = 3003,
    kGroupCount = 3004,
    kLeafIndex = 3005,
    kDepth = 3006,
    kLeafOrder = 3007,

    kLeafReserved = 4001,
    kLeafEmpty = 4002,
    kMemberRange = 4003,
    kRefRange = 4004,
    kLeafTotals = 4005,
    kRefIndex = 4006,
    kRefIsMember = 4007,
    kRefTwice = 4008,

    kSplatReserved = 5001,
    kSplatMaterial = 5002,
    kSplatRadius = 5003,
    kSplatOutsideLeaf = 5004,
    kSplatOutsideBounds = 5005,

    kMaterialRange = 6001,
    kMaterialReserved = 6002,

    kOrderTwice = 7001,

    kMetadataUtf8 = 8001,

    kOutOfMemory = 9001,

    kGridBrick = 9101,
    kEmptySkip = 9102,
    kBrickWord = 9103,
    kGroupDepth = 9104,
    kCellCodes = 9106, // 9105 and 9108 belonged to the index of formats before 1.4
    kListSplat = 9107,
    kCellRun = 9109,
    kCellReserved = 9110,
    kCellBlending = 9111,

    kAttributeName = 9201,
    kAttributeType = 9202,
    kAttributeReserved = 9203,
    kAttributeRange = 9204,
    kAttributeValues = 9205,

    kSensor = 9301,

    kFilledOrder = 9401,
    kNoiseValues = 9402,

    kGaussianCoding = 9501,
    kGaussiansIncomplete = 9502,
    kGaussianRootGroup = 9503,
    kGaussianGroupNumber = 9504,
    kGaussianGroupWithoutParent = 9505,
    kGaussianGroupCount = 9506,
    kGaussianDepth = 9507,
    kGaussianLists = 9508,
    kGaussianIndex = 9509,
    kGaussianTwice = 9510,
    kHarmonicCode = 9511,
    kExactIndex = 9512,
    kExactValue = 9513,
};

/// Reports and counts findings; with stop_at_first only the first one.
class Findings {
public:
    Findings(pro_report report, void* user, bool stop_at_first);

    /// @param format printf-like, for one line without the file's name
    void add(Finding finding, const char* format, ...) __attribute__((format(printf, 3, 4)));

    std::size_t count() const { return count_; }
    bool stopped() const { return stop_at_first_ && count_ > 0; }

private:
    pro_report report_;
    void* user_;
    bool stop_at_first_;
    std::size_t count_ = 0;
};

/// Counts the places of one finding in a section, so that a broken section gives one line, not millions.
struct Tally {
    std::uint64_t places = 0;
    std::uint64_t first = 0;

    void hit(std::uint64_t place) {
        if (places++ == 0) first = place;
    }
    /// Adds a tally of later places.
    void join(const Tally& later) {
        if (places == 0) first = later.first;
        places += later.places;
    }
    /// Reports the finding if there was a hit: "WHAT FIRST: reason (and N more)".
    void addTo(Findings& findings, Finding finding, const char* what, const char* reason) const;
};

/// Formats one line into message, truncated to its size. message may be null.
void setMessage(pro_message* message, std::uint32_t finding, const char* format, ...)
    __attribute__((format(printf, 3, 4)));

} // namespace pointrt::format
