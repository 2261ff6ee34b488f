// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <set>
#include <string>

#include "format/pro/attributes.h"
#include "format/pro/checks.h"

namespace pointrt::format {

namespace {

bool allZero(const std::byte* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        if (bytes[i] != std::byte{0}) return false;
    return true;
}

/// UTF-8 without control characters, padded with zeros.
bool isValidName(const std::byte* record, const char* name) {
    const std::size_t length = std::strlen(name);
    if (length == 0 || !allZero(record + PRO_ATTR_OFF_NAME + length, PRO_ATTRIBUTE_NAME_MAX + 1 - length)) return false;
    for (std::size_t i = 0; i < length; ++i)
        if (static_cast<unsigned char>(name[i]) < ' ' || name[i] == '\x7f') return false;
    return isUtf8({name, length});
}

bool isValidRange(const pro_attribute& attribute) {
    return std::isfinite(attribute.low) && std::isfinite(attribute.high) && attribute.low <= attribute.high;
}

} // namespace

bool checkAttributeRecord(const Content& content, std::size_t i, Findings& findings) {
    const std::byte* record = content.attribute_records + i * PRO_ATTRIBUTE_BYTES;
    const pro_attribute attribute = loadAttribute(content, i);
    const std::size_t before = findings.count();
    if (!isValidName(record, attribute.name))
        findings.add(Finding::kAttributeName,
                     "attribute %zu: name is empty, too long, not UTF-8 or has control characters", i);
    if (pro_type_bytes(attribute.type) == 0 || attribute.components == 0 ||
        attribute.components > PRO_ATTRIBUTE_COMPONENTS_MAX)
        findings.add(Finding::kAttributeType, "attribute %zu: invalid type %u or number of components %u", i,
                     attribute.type, attribute.components);
    if (!allZero(record + PRO_ATTR_OFF_RESERVED, PRO_ATTR_OFF_LOW - PRO_ATTR_OFF_RESERVED))
        findings.add(Finding::kAttributeReserved, "attribute %zu: reserved bytes are not 0", i);
    if (!isValidRange(attribute))
        findings.add(Finding::kAttributeRange, "attribute %zu: invalid range %g to %g", i, attribute.low,
                     attribute.high);
    return findings.count() == before;
}

void checkAttributeNames(const Content& content, Findings& findings) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < content.attribute_values.size(); ++i)
        if (!names.insert(loadAttribute(content, i).name).second)
            findings.add(Finding::kAttributeName, "attribute %zu: an earlier attribute has the same name", i);
}

void checkAttributeValues(const pro_info& info, const Content& content, Findings& findings) {
    for (std::size_t i = 0; i < content.attribute_values.size(); ++i) {
        const pro_attribute attribute = loadAttribute(content, i);
        if (!attribute.values) continue;
        pro_attribute found = attribute;
        findRange(found, std::size_t{info.splat_count} * attribute.components);
        if (found.low != attribute.low || found.high != attribute.high)
            findings.add(Finding::kAttributeValues, "attribute %zu: range %g to %g, but its values span %g to %g", i,
                         attribute.low, attribute.high, found.low, found.high);
    }
}

void checkWorld(const pro_world& world, Findings& findings) {
    const double x = world.up[0], y = world.up[1], z = world.up[2];
    // not std::hypot, which may return 0 in libstdc++ if one number is NaN
    const double length = std::sqrt(x * x + y * y + z * z);
    if (!(length == 0 || std::fabs(length - 1) <= 1e-5)) // a unit vector of floats is off by 1e-7
        findings.add(Finding::kUp, "the up vector has length %g, not 0 or 1", length);
    const double metres = world.metres_per_unit;
    if (!(metres == 0 || (metres >= 1e-30 && metres <= 1e30)))
        findings.add(Finding::kMetres, "%g metres per unit is not in [1e-30, 1e30]", metres);
}

void checkSensors(const pro_world& world, Findings& findings) {
    constexpr double kFarthest = 1e30; // bound on the cube's origin
    Tally places;
    for (std::size_t i = 0; i < world.sensor_count; ++i) {
        const double* sensor = world.sensors + i * PRO_SENSOR_DOUBLES;
        const bool inside =
            std::fabs(sensor[0]) <= kFarthest && std::fabs(sensor[1]) <= kFarthest && std::fabs(sensor[2]) <= kFarthest;
        const bool nowhere = sensor[0] == 0 && sensor[1] == 0 && sensor[2] == 0;
        if (!inside || !(sensor[3] == 1 || (sensor[3] == 0 && nowhere))) places.hit(i);
    }
    places.addTo(findings, Finding::kSensor, "sensor", "not finite, or neither a known position nor zeros");
}

} // namespace pointrt::format
