// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/dxf.h"

#include "runtime/measure/decimal_text.h"

namespace pointrt {
namespace {

// Flags (group 70) of AutoCAD R12's DXF reference.
constexpr int kIsClosed = 1, kIs3dPolyline = 8, kIsVertexOf3dPolyline = 32;

std::string dxfPosition(const Position& point, int decimals) {
    return "10\n" + decimalText(point[0], decimals) + "\n20\n" + decimalText(point[1], decimals) + "\n30\n" +
           decimalText(point[2], decimals) + "\n";
}

std::string begun(const std::string& type, const std::string& layer) { return "0\n" + type + "\n8\n" + layer + "\n"; }

std::string dxfFlags(int flags) { return "70\n" + std::to_string(flags) + "\n"; }

std::string polylineText(const DxfEntity& entity, int decimals) {
    const int closed = entity.kind == DxfEntity::Kind::kPolygon ? kIsClosed : 0;
    std::string text =
        begun("POLYLINE", entity.layer) + "66\n1\n" + dxfPosition({}, 1) + dxfFlags(kIs3dPolyline | closed);
    for (const Position& point : entity.positions)
        text += begun("VERTEX", entity.layer) + dxfPosition(point, decimals) + dxfFlags(kIsVertexOf3dPolyline);
    return text + begun("SEQEND", entity.layer);
}

std::string pointsText(const DxfEntity& entity, int decimals) {
    std::string text;
    for (const Position& point : entity.positions) text += begun("POINT", entity.layer) + dxfPosition(point, decimals);
    return text;
}

} // namespace

std::string dxfText(const std::vector<DxfEntity>& entities, int decimals) {
    std::string text = "0\nSECTION\n2\nENTITIES\n";
    for (const DxfEntity& entity : entities)
        text += (entity.kind == DxfEntity::Kind::kPoints ? pointsText : polylineText)(entity, decimals);
    return text + "0\nENDSEC\n0\nEOF\n";
}

} // namespace pointrt
